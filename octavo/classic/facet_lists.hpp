// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <octavo/classic/crossing.hpp>
#include <octavo/classic/facet.hpp>
#include <octavo/classic/octant_overlap.hpp>
#include <octavo/octree/descend.hpp>

// Facets restricted to a cell and to its octants: what the descents of the classic octree and of the inside query
// share. A restriction is a range of facet indices in the buffer of the cell's level and the winding number of the
// cell's displaced low corner.

namespace octavo::classic {

struct FacetRange {
    std::uint32_t begin = 0, end = 0;  ///< in the buffer of the cell's level
    std::int32_t winding = 0;          ///< at the low corner, displaced by (ε₁, ε₂, ε₃)

    std::uint32_t size() const { return end - begin; }
};

/// A buffer that grows and is never initialised nor shrunk.
class IndexBuffer {
  public:
    std::uint32_t* data() { return data_.get(); }
    const std::uint32_t* data() const { return data_.get(); }
    /// Room for `size` indices of which the first `kept` stay.
    void ensure(std::size_t size, std::size_t kept) {
        if (size <= capacity_) return;
        const std::size_t grown = std::max(size, capacity_ + capacity_ / 2);
        std::unique_ptr<std::uint32_t[]> next(new std::uint32_t[grown]);
        std::copy_n(data_.get(), kept, next.get());
        data_ = std::move(next);
        capacity_ = grown;
    }

  private:
    std::unique_ptr<std::uint32_t[]> data_;
    std::size_t capacity_ = 0;
};

/// The buffers of one path from the root.
struct FacetLists {
    std::array<IndexBuffer, octree::max_level + 1> levels;
    std::vector<OctantSet> octants;  ///< for each facet of the cell at hand, the octants that it touches
    std::vector<std::uint32_t> undecided;  ///< facets of the cell at hand that need more than their bounds

    /// A facet that may cross steps between octants.
    struct Stepping {
        std::uint32_t facet;
        std::uint32_t steps;
    };
    std::vector<Stepping> stepping;

    std::span<const std::uint32_t> list(int level, const FacetRange& range) const {
        return {levels[static_cast<std::size_t>(level)].data() + range.begin, range.size()};
    }
};

/// What a cell's facets say about its octants.
struct OctantFacets {
    OctantSet touched = 0;                  ///< octants that some facet touches
    std::array<std::int32_t, 8> winding{};  ///< at the displaced low corner of each octant
};

/// The facets that touch the universe: all of them but, for Touch::interior, those in its low sides. The list goes
/// to level 0 of `lists`.
FacetRange universe_facets(std::span<const Facet> facets, Touch touch, FacetLists& lists);

/// Fills `lists.octants` for the cell's facets.
template <Touch touch>
OctantFacets find_octants(std::span<const Facet> facets, const octree::Cell& cell, const FacetRange& range,
                          FacetLists& lists);

/// The same when only which octants are touched is wanted, not by whom, and the winding numbers of the others.
template <Touch touch>
OctantFacets find_touched(std::span<const Facet> facets, const octree::Cell& cell, const FacetRange& range,
                          FacetLists& lists);

/// Writes the lists of the octants, from `lists.octants`, to the buffer of the next level.
std::array<FacetRange, 8> distribute(const octree::Cell& cell, const FacetRange& range,
                                     const OctantFacets& found, FacetLists& lists);

/// Copies a cell's list to other buffers.
FacetRange transfer(const octree::Cell& cell, const FacetRange& range, const FacetLists& from,
                    FacetLists& to);

}  // namespace octavo::classic
