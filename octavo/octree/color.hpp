// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

// The three colours of a cell and the set operations on them.
//
// A cell is black when its interior lies in the solid, white when its interior lies outside, and gray when
// that is not decided: the cell's interior meets the surface, or nobody looked closer. The operations are the
// strongest ones that are right for every pair of solids with these colours ("gray" is "not known", so gray ∩
// gray is gray even for a solid and its complement). Source: F. Argüelles and others, octrees from CSG trees,
// table 3.1; the order white < gray < black makes ∪ a maximum and ∩ a minimum.

namespace octavo::octree {

enum class Color : std::uint8_t { white = 0, black = 1, gray = 2 };

namespace color_detail {

// Membership: outside 0, undecided 1, inside 2.
constexpr int membership(Color color) { return color == Color::white ? 0 : color == Color::gray ? 1 : 2; }
constexpr Color from_membership(int value) {
    return value == 0 ? Color::white : value == 1 ? Color::gray : Color::black;
}

}  // namespace color_detail

constexpr bool is_decided(Color color) { return color != Color::gray; }

/// The colour of a cell in the complement of the solid.
constexpr Color complement(Color a) { return color_detail::from_membership(2 - color_detail::membership(a)); }

/// The colour of a cell in the union of two solids in which it has colours `a` and `b`; the others likewise.
constexpr Color unite(Color a, Color b) {
    const int x = color_detail::membership(a), y = color_detail::membership(b);
    return color_detail::from_membership(x > y ? x : y);
}
constexpr Color intersect(Color a, Color b) {
    const int x = color_detail::membership(a), y = color_detail::membership(b);
    return color_detail::from_membership(x < y ? x : y);
}
constexpr Color subtract(Color a, Color b) { return intersect(a, complement(b)); }
constexpr Color symmetric_difference(Color a, Color b) {
    if (!is_decided(a) || !is_decided(b)) return Color::gray;
    return a == b ? Color::white : Color::black;
}

constexpr const char* name(Color color) {
    constexpr std::array<const char*, 3> names{"white", "black", "gray"};
    return names[static_cast<std::size_t>(color)];
}

}  // namespace octavo::octree
