// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include <octavo/exact/counters.hpp>
#include <octavo/exact/homogeneous_point.hpp>
#include <octavo/exact/orient.hpp>
#include <octavo/exact/plane.hpp>

// Which way three points of one plane turn, for points of any kinds.
//
// They are seen along the plane's dominant axis, in which the plane is never edge-on; then it is the sign of
// the 3x3 determinant of (x, y, w), up to 545 bits. Prefer side_of with a plane through the edge
// (Plane::along_axis) where two of the points span a lattice edge: 245 bits at most, and 19 ns
// instead of 167 when it has to be exact.
//
// Filter, u = 2^-53: let R bound the coordinates' magnitudes and e = 12u R. A difference of two
// approximations is off by at most 8u R from their errors and 2u R from its rounding, together less than e. A
// product of two such differences f, g is off by e (|f| + |g|) + e^2, and rounds by u |f g| <= u 2R |g| <= e
// |g| / 6; the last subtraction rounds by no more. So the determinant is off by less than 2 e S + 2 e^2,
// where S sums the four differences' magnitudes. The computed bound, 2 e (S + e), itself rounds by less than
// the slack in e.

namespace octavo::exact {

/// The sign of the determinant of (first, second, w) of p, q, r, where first and second are the coordinate
/// axes after `axis`: the exact path of orient2d for any kinds of points. It counts nothing.
template <int N1, int W1, int N2, int W2, int N3, int W3>
Sign exact_orient2d(int axis, const HomogeneousPoint<N1, W1>& p, const HomogeneousPoint<N2, W2>& q,
                    const HomogeneousPoint<N3, W3>& r) {
    // Expanded along p; the minors of q and r stay narrower than the whole.
    constexpr int minor_width =
        budget::limbs(budget::sum(2, budget::greater(N2 + N3, budget::greater(N2 + W3, W2 + N3))));
    constexpr int width = budget::limbs(budget::orientation_in_plane(N1, W1, N2, W2, N3, W3));
    const int i = axis == 2 ? 0 : axis + 1, j = axis == 0 ? 2 : axis - 1;
    const auto yw =
        multiply<minor_width>(q.numerator(j), r.weight()) - multiply<minor_width>(r.numerator(j), q.weight());
    const auto xw =
        multiply<minor_width>(q.numerator(i), r.weight()) - multiply<minor_width>(r.numerator(i), q.weight());
    const auto xy = multiply<minor_width>(q.numerator(i), r.numerator(j)) -
                    multiply<minor_width>(r.numerator(i), q.numerator(j));
    return (multiply<width>(yw, p.numerator(i)) - multiply<width>(xw, p.numerator(j)) +
            multiply<width>(xy, p.weight()))
        .sign();
}

/// Which way p, q, r turn, seen from the far end of `axis`: positive is counter-clockwise. The points need
/// not lie in one plane.
template <AnyPoint P, AnyPoint Q, AnyPoint R>
Sign orient2d(int axis, const P& p, const Q& q, const R& r) {
    const int i = axis == 2 ? 0 : axis + 1, j = axis == 0 ? 2 : axis - 1;
    const auto at = [](const auto& point, int coordinate) {
        return homogeneous(point).approximation(coordinate);
    };
    const double px = at(p, i), py = at(p, j);
    const double qx = at(q, i), qy = at(q, j);
    const double rx = at(r, i), ry = at(r, j);
    const double ux = qx - px, uy = qy - py, vx = rx - px, vy = ry - py;
    const double determinant = ux * vy - uy * vx;
    const double greatest =
        std::max({std::fabs(px), std::fabs(py), std::fabs(qx), std::fabs(qy), std::fabs(rx), std::fabs(ry)});
    constexpr double twelve_u = 3 * 0x1p-51;
    const double e = twelve_u * greatest;
    const double sum = (std::fabs(ux) + std::fabs(uy)) + (std::fabs(vx) + std::fabs(vy));
    if (std::fabs(determinant) > 2 * e * (sum + e)) [[likely]] {
        count_filtered(Predicate::orient_in_plane);
        return determinant > 0 ? Sign::positive : Sign::negative;
    }
    count_exact(Predicate::orient_in_plane);
    return exact_orient2d(axis, homogeneous(p), homogeneous(q), homogeneous(r));
}

/// Which way three points of `plane` turn, seen from its positive side: positive is counter-clockwise. The
/// plane must not be degenerate.
template <AnyPoint P, AnyPoint Q, AnyPoint R>
Sign orient_in_plane(const Plane& plane, const P& p, const Q& q, const R& r) {
    const int axis = plane.dominant_axis();
    return orient2d(axis, p, q, r) * sign_of(plane.normal(axis));
}

}  // namespace octavo::exact
