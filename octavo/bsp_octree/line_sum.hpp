// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <octavo/boolean/point_table.hpp>
#include <octavo/bsp_octree/borders.hpp>
#include <octavo/exact/compare.hpp>

// The segments on one line of space, added up between neighbouring ends (borders.hpp).

namespace octavo::bsp_octree {

/// A point on a line at which nothing changes, though fragments end there, and a facing that runs through it.
struct Passed {
    bsp::Facing facing;
    boolean::PointId point;
    friend auto operator<=>(const Passed&, const Passed&) = default;
};

/// What is left on lines.
struct LineSums {
    std::vector<Segment> borders;
    std::vector<Passed> passed;
};

/// Adds up one line after the other and keeps its memory.
class LineSum {
  public:
    /// Segments end at points that `is_kept`, by id, also where nothing changes.
    LineSum(const boolean::PointTable& points, const std::vector<char>& is_kept)
        : points_(points), is_kept_(is_kept) {}

    /// `members` index `edges`; all lie on the line that `order` runs along. Appends what is left of them to `sums`.
    void add(std::span<const BoundedSegment> edges, std::span<const std::uint32_t> members,
             const exact::LineOrder& order, LineSums& sums);

  private:
    /// How often a facing runs along an interval between ends, more often one way than the other; 0: it is slit there.
    struct Cover {
        std::uint32_t interval;
        bsp::Facing facing;
        std::int32_t net;
    };

    void sort_ends(std::span<const BoundedSegment> edges, std::span<const std::uint32_t> members,
                   const exact::LineOrder& order);
    void cover(std::span<const BoundedSegment> edges, std::span<const std::uint32_t> members);
    std::size_t number_of(boolean::PointId id) const;
    std::size_t interval_end(std::size_t i) const;
    bool continues(std::size_t first, std::size_t first_end, std::size_t next) const;

    const boolean::PointTable& points_;
    const std::vector<char>& is_kept_;
    std::vector<boolean::PointId> ends_, by_id_;
    std::vector<std::uint32_t> place_;
    std::vector<Cover> all_, covers_;
};

}  // namespace octavo::bsp_octree
