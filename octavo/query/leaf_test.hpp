// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include <octavo/base/vec3.hpp>
#include <octavo/classic/facet.hpp>
#include <octavo/exact/lattice.hpp>

// A double point against the facets of one leaf: on one of them, or else the winding number there.

namespace octavo::query {

/// A point of the world as the lattice sees it: world = (origin + whole + part) · unit with 0 ≤ part ≤ 1. The whole
/// numbers are exact. So are the parts, but for coordinates from -1/2 to 0 units of the world, one of which rounds by
/// up to 2^-54 and may come out as 1; and for underflow. So they serve filters only, and exact signs are taken at
/// `world`.
struct LatticePlace {
    Vec3 world;
    std::array<std::int32_t, 3> whole;
    std::array<double, 3> part;
};

struct LeafAnswer {
    bool on_facet = false;
    std::int32_t winding = 0;
};

/// `facets` must hold all that touch the half-open leaf with low corner `low`, and the place must lie in that leaf;
/// `winding` is that of the displaced low corner.
LeafAnswer test_in_leaf(const LatticePlace& place, const std::array<std::int32_t, 3>& low,
                        std::int32_t winding, std::span<const std::uint32_t> references,
                        std::span<const classic::FacetCorners> facets, const exact::Lattice& lattice);

}  // namespace octavo::query
