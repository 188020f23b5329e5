// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include <octavo/csg/second_order_cone.hpp>

// A convex quadric as a polynomial: q(x) = |L x + l|² − (w · x + v)², negative inside.
//
// The square of SecondOrderCone without its square roots: a few multiplications give it at a cell, and its values on
// a grid of points there follow. Where w = 0 (ellipsoids, cylinders) q is convex and its sign is the answer; for a
// cone q is negative inside the other nappe too, where w · x + v is negative.
//
// Rounding: |L d + l|² and (w · d + v)², and every partial sum of their expansion over a box |d| <= D, is at most
// m² with m = magnitude · D + constant. From the doubles of the matrix to a value on the grid no term passes through
// more than 40 roundings, each of a quantity of at most 4 m²; `error` allows 512 of m².

namespace octavo::csg {

struct Quadric {
    /// q(d) = Σ form[a][b] d_a d_b with d₃ = 1, d a difference to `origin`; symmetric, so rows are columns.
    std::array<std::array<double, 4>, 4> form{};
    std::array<double, 3> origin{};
    double magnitude = 0, constant = 0;
    double axis_reach = 0;         ///< |w₀| + |w₁| + |w₂|; zero for ellipsoids and cylinders
    std::array<double, 4> axis{};  ///< w and v

    explicit Quadric(const SecondOrderCone& cone);

    double error(double distance) const {
        const double size = magnitude * distance + constant;
        return 512 * 0x1p-53 * size * size;
    }
};

}  // namespace octavo::csg
