// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include <octavo/exact/counters.hpp>
#include <octavo/exact/homogeneous_point.hpp>
#include <octavo/exact/plane.hpp>

// On which side of a plane a point lies, for every kind of point. Positive is where the normal points.
//
// A lattice point is one int128 sum. A constructed point is first tried in doubles, on its approximation.
// With u = 2^-53: the coefficients a, b, c are exact doubles, d has one rounding, a coordinate is off by at
// most 4u; a product and two levels of the sum add three roundings. So the sum s is off by at most 7u (1 +
// 10u) times the true |a x| + |b y| + |c z| + |d|, and 8u times the computed one, M, is more than that, its
// own roundings included. |s| > 8u M proves the sign. Numbers stay between 2^-162 and 2^245: no overflow, no
// underflow.
//
// What a filter never decides is an exact zero. Callers know most zeros beforehand: a point built from a
// plane lies on it. Remember that by name and do not ask; it saves the whole exact evaluation.

namespace octavo::exact {

constexpr Sign side_of(const Plane& plane, Point p) { return sign_of(plane.value_at(p)); }

constexpr Sign side_of(const AxisPlane& plane, Point p) {
    return sign_of(2 * std::int64_t{p[plane.axis]} - plane.twice);
}

/// The exact path of side_of: the sign of a x + b y + c z + d w. It counts nothing.
template <int NumeratorBits, int WeightBits>
Sign exact_side_of(const Plane& plane, const HomogeneousPoint<NumeratorBits, WeightBits>& p) {
    constexpr int width = budget::limbs(budget::side_of_point(NumeratorBits, WeightBits));
    return (multiply<width>(p.numerator(0), WideInt<1>(plane.a())) +
            multiply<width>(p.numerator(1), WideInt<1>(plane.b())) +
            multiply<width>(p.numerator(2), WideInt<1>(plane.c())) +
            multiply<width>(p.weight(), WideInt<2>(plane.d())))
        .sign();
}

extern template Sign exact_side_of(const Plane&, const EdgePoint&);
extern template Sign exact_side_of(const Plane&, const TriplePoint&);

template <int NumeratorBits, int WeightBits>
Sign side_of(const Plane& plane, const HomogeneousPoint<NumeratorBits, WeightBits>& p) {
    const double ax = static_cast<double>(plane.a()) * p.approximation(0);
    const double by = static_cast<double>(plane.b()) * p.approximation(1);
    const double cz = static_cast<double>(plane.c()) * p.approximation(2);
    const double d = plane.d_approximation();
    const double sum = (ax + by) + (cz + d);
    const double magnitude = (std::fabs(ax) + std::fabs(by)) + (std::fabs(cz) + std::fabs(d));
    constexpr double eight_u = 0x1p-50;
    if (std::fabs(sum) > eight_u * magnitude) [[likely]] {
        count_filtered(Predicate::side_of_plane);
        return sum > 0 ? Sign::positive : Sign::negative;
    }
    count_exact(Predicate::side_of_plane);
    return exact_side_of(plane, p);
}

/// The sign of 2 x - twice w.
template <int NumeratorBits, int WeightBits>
Sign side_of(const AxisPlane& plane, const HomogeneousPoint<NumeratorBits, WeightBits>& p) {
    // Half the plane's position is an exact double; the coordinate is off by 4u and the difference rounds
    // once more, so 8u times the greater magnitudes is ample.
    const double position = 0.5 * plane.twice, coordinate = p.approximation(plane.axis);
    const double difference = coordinate - position;
    constexpr double eight_u = 0x1p-50;
    if (std::fabs(difference) > eight_u * (std::fabs(coordinate) + position)) [[likely]] {
        count_filtered(Predicate::side_of_plane);
        return difference > 0 ? Sign::positive : Sign::negative;
    }
    count_exact(Predicate::side_of_plane);
    constexpr int width =
        budget::limbs(budget::sum(2, budget::greater(NumeratorBits + 1, WeightBits + coordinate_bits + 2)));
    using Wide = WideInt<width>;
    const Wide numerator = p.numerator(plane.axis);
    return (numerator + numerator - multiply<width>(Wide(p.weight()), WideInt<1>(plane.twice))).sign();
}

}  // namespace octavo::exact
