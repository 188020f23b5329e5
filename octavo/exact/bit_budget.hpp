// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/exact/point.hpp>

// How wide every exact number of the kernel can become, derived from the 26 bits of a coordinate.
//
// A width B means |value| < 2^B, so that the value needs B + 1 bits with its sign. A product adds widths, a
// sum of n terms adds ceil(log2 n). Nothing else is used: no bound below needs more than counting terms, and
// every type that stores one of these numbers repeats its width in a static_assert.
//
// Normals stay below 2^53, which is one bit less than the usual count (coordinate differences are taken as 27
// bits there, but two numbers of [0, 2^26) differ by less than 2^26). It pays twice: normals are exact
// doubles, and the numerators of three-plane points fit three 64-bit limbs instead of four.

namespace octavo::exact::budget {

/// Width of a sum of `terms` numbers of width `bits`.
constexpr int sum(int terms, int bits) {
    int log = 0;
    while ((1 << log) < terms) ++log;
    return bits + log;
}

constexpr int greater(int first, int second) { return first > second ? first : second; }

/// 64-bit limbs that hold a signed number of width `bits`.
constexpr int limbs(int bits) { return (bits + 1 + 63) / 64; }

inline constexpr int coordinate = coordinate_bits;          // 26: p
inline constexpr int edge = coordinate;                     // 26: q - p
inline constexpr int normal = sum(2, edge + edge);          // 53: (q - p) x (r - p)
inline constexpr int offset = sum(3, normal + coordinate);  // 81: d = -n.p
inline constexpr int side = sum(2, offset);  // 82: n.p + d, also when the plane misses the universe
inline constexpr int orientation = sum(3, normal + edge);  // 81: (s - p).((q - p) x (r - p))

// A point where the line through two lattice points p, q meets a plane: w = n.(q - p), x = p w - s(p) (q -
// p).
inline constexpr int edge_weight = sum(3, normal + edge);                                      // 81
inline constexpr int edge_numerator = sum(2, greater(coordinate + edge_weight, side + edge));  // 109

// The line of two planes, m = n1 x n2 and k = d1 n2 - d2 n1, and the point where it meets a third plane:
// w = n3.m, x = -(d3 m + k x n3).
inline constexpr int line_direction = sum(2, normal + normal);         // 107
inline constexpr int line_moment = sum(2, offset + normal);            // 135
inline constexpr int triple_weight = sum(3, normal + line_direction);  // 162
inline constexpr int triple_numerator =
    sum(3, greater(offset + line_direction, line_moment + normal));  // 190

// The point where two planes meet one across an axis at t / 2, |t| <= 2^27: e = n t + 2 d for either, w = 2 m,
// x = t m along the axis, else n1 e2 - n2 e1.
inline constexpr int axis_coordinate = coordinate + 2;                                     // 28: t
inline constexpr int axis_offset = sum(2, greater(normal + axis_coordinate, offset + 1));  // 83
inline constexpr int axis_weight = line_direction + 1;                                     // 108
inline constexpr int axis_numerator =
    greater(axis_coordinate + line_direction, sum(2, normal + axis_offset));  // 137

/// n.x + d w for a homogeneous point: 164 for an edge point, 245 for a three-plane point.
constexpr int side_of_point(int numerator, int weight) {
    return sum(4, greater(normal + numerator, offset + weight));
}

/// x1 w2 - x2 w1: 353 for two three-plane points.
constexpr int difference(int numerator1, int weight1, int numerator2, int weight2) {
    return sum(2, greater(numerator1 + weight2, numerator2 + weight1));
}

/// The 3x3 determinant of (x, y, w) of three points: 545 for three three-plane points.
constexpr int orientation_in_plane(int numerator1, int weight1, int numerator2, int weight2, int numerator3,
                                   int weight3) {
    const int last = numerator1 + numerator2 + weight3;
    const int middle = numerator1 + weight2 + numerator3;
    const int first = weight1 + numerator2 + numerator3;
    return sum(6, greater(last, greater(middle, first)));
}

static_assert(normal == 53, "a normal is an exact double");
static_assert(offset == 81 && side == 82 && orientation == 81, "sides of lattice points fit int128");
static_assert(limbs(edge_numerator) == 2 && limbs(edge_weight) == 2, "an edge point is four 128-bit numbers");
static_assert(limbs(line_direction) == 2 && limbs(line_moment) == 3);
static_assert(limbs(triple_numerator) == 3 && limbs(triple_weight) == 3, "four 192-bit numbers");
static_assert(limbs(side_of_point(edge_numerator, edge_weight)) == 3);
static_assert(limbs(side_of_point(triple_numerator, triple_weight)) == 4, "side of a plane fits 256 bits");

}  // namespace octavo::exact::budget
