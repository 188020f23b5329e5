// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <octavo/octree/color.hpp>

// The colours of the eight octants of a cell at once: one bit an octant.
//
// Three-valued logic on eight cells is then a handful of bit operations: an octant is white when its bit is set
// in `white`, black when it is set in `black`, gray when in neither. The rules are those of octree/color.hpp
// (table 3.1 of the source), which a test holds against these.

namespace octavo::csg {

struct OctantColors {
    std::uint8_t white = 0, black = 0;

    octree::Color operator[](int octant) const {
        if (white >> octant & 1) return octree::Color::white;
        return black >> octant & 1 ? octree::Color::black : octree::Color::gray;
    }
    void set(int octant, octree::Color color) {
        const auto bit = static_cast<std::uint8_t>(1U << octant);
        white = static_cast<std::uint8_t>((white & ~bit) | (color == octree::Color::white ? bit : 0));
        black = static_cast<std::uint8_t>((black & ~bit) | (color == octree::Color::black ? bit : 0));
    }
    std::uint8_t gray() const { return static_cast<std::uint8_t>(~(white | black)); }

    static constexpr OctantColors all_white() { return {0xFF, 0}; }
    static constexpr OctantColors all_black() { return {0, 0xFF}; }
    friend bool operator==(const OctantColors&, const OctantColors&) = default;
};

inline OctantColors complement(OctantColors a) { return {a.black, a.white}; }
inline OctantColors unite(OctantColors a, OctantColors b) {
    return {static_cast<std::uint8_t>(a.white & b.white), static_cast<std::uint8_t>(a.black | b.black)};
}
inline OctantColors intersect(OctantColors a, OctantColors b) {
    return {static_cast<std::uint8_t>(a.white | b.white), static_cast<std::uint8_t>(a.black & b.black)};
}
inline OctantColors symmetric_difference(OctantColors a, OctantColors b) {
    const int known = (a.white | a.black) & (b.white | b.black);
    const int odd = a.black ^ b.black;
    return {static_cast<std::uint8_t>(known & ~odd), static_cast<std::uint8_t>(known & odd)};
}

}  // namespace octavo::csg
