// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>

// The 64 518 directions that bounding planes may have, each an integer vector (a, b, c) with
// |a| + |b| + |c| = 127: the surface of an octahedron.
//
// Problem: a plane must be stored in few bytes and still be tested exactly. Idea: a unit vector rounded to some
// bits has no exact meaning; an integer vector has one, and none needs to be a unit vector. On the octahedron the
// codes are spread evenly enough (neighbours are 0.45° to 0.8° apart), and with points of 16 bits every scalar
// product, and every part of its sum, stays within ±127 · 2^16 < 2^23.
//
// The code of (a, b, c) is 255 (i + 127) + (j + 127): the lower half of the octahedron is folded outwards over
// the edges of the upper one, i.e. (i, j) = (a, b) when c >= 0 and otherwise (s(a) (127 − |b|), s(b) (127 − |a|)).
// Source of the folding: Q. Meyer and others, On floating-point normal vectors, 2010.

namespace octavo::bp_octree {

inline constexpr int direction_length = 127;  ///< |a| + |b| + |c|
inline constexpr int direction_codes = 255 * 255;

using DirectionCode = std::uint16_t;

struct Direction {
    std::int32_t a = 0, b = 0, c = 0;
    std::int32_t operator[](int axis) const { return axis == 0 ? a : axis == 1 ? b : c; }
    friend bool operator==(const Direction&, const Direction&) = default;
};

constexpr int magnitude(int v) { return v < 0 ? -v : v; }

constexpr Direction direction_of(DirectionCode code) {
    const int i = code / 255 - direction_length, j = code % 255 - direction_length;
    const int c = direction_length - magnitude(i) - magnitude(j);
    if (c >= 0) return {i, j, c};
    return {(i < 0 ? -1 : 1) * (direction_length - magnitude(j)),
            (j < 0 ? -1 : 1) * (direction_length - magnitude(i)), c};
}

constexpr DirectionCode code_of(Direction d) {
    int i = d.a, j = d.b;
    if (d.c < 0) {
        i = (d.a < 0 ? -1 : 1) * (direction_length - magnitude(d.b));
        j = (d.b < 0 ? -1 : 1) * (direction_length - magnitude(d.a));
    }
    return static_cast<DirectionCode>(255 * (i + direction_length) + (j + direction_length));
}

/// A direction near the vector (x, y, z), which must not be zero.
inline Direction nearest_direction(double x, double y, double z) {
    const double scale = direction_length / (std::fabs(x) + std::fabs(y) + std::fabs(z));
    int a = static_cast<int>(std::lround(x * scale)), b = static_cast<int>(std::lround(y * scale));
    // Rounding both up can exceed the length by one; the larger one gives way.
    if (magnitude(a) + magnitude(b) > direction_length)
        (magnitude(a) > magnitude(b) ? a : b) -= (magnitude(a) > magnitude(b) ? a : b) < 0 ? -1 : 1;
    const int c = direction_length - magnitude(a) - magnitude(b);
    return {a, b, z < 0 ? -c : c};
}

/// Sum of the positive components: the largest value of the direction on the unit cube; the least is this − 127.
constexpr std::int32_t positive_part(Direction d) {
    return (d.a > 0 ? d.a : 0) + (d.b > 0 ? d.b : 0) + (d.c > 0 ? d.c : 0);
}

}  // namespace octavo::bp_octree
