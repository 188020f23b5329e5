// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <optional>

// A brick: the 4 × 4 × 4 cells two levels below a cell, and their 5 × 5 × 5 corners, as bits of one SIMD register.
//
// Layer k holds what lies k quarters of the brick's side above its floor, bit i + 5 j of it what lies i and j quarters
// along x and y. A corner's bit is also that of the cell of which it is the lowest corner, so cells use i, j, k < 4.
// Set operations on 64 cells or 125 points are one operation of eight 32-bit lanes; the loops below compile to it.

namespace octavo::csg {

struct Layers {
    alignas(32) std::array<std::uint32_t, 8> layer{};

    static constexpr std::uint32_t all_corners_of_layer = (std::uint32_t{1} << 25) - 1;
    static constexpr std::uint32_t all_cells_of_layer = 0x7BDEF;

    static constexpr Layers corners() {
        Layers result;
        for (std::size_t k = 0; k < 5; ++k) result.layer[k] = all_corners_of_layer;
        return result;
    }
    static constexpr Layers cells() {
        Layers result;
        for (std::size_t k = 0; k < 4; ++k) result.layer[k] = all_cells_of_layer;
        return result;
    }

    bool any() const {
        std::uint32_t sum = 0;
        for (const std::uint32_t l : layer) sum |= l;
        return sum != 0;
    }
    friend bool operator==(const Layers&, const Layers&) = default;
};

inline Layers operator&(Layers a, const Layers& b) {
    for (std::size_t k = 0; k < 8; ++k) a.layer[k] &= b.layer[k];
    return a;
}
inline Layers operator|(Layers a, const Layers& b) {
    for (std::size_t k = 0; k < 8; ++k) a.layer[k] |= b.layer[k];
    return a;
}
inline Layers operator^(Layers a, const Layers& b) {
    for (std::size_t k = 0; k < 8; ++k) a.layer[k] ^= b.layer[k];
    return a;
}
/// What is in `a` and not in `b`.
inline Layers without(Layers a, const Layers& b) {
    for (std::size_t k = 0; k < 8; ++k) a.layer[k] &= ~b.layer[k];
    return a;
}

/// The cells that have one of these corners.
inline Layers cells_with_corner(const Layers& corners) {
    Layers cells;
    std::array<std::uint32_t, 9> flat{};
    for (std::size_t k = 0; k < 8; ++k) {
        const std::uint32_t along_x = corners.layer[k] | corners.layer[k] >> 1;
        flat[k] = along_x | along_x >> 5;
    }
    for (std::size_t k = 0; k < 4; ++k) cells.layer[k] = (flat[k] | flat[k + 1]) & Layers::all_cells_of_layer;
    return cells;
}

/// A cell of the brick: (x, y, z) quarters from the low corner.
struct BrickCell {
    std::uint32_t x, y, z;

    /// Octant `inner` of octant `outer`.
    static constexpr BrickCell of(unsigned outer, unsigned inner) {
        return {2 * (outer & 1) + (inner & 1), 2 * (outer >> 1 & 1) + (inner >> 1 & 1),
                2 * (outer >> 2 & 1) + (inner >> 2 & 1)};
    }
    constexpr std::uint32_t bit() const { return x + 5 * y; }
    bool in(const Layers& cells) const { return (cells.layer[z] >> bit() & 1) != 0; }
    constexpr void add_to(Layers& cells) const { cells.layer[z] |= std::uint32_t{1} << bit(); }
    void take_from(Layers& cells) const { cells.layer[z] &= ~(std::uint32_t{1} << bit()); }
};

/// Takes the first of some cells out of them; none when there is none.
inline std::optional<BrickCell> take_first(Layers& cells) {
    for (std::uint32_t z = 0; z < 4; ++z) {
        std::uint32_t& square = cells.layer[z];
        if (square == 0) continue;
        const auto bit = static_cast<std::uint32_t>(std::countr_zero(square));
        square &= square - 1;
        return BrickCell{bit % 5, bit / 5, z};
    }
    return {};
}

/// The 64 cells as bits in Morton order.
inline std::uint64_t in_morton_order(const Layers& cells) {
    std::array<std::uint32_t, 4> layer{};
    for (std::size_t k = 0; k < 4; ++k) {
        std::uint32_t l = cells.layer[k];
        // Rows of four bits without gaps; then squares of two by two, the bits of i / 2 and of j % 2 exchanged.
        l = (l & 0xF) | (l >> 1 & 0xF0) | (l >> 2 & 0xF00) | (l >> 3 & 0xF000);
        const std::uint32_t change = (l ^ l >> 2) & 0x0C0C;
        l ^= change | change << 2;
        // Room between squares for those of the layer above.
        l = (l | l << 8) & 0x00FF00FF;
        layer[k] = (l | l << 4) & 0x0F0F0F0F;
    }
    const std::uint32_t low = layer[0] | layer[1] << 4, high = layer[2] | layer[3] << 4;
    return low | std::uint64_t{high} << 32;
}

}  // namespace octavo::csg
