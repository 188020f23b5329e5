// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <octavo/base/result.hpp>
#include <octavo/classic/facet.hpp>
#include <octavo/exact/lattice.hpp>
#include <octavo/hexmesh/options.hpp>
#include <octavo/octree/cell.hpp>

// How deep the octree must be where: the lengths of Options as levels of one lattice.

namespace octavo::hexmesh {

/// A lattice that contains `content` and whose cells down to a quarter of its universe lie at multiples of their side
/// in the world: so a part and its cells do not depend on what else is in the job. At most one bit coarser than the
/// finest lattice. Errors: those of exact::Lattice::fit.
Result<exact::Lattice> grid_lattice(const Box3& content);

class SizeField {
  public:
    /// Errors: bad_input for lengths that are negative or not finite, a level out of range, a solid that is not
    /// there; limit when a length asks for cells smaller than level 21.
    static Result<SizeField> from(const Options& options, std::size_t solids, const Box3& content,
                                  const exact::Lattice& lattice);

    /// The deepest level that anything may ask for.
    int deepest() const { return deepest_; }
    /// Cells on the surface of this solid, and inside it, are at least this deep.
    int surface_level(mesh::SolidIndex solid) const { return surface_[solid]; }
    int interior_level(mesh::SolidIndex solid) const { return interior_[solid]; }
    /// Cells of the mesh here are at least this deep.
    int level_in(const octree::Cell& cell) const;
    bool looks_at_facets() const { return curvature_level_ > 0 || proximity_level_ > 0; }
    /// Whether a cell with these facets is too large for how they bend or face each other.
    bool is_too_coarse_for(int level, std::span<const classic::Facet> facets,
                           std::span<const std::uint32_t> list) const;

  private:
    struct Box {
        exact::Point low, high;
        int level;
    };

    std::vector<int> surface_, interior_;
    std::vector<Box> boxes_;
    int largest_level_ = 0, curvature_level_ = 0, proximity_level_ = 0, deepest_ = 0;
    double least_cosine_ = 1;
};

}  // namespace octavo::hexmesh
