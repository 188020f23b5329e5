// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include <octavo/bp_octree/frame.hpp>

#include "unlimited.hpp"

// The oracle of the tests: triangles clipped by boxes in rational numbers.

namespace octavo::tests {
using RationalPoint = std::array<Rational, 3>;

inline RationalPoint doubled(exact::Point p) {
    return {Rational(2 * p.x), Rational(2 * p.y), Rational(2 * p.z)};
}

/// The polygon of a triangle within a closed box, in doubled coordinates; empty when they are apart.
inline std::vector<RationalPoint> clipped(exact::Point p, exact::Point q, exact::Point r,
                                          const bp_octree::CellBox& box) {
    std::vector<RationalPoint> polygon{doubled(p), doubled(q), doubled(r)};
    for (int side = 0; side < 6; ++side) {
        const auto axis = static_cast<std::size_t>(side / 2);
        const Rational bound(side % 2 ? box.high[axis] : box.low[axis]);
        const auto outside = [&](const RationalPoint& x) {
            return side % 2 ? x[axis] > bound : x[axis] < bound;
        };
        std::vector<RationalPoint> kept;
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const RationalPoint &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
            if (!outside(a)) kept.push_back(a);
            if (outside(a) == outside(b)) continue;
            const Rational t = (bound - a[axis]) / (b[axis] - a[axis]);
            RationalPoint cut;
            for (std::size_t k = 0; k < 3; ++k) cut[k] = a[k] + t * (b[k] - a[k]);
            kept.push_back(cut);
        }
        polygon = std::move(kept);
    }
    return polygon;
}

}  // namespace octavo::tests
