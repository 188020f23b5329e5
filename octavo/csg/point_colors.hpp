// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

// Colours at 35 points of a cell: the 27 corners of its octants and the eight middles of these.
//
// A point strictly inside a solid and one strictly outside, both of one octant, prove that the octant is gray,
// whatever the expression: each has a neighbourhood of its colour, and the octant's interior reaches into it. That
// settles most gray cells of the last level, and for a convex constraint the corners alone tell black (all inside)
// from the rest. One bit a point, so that set operations are bit operations on all points at once.

namespace octavo::csg {

/// One bit a point: i + 3 j + 9 k is the corner (i, j, k) half sides from the low corner, x fastest; 27 + n is the
/// middle of octant n. A point on a surface, or too near to it for rounding, is in neither mask.
struct PointColors {
    std::uint64_t outside = 0, inside = 0;

    static constexpr int corners = 27;
    static constexpr std::uint64_t all_corners = (std::uint64_t{1} << corners) - 1;
    static constexpr std::uint64_t all = (std::uint64_t{1} << (corners + 8)) - 1;

    static constexpr PointColors all_outside() { return {all, 0}; }
    static constexpr PointColors all_inside() { return {0, all}; }
    friend bool operator==(const PointColors&, const PointColors&) = default;
};

inline PointColors complement(PointColors a) { return {a.inside, a.outside}; }
inline PointColors unite(PointColors a, PointColors b) {
    return {a.outside & b.outside, a.inside | b.inside};
}
inline PointColors intersect(PointColors a, PointColors b) {
    return {a.outside | b.outside, a.inside & b.inside};
}
inline PointColors symmetric_difference(PointColors a, PointColors b) {
    const std::uint64_t known = (a.outside | a.inside) & (b.outside | b.inside), odd = a.inside ^ b.inside;
    return {known & ~odd, known & odd};
}

/// The octants that have one of these points for a corner, one bit each.
constexpr std::uint8_t octants_with_corner(std::uint64_t points) {
    // The eight corners of an octant are 0 or 1, plus 0 or 3, plus 0 or 9 bits above its lowest.
    auto corners = static_cast<std::uint32_t>(points & PointColors::all_corners);
    corners |= corners >> 1;
    corners |= corners >> 3;
    corners |= corners >> 9;
    return static_cast<std::uint8_t>((corners & 0x03) | (corners >> 1 & 0x0C) | (corners >> 5 & 0x30) |
                                     (corners >> 6 & 0xC0));
}
/// The octants that have one of these points at all.
constexpr std::uint8_t octants_with(std::uint64_t points) {
    return static_cast<std::uint8_t>(octants_with_corner(points) | points >> PointColors::corners);
}

/// The octants that have points on both sides, and so are gray.
inline std::uint8_t octants_on_both_sides(PointColors points) {
    return octants_with(points.inside) & octants_with(points.outside);
}

}  // namespace octavo::csg
