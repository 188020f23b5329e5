// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstdint>

// A vertex of the lattice. Coordinates are integers in [0, 2^26): the universe of one job is the cube
// [0, 2^26)^3, so that differences fit 27 signed bits and every predicate below has a proved width.

namespace octavo::exact {

inline constexpr int coordinate_bits = 26;
inline constexpr std::int32_t universe_side = std::int32_t{1} << coordinate_bits;

struct Point {
    std::int32_t x = 0, y = 0, z = 0;

    constexpr std::int32_t operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
    friend constexpr auto operator<=>(const Point&, const Point&) = default;
};

}  // namespace octavo::exact
