// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include <octavo/exact/homogeneous_point.hpp>
#include <octavo/exact/plane.hpp>

#include "unlimited.hpp"

// The textbook formulas on integers without limit. They share no formula with the kernel: three planes meet by
// Cramer's rule on Sarrus determinants, an edge meets a plane by its parameter, and signs of weights are handled at
// the end instead of at the start.

namespace octavo::exact::oracle {

using octavo::tests::Integer;

inline Integer integer(std::int64_t number) { return Integer(number); }
inline Integer integer(int128 number) { return Integer(number); }
template <int Limbs>
Integer integer(const WideInt<Limbs>& number) {
    // Two's complement by its definition: the top bit weighs minus its value.
    Integer sum = 0;
    for (int i = Limbs - 1; i >= 0; --i) sum = (sum << 64) + Integer(number.limb[i]);
    return number.limb[Limbs - 1] >> 63 ? Integer(sum - (Integer(1) << (64 * Limbs))) : sum;
}

inline Sign sign(const Integer& number) { return static_cast<Sign>(number.sign()); }

struct Vector {
    Integer x, y, z;
};
inline Vector vector(Point p) { return {Integer(p.x), Integer(p.y), Integer(p.z)}; }
inline Vector operator-(const Vector& p, const Vector& q) { return {p.x - q.x, p.y - q.y, p.z - q.z}; }
inline Integer dot(const Vector& p, const Vector& q) {
    return (p.x * q.x).add_product(p.y, q.y).add_product(p.z, q.z);
}

/// The determinant of three rows, by Sarrus' rule.
inline Integer determinant(const Vector& p, const Vector& q, const Vector& r) {
    return (p.x * q.y * r.z)
        .add_product(p.y * q.z, r.x)
        .add_product(p.z * q.x, r.y)
        .subtract_product(p.z * q.y, r.x)
        .subtract_product(p.x * q.z, r.y)
        .subtract_product(p.y * q.x, r.z);
}

inline Vector normal(const Plane& plane) {
    return {integer(plane.a()), integer(plane.b()), integer(plane.c())};
}

/// (x, y, z) / w with any w but zero.
struct Fraction {
    Vector v;
    Integer w;

    const Integer& operator[](int axis) const { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }
};
inline Fraction fraction(Point p) { return {vector(p), 1}; }

/// The line p, q and a plane; w is zero when they are parallel.
inline Fraction meet(Point p, Point q, const Plane& plane) {
    const Vector direction = vector(q) - vector(p);
    const Integer w = dot(normal(plane), direction);
    const Integer value = dot(normal(plane), vector(p)) + integer(plane.d());
    const auto coordinate = [&](const Integer& start, const Integer& step) {
        return (start * w).subtract_product(value, step);
    };
    return {{coordinate(p.x, direction.x), coordinate(p.y, direction.y), coordinate(p.z, direction.z)}, w};
}

/// Three planes, by Cramer's rule.
inline Fraction meet(const Plane& first, const Plane& second, const Plane& third) {
    const std::array<const Plane*, 3> planes{&first, &second, &third};
    const auto column = [&](int axis) {
        const auto entry = [&](const Plane& plane) {
            return axis == 3 ? Integer(-integer(plane.d())) : integer(plane.normal(axis));
        };
        return Vector{entry(*planes[0]), entry(*planes[1]), entry(*planes[2])};
    };
    const Vector a = column(0), b = column(1), c = column(2), d = column(3);
    return {{determinant(d, b, c), determinant(a, d, c), determinant(a, b, d)}, determinant(a, b, c)};
}

inline Sign side_of(const Plane& plane, const Fraction& p) {
    return sign(dot(normal(plane), p.v).add_product(integer(plane.d()), p.w)) * sign(p.w);
}
inline Sign side_of(const AxisPlane& plane, const Fraction& p) {
    return sign(2 * p[plane.axis] - plane.twice * p.w) * sign(p.w);
}
inline Sign compare_coordinate(int axis, const Fraction& p, const Fraction& q) {
    return sign((p[axis] * q.w).subtract_product(q[axis], p.w)) * sign(p.w) * sign(q.w);
}
inline Sign compare(const Fraction& p, const Fraction& q) {
    for (int axis = 0; axis < 3; ++axis)
        if (const Sign s = compare_coordinate(axis, p, q); s != Sign::zero) return s;
    return Sign::zero;
}
inline Sign orient2d(int axis, const Fraction& p, const Fraction& q, const Fraction& r) {
    const auto row = [&](const Fraction& point) {
        return Vector{point[(axis + 1) % 3], point[(axis + 2) % 3], point.w};
    };
    return sign(determinant(row(p), row(q), row(r))) * sign(p.w) * sign(q.w) * sign(r.w);
}

/// Whether the kernel's point is the oracle's and its approximations are as good as they claim.
template <int NumeratorBits, int WeightBits>
bool same(const HomogeneousPoint<NumeratorBits, WeightBits>& p, const Fraction& q) {
    if (p.weight().sign() != Sign::positive) return false;
    for (int axis = 0; axis < 3; ++axis) {
        if (integer(p.numerator(axis)) * q.w != q[axis] * integer(p.weight())) return false;
        // |approximation - x/w| <= 2^-51 |x/w|, all of it times w and a power of two.
        int exponent = 0;
        const double mantissa = std::frexp(p.approximation(axis), &exponent);
        Integer approximation = Integer(static_cast<std::int64_t>(std::ldexp(mantissa, 53)));
        Integer scale = 1;
        if (exponent >= 53)
            approximation *= Integer(1) << (exponent - 53);
        else
            scale <<= 53 - exponent;
        const Integer error = abs(approximation * q.w - q[axis] * scale);
        if ((error << 51) > abs(q[axis] * scale)) return false;
    }
    return true;
}

}  // namespace octavo::exact::oracle
