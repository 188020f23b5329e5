// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/boolean/near_facets.hpp>
#include <octavo/boolean/rounded_points.hpp>
#include <octavo/boolean/surface.hpp>

// What rounding does to the surface: facets that it turns over or makes flat, and pairs of facets that then meet in
// more than the corners and edges that they share. Both are decided exactly, in the coordinates that leave the library.
//
// Most can be helped: a point between doubles has eight of them about it, and more beside those. Points of facets at
// fault are taken to others nearby, one after the other, whenever that leaves fewer faults about the point. To round
// without faults always, near where one was, is NP-hard (V. J. Milenkovic, L. R. Nackman, Finding compact coordinate
// representations for polygons and polyhedra, 1990); what cannot be helped here is told.
// Cost: nothing when no point was constructed between doubles; else near_facets.hpp, and about 0.1 µs a pair of near
// triangles.

namespace octavo::boolean {

struct RoundingFaults {
    std::vector<std::uint32_t> inverted;                            ///< facets of the surface, ascending
    std::vector<std::pair<std::uint32_t, std::uint32_t>> crossing;  ///< pairs of others, sorted
    std::size_t moved_points = 0;  ///< which are not at the nearest doubles, so that there are no more
    double farthest_move = 0;      ///< of a coordinate of these, in lattice units

    bool empty() const { return inverted.empty() && crossing.empty(); }
};

/// Facets that rounding turns over or makes flat, ascending.
std::vector<std::uint32_t> find_inverted(const Surface& surface, const Soup& soup,
                                         const RoundedPoints& rounded, const Context& context = {});

/// Moves points of `rounded` so that there are few faults, and returns those left. `near` are the contacts' near pairs.
RoundingFaults mend_rounding(const Surface& surface, const Soup& soup, std::span<const NearFacets::Pair> near,
                             RoundedPoints& rounded, const Context& context);

}  // namespace octavo::boolean
