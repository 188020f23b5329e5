// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <octavo/mesh/collinear.hpp>
#include <octavo/mesh/orient2d.hpp>

namespace octavo::mesh {

bool scale_for_orient2d(std::span<Vec3> positions) {
    constexpr double least = 0x1p-480, safe = 0x1p500;
    double largest = 0, smallest = std::numeric_limits<double>::infinity();
    for (const Vec3& p : positions) {
        if (!is_finite(p)) return false;
        for (int axis = 0; axis < 3; ++axis) {
            const double magnitude = std::fabs(p[axis]);
            largest = std::max(largest, magnitude);
            if (magnitude > 0) smallest = std::min(smallest, magnitude);
        }
    }
    if (smallest >= least && largest < safe) return true;
    const int exponent = std::ilogb(safe) - std::ilogb(largest);
    for (Vec3& p : positions)
        for (int axis = 0; axis < 3; ++axis) {
            p[axis] = std::ldexp(p[axis], exponent);
            if (std::fabs(p[axis]) < least) p[axis] = 0;
        }
    return true;
}

bool collinear(Vec3 a, Vec3 b, Vec3 c) {
    std::array<Vec3, 3> p{a, b, c};
    if (!scale_for_orient2d(p)) return false;
    const auto turn = [&](int u, int v) {
        return orient2d({p[0][u], p[0][v]}, {p[1][u], p[1][v]}, {p[2][u], p[2][v]});
    };
    return turn(0, 1) == 0 && turn(1, 2) == 0 && turn(2, 0) == 0;
}

}  // namespace octavo::mesh
