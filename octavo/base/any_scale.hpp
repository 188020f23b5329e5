// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include <octavo/base/vec3.hpp>

// Directions and determinants at any scale: products of two or three lengths overflow from 1e102 on and vanish below
// 1e-108. Multiplied by powers of two first they do neither, and are otherwise the same bit for bit.
// What cancels in them is computed so that nothing is lost: rounded products leave nothing of the normal of two edges
// that enclose an angle of 2^-53, and move a side with an angle of 2^-40 by thousands of lattice units.

namespace octavo {

/// v times the power of two that brings its largest component to [1/2, 1).
inline Vec3 scaled_near_one(Vec3 v) {
    const double a = std::fabs(v.x), b = std::fabs(v.y), c = std::fabs(v.z);
    double largest = a > b ? a : b;
    if (c > largest) largest = c;
    // Where the power is a double it is written as one: that takes a tenth of the time.
    if (largest > 0x1p-1000 && largest < 0x1p1000) {
        const auto power =
            std::bit_cast<double>((std::uint64_t{2045} << 52) -
                                  (std::bit_cast<std::uint64_t>(largest) & (std::uint64_t{0x7FF} << 52)));
        return {v.x * power, v.y * power, v.z * power};
    }
    int exponent = 0;
    std::frexp(largest, &exponent);
    return {std::ldexp(v.x, -exponent), std::ldexp(v.y, -exponent), std::ldexp(v.z, -exponent)};
}

/// p q − r s to one and a half units in its last place, however much cancels (W. Kahan; the proof is C.-P. Jeannerod's,
/// N. Louvet's and J.-M. Muller's, 2013). Products must be doubles.
inline double difference_of_products(double p, double q, double r, double s) {
    const double second = r * s;
    return std::fma(p, q, -second) - std::fma(r, s, -second);
}

/// The direction of a × b, of any length; each component to two units in its last place.
inline Vec3 cross_direction(Vec3 a, Vec3 b) {
    a = scaled_near_one(a), b = scaled_near_one(b);
    return {difference_of_products(a.y, b.z, a.z, b.y), difference_of_products(a.z, b.x, a.x, b.z),
            difference_of_products(a.x, b.y, a.y, b.x)};
}

/// The linear part with rows, then columns, scaled near one: the sign of the determinant stays.
Affine balanced(const Affine& map);

/// The sign of the determinant, decided without rounding: 0 where space is squeezed flat.
int determinant_sign(const Affine& map);

}  // namespace octavo
