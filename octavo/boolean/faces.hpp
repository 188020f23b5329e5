// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/boolean/soup.hpp>

// Faces: facets of a soup, of which some pairs are joined to a convex quadrilateral.
//
// Problem: half of the facets of a machine part are triangles only because a rectangle had to be cut in two. Whatever
// crosses the rectangle crosses its diagonal too, in a point that nobody needs, that lies on no lattice, and that
// all later stages carry along: of the points of a Menger sponge more than half. Idea: two coplanar neighbours are
// one face from the start when they make a strictly convex quadrilateral, and the diagonal is forgotten. Convex faces
// that are not coplanar still meet in a segment, with ends where an edge of one pierces the other, so nothing else
// changes.
//
// Only facets that come near others are joined; two are when no third facet has their common edge and they change the
// same winding numbers. Of several choices the longest edge goes first.
// Invariants: a face goes by the name of the lesser of its facets, and turns as they do.
// Cost: sorting the edges of facets that come near others, and a look at the corners of all facets if any can be
// joined.

namespace octavo::boolean {

class Faces {
  public:
    /// Every facet is a face.
    Faces() = default;
    /// Joins facets that occur in `near`, which are pairs of facets. Cancellation joins none.
    Faces(const Soup& soup, std::span<const std::pair<std::uint32_t, std::uint32_t>> near,
          const Context& context);

    bool any_joined() const { return !partner_.empty(); }
    /// The other facet of a face of two, else no_index.
    std::uint32_t partner(std::uint32_t facet) const { return partner_.empty() ? no_index : partner_[facet]; }
    /// The face that a facet is in.
    std::uint32_t of(std::uint32_t facet) const { return std::min(facet, partner(facet)); }

    /// Three or four vertices of the soup, as the facet turns.
    struct Corners {
        std::uint32_t count;
        std::array<std::uint32_t, 4> vertex;
    };
    Corners corners(const Soup& soup, std::uint32_t face) const;

  private:
    std::vector<std::uint32_t> partner_;  ///< per facet; empty when none is joined
};

}  // namespace octavo::boolean
