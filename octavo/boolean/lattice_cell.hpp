// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>

#include <octavo/exact/compare.hpp>

// The lattice cell that holds a point, by value: equal points have equal cells however they were constructed.

namespace octavo::boolean {

struct LatticeCell {
    exact::Point low;
    bool is_corner;  ///< all coordinates are integers: the point is `low`
};

template <class P>
LatticeCell lattice_cell(const P& point) {
    // Approximations are off by less than 2^-24; farther than 2^-20 from an integer they cannot be on the wrong
    // side of it. Nearer, the integer is compared exactly.
    constexpr double margin = 0x1p-20;
    std::int32_t low[3];
    bool is_corner = true;
    for (int axis = 0; axis < 3; ++axis) {
        const double coordinate = point.approximation(axis), below = std::floor(coordinate);
        low[axis] = static_cast<std::int32_t>(below);
        if (coordinate - below > margin && coordinate - below < 1 - margin) {
            is_corner = false;
            continue;
        }
        const auto nearest = static_cast<std::int32_t>(std::nearbyint(coordinate));
        const exact::Point at{nearest, nearest, nearest};
        const exact::Sign sign = exact::compare_coordinate(axis, point, at);
        low[axis] = sign == exact::Sign::negative ? nearest - 1 : nearest;
        is_corner = is_corner && sign == exact::Sign::zero;
    }
    return {{low[0], low[1], low[2]}, is_corner};
}

}  // namespace octavo::boolean
