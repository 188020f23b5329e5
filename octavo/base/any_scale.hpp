// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include <octavo/base/vec3.hpp>

// Directions and determinants at any scale: products of two or three lengths overflow from 1e102 on and vanish below
// 1e-108. Multiplied by powers of two first they do neither, and are otherwise the same bit for bit.

namespace octavo {

/// v times the power of two that brings its largest component to [1/2, 1).
inline Vec3 scaled_near_one(Vec3 v) {
    int exponent = 0;
    std::frexp(std::fmax(std::fabs(v.x), std::fmax(std::fabs(v.y), std::fabs(v.z))), &exponent);
    return {std::ldexp(v.x, -exponent), std::ldexp(v.y, -exponent), std::ldexp(v.z, -exponent)};
}

/// The direction of a × b, of any length.
inline Vec3 cross_direction(Vec3 a, Vec3 b) { return cross(scaled_near_one(a), scaled_near_one(b)); }

/// The linear part with rows, then columns, scaled near one: the sign of the determinant stays.
Affine balanced(const Affine& map);

/// The sign of the determinant, decided without rounding: 0 where space is squeezed flat.
int determinant_sign(const Affine& map);

}  // namespace octavo
