// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>

#include <octavo/base/context.hpp>
#include <octavo/base/uninitialised.hpp>
#include <octavo/boolean/rounded_points.hpp>
#include <octavo/boolean/surface.hpp>

// The pairs of facets of the soup in which rounding may bring triangles of the result into contact.
//
// Problem: rounding moves points by 2^-28 of a lattice unit or so, to floats by a unit or two, which can make triangles
// cross that were apart by as little. To look for such pairs among all triangles of the result would cost more than the
// set operation: pieces of slivers lie beside each other by the thousand. Idea: triangles lie in facets of the soup,
// and facets that are farther apart than `contact_reach` did not pass the filter that looked for contacts. Let δ be
// what rounding moves a coordinate by, and s the reach. A pair of facets is listed here when
//   - it passed that filter: else a plane has both on its two sides, corners that they share in it, all others farther
//     from it than s;
//   - or it shares an edge;
//   - or it shares just a corner, about which one of the two is *tight*: an edge of its triangles that does not end in
//     the corner comes within R = 4 δ 2^26 / s of it;
//   - or it is a facet with itself.
// No other pair can do harm. While points move from their exact to their rounded places, the first contact of two
// triangles is one of parts without a common corner (a corner and a triangle, or two edges), which were no more than 2δ
// apart in any coordinate before. Facets without a common corner are farther apart than that. Facets with one are as
// near to each other only where the distance from the separating plane, more than s at the far corners and linear
// between, is less: within R of the corner, and there neither has a part that does not end in it.
//
// Polygons merged from pieces of several facets are near what one of these is near.

namespace octavo::boolean {

/// No coordinate is farther from its exact place, in lattice units: half a step from number to number for the nearest
/// one, and a whole one where rounding_faults.hpp takes one beside it.
inline double placing_bound(const exact::Lattice& lattice, Numbers numbers) {
    return 3 * rounding_bound(lattice, numbers);
}

/// How near to each other facets must be that find_contacts is to tell of, in lattice units. More makes the filter let
/// more pairs through, less makes more facets tight.
inline double contact_reach(const exact::Lattice& lattice, Numbers numbers) {
    return std::max(0x1p-6, 4 * placing_bound(lattice, numbers));
}

/// Where a point is after rounding, in lattice units.
inline Vec3 lattice_place(const RoundedPoints& rounded, PointId id) {
    const RoundedPoints::Point at = rounded[id];
    constexpr double scale = 1.0 / static_cast<double>(std::int64_t{1} << RoundedPoints::fraction_bits);
    return {static_cast<double>(at[0]) * scale, static_cast<double>(at[1]) * scale,
            static_cast<double>(at[2]) * scale};
}

struct NearPairs {
    using Pair = std::pair<std::uint32_t, std::uint32_t>;
    UninitialisedVector<Pair> pairs;  ///< sorted, each once; one of either has a triangle with a moved corner
    /// The first triangle of each facet of the soup, and the next one of its facet after each triangle, or no_index;
    /// for the facets in pairs.
    UninitialisedVector<std::uint32_t> first_of, next;
};

/// `near` are those that the filter of contacts let through. Cancellation leaves anything.
NearPairs find_near_pairs(const Surface& surface, const Soup& soup, std::span<const NearPairs::Pair> near,
                          const RoundedPoints& rounded, const Context& context);

}  // namespace octavo::boolean
