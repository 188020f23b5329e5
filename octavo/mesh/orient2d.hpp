// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

// The sign of the turn a → b → c of points with double coordinates, exact. Input polygons have to be
// triangulated before there is a lattice, so this one predicate works on doubles.
//
// A static filter decides nearly always; else the determinant is expanded into twelve doubles without loss
// and summed exactly (J. R. Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric
// predicates", 1997). Exact as long as no product of coordinates under- or overflows: coordinates in
// [2^-480, 2^510] or 0, which the caller sees to.

namespace octavo::mesh {

struct Point2 {
    double x = 0, y = 0;
    friend bool operator==(const Point2&, const Point2&) = default;
};

/// The exact part of orient2d; the same answer, slowly.
int orient2d_exact(Point2 a, Point2 b, Point2 c);

/// +1 when a → b → c turns left (counter-clockwise), −1 when it turns right, 0 when the three are collinear.
inline int orient2d(Point2 a, Point2 b, Point2 c) {
    const double left = (a.x - c.x) * (b.y - c.y);
    const double right = (a.y - c.y) * (b.x - c.x);
    const double determinant = left - right;
    // Shewchuk's bound (3 + 16 ε) ε with ε = 2^-53, for the subtractions, products and the difference.
    constexpr double bound = 3.3306690738754716e-16;
    const double error = bound * (std::fabs(left) + std::fabs(right));
    if (determinant > error) return 1;
    if (determinant < -error) return -1;
    if (left == 0 && right == 0) return 0;  // collinear along an axis, common in CAD
    return orient2d_exact(a, b, c);
}

}  // namespace octavo::mesh
