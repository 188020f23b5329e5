// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/boolean/rounded_points.hpp>
#include <octavo/boolean/surface.hpp>

// What rounding did to the surface: facets that it turned over or made flat, and pairs of facets that now meet in more
// than the corners and edges that they share.
//
// Only facets with a corner that has moved can be at fault, or cross another one. Pairs are looked for in a tree over
// these and over the facets near them, with their corners taken to the nearest lattice point and a reach that allows
// for that; what it finds is decided exactly, in the coordinates that leave the library.
// Cost: nothing when no point was constructed off the lattice; else about 20 ns a facet of the result, and 1 µs one
// with a moved corner.

namespace octavo::boolean {

struct RoundingFaults {
    std::vector<std::uint32_t> inverted;                            ///< facets of the surface, ascending
    std::vector<std::pair<std::uint32_t, std::uint32_t>> crossing;  ///< pairs of others, sorted
};

RoundingFaults find_rounding_faults(const Surface& surface, const Soup& soup, const RoundedPoints& rounded,
                                    const Context& context);

}  // namespace octavo::boolean
