// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include <octavo/exact/counters.hpp>
#include <octavo/exact/homogeneous_point.hpp>
#include <octavo/exact/intersect.hpp>

// Order and equality of points of any two kinds (Point, EdgePoint, TriplePoint).
//
// Everything is the comparison of one coordinate, x1/w1 with x2/w2. In doubles each is off by at most 4u
// times itself and their difference rounds once, so 6u (|x1/w1| + |x2/w2|) is beyond the error; else the sign
// of x1 w2 - x2 w1 decides, at most 353 bits. Points on one line need no more than that: their order along
// the line is their order in the coordinate that changes most (LineOrder).

namespace octavo::exact {

/// The sign of x1 w2 - x2 w1 for coordinate `axis`: the exact path of compare_coordinate. It counts nothing.
template <int N1, int W1, int N2, int W2>
Sign exact_compare_coordinate(int axis, const HomogeneousPoint<N1, W1>& first,
                              const HomogeneousPoint<N2, W2>& second) {
    constexpr int width = budget::limbs(budget::difference(N1, W1, N2, W2));
    return (multiply<width>(first.numerator(axis), second.weight()) -
            multiply<width>(second.numerator(axis), first.weight()))
        .sign();
}

extern template Sign exact_compare_coordinate(int, const EdgePoint&, const EdgePoint&);
extern template Sign exact_compare_coordinate(int, const EdgePoint&, const TriplePoint&);
extern template Sign exact_compare_coordinate(int, const TriplePoint&, const EdgePoint&);
extern template Sign exact_compare_coordinate(int, const TriplePoint&, const TriplePoint&);

/// Positive when coordinate `axis` of `first` is the greater one.
template <AnyPoint P, AnyPoint Q>
Sign compare_coordinate(int axis, const P& first, const Q& second) {
    const double p = homogeneous(first).approximation(axis), q = homogeneous(second).approximation(axis);
    constexpr double six_u = 3 * 0x1p-52;
    if (std::fabs(p - q) > six_u * (std::fabs(p) + std::fabs(q))) [[likely]] {
        count_filtered(Predicate::compare);
        return p > q ? Sign::positive : Sign::negative;
    }
    count_exact(Predicate::compare);
    return exact_compare_coordinate(axis, homogeneous(first), homogeneous(second));
}
constexpr Sign compare_coordinate(int axis, Point first, Point second) {
    return sign_of(first[axis] - second[axis]);
}

/// Lexicographic order by x, then y, then z: positive when `first` comes later, zero when the points
/// coincide.
template <AnyPoint P, AnyPoint Q>
Sign compare(const P& first, const Q& second) {
    for (int axis = 0; axis < 2; ++axis) {
        const Sign sign = compare_coordinate(axis, first, second);
        if (sign != Sign::zero) return sign;
    }
    return compare_coordinate(2, first, second);
}

/// Whether two points of any kinds are the same point of space.
template <AnyPoint P, AnyPoint Q>
bool same_point(const P& first, const Q& second) {
    return compare(first, second) == Sign::zero;
}

/// The order of points on one line: which coordinate to compare, and which way it runs along the line.
struct LineOrder {
    int axis = 0;
    Sign direction = Sign::zero;  ///< zero: there is no line (equal points, parallel planes)

    /// From lattice point p towards q.
    static constexpr LineOrder along(Point p, Point q) {
        return greatest_of(int128{q.x} - p.x, int128{q.y} - p.y, int128{q.z} - p.z);
    }
    /// Along the line's direction, n1 x n2.
    static LineOrder along(const Line& line) {
        return greatest_of(line.direction(0), line.direction(1), line.direction(2));
    }

    constexpr LineOrder reversed() const { return {axis, -direction}; }

  private:
    // The greatest component separates points best, which spares exact comparisons.
    static constexpr LineOrder greatest_of(int128 x, int128 y, int128 z) {
        const auto magnitude = [](int128 number) { return number < 0 ? -number : number; };
        const bool y_greater = magnitude(y) > magnitude(x);
        const int128 greater = y_greater ? y : x;
        if (magnitude(z) > magnitude(greater)) return {2, sign_of(z)};
        return {y_greater ? 1 : 0, sign_of(greater)};
    }
};

/// Positive when `first` lies farther along the line than `second`. Both must lie on it.
template <AnyPoint P, AnyPoint Q>
Sign compare_along(const LineOrder& line, const P& first, const Q& second) {
    return compare_coordinate(line.axis, first, second) * line.direction;
}

}  // namespace octavo::exact
