// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>

// A brick: the 4 × 4 × 4 cells two levels below a cell, and their 5 × 5 × 5 corners, as bits of one SIMD register.
//
// Layer k holds what lies k quarters of the brick's side above its floor, bit i + 5 j of it what lies i and j quarters
// along x and y. A corner's bit is also that of the cell of which it is the lowest corner, so cells use i, j, k < 4.
// Set operations on 64 cells or 125 points are one operation of eight 32-bit lanes. The register is a vector type and
// not an array, because writing lanes one by one and reading all of them waits for the memory in between; Layers are
// handed from file to file by reference or within structures only, since registers of that size have no stable ABI.

namespace octavo::csg {

struct Layers {
    using Lanes = std::uint32_t __attribute__((vector_size(32)));
    Lanes layer{};

    static constexpr std::uint32_t all_corners_of_layer = (std::uint32_t{1} << 25) - 1;
    static constexpr std::uint32_t all_cells_of_layer = 0x7BDEF;

    static constexpr Layers corners() {
        constexpr std::uint32_t l = all_corners_of_layer;
        return {Lanes{l, l, l, l, l, 0, 0, 0}};
    }
    static constexpr Layers cells() {
        constexpr std::uint32_t l = all_cells_of_layer;
        return {Lanes{l, l, l, l, 0, 0, 0, 0}};
    }

    bool any() const {
        std::uint64_t words[4];
        static_assert(sizeof words == sizeof layer);
        std::memcpy(words, &layer, sizeof words);
        return (words[0] | words[1] | words[2] | words[3]) != 0;
    }
    /// How many of the bits of cells are set.
    int count_cells() const {
        std::uint64_t words[2];
        std::memcpy(words, &layer, sizeof words);
        return std::popcount(words[0]) + std::popcount(words[1]);
    }
    friend bool operator==(const Layers& a, const Layers& b) { return !Layers{a.layer ^ b.layer}.any(); }
};

inline Layers operator&(const Layers& a, const Layers& b) { return {a.layer & b.layer}; }
inline Layers operator|(const Layers& a, const Layers& b) { return {a.layer | b.layer}; }
inline Layers operator^(const Layers& a, const Layers& b) { return {a.layer ^ b.layer}; }
/// What is in `a` and not in `b`.
inline Layers without(const Layers& a, const Layers& b) { return {a.layer & ~b.layer}; }

/// The cells that have one of these corners.
inline Layers cells_with_corner(const Layers& corners) {
    const Layers::Lanes along_x = corners.layer | corners.layer >> 1, flat = along_x | along_x >> 5;
    const Layers::Lanes above = __builtin_shufflevector(flat, flat, 1, 2, 3, 4, 5, 6, 7, 0);
    return {(flat | above) & Layers::cells().layer};
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
    void add_to(Layers& cells) const { cells.layer[z] |= std::uint32_t{1} << bit(); }
    void take_from(Layers& cells) const { cells.layer[z] &= ~(std::uint32_t{1} << bit()); }
};

/// Calls `visit` with each of some cells.
template <class Visit>
void for_each_cell(const Layers& cells, const Visit& visit) {
    std::uint64_t halves[2];
    std::memcpy(halves, &cells.layer, sizeof halves);
    for (std::uint32_t half = 0; half < 2; ++half)
        for (std::uint64_t bits = halves[half]; bits != 0; bits &= bits - 1) {
            const auto bit = static_cast<std::uint32_t>(std::countr_zero(bits)), in_layer = bit % 32;
            visit(BrickCell{in_layer % 5, in_layer / 5, 2 * half + bit / 32});
        }
}

/// The 64 cells of each of two sets as bits in Morton order.
struct InMortonOrder {
    std::uint64_t first, second;

    InMortonOrder(const Layers& a, const Layers& b) {
        // Lanes are the four layers of both.
        Layers::Lanes l = __builtin_shufflevector(a.layer, b.layer, 0, 1, 2, 3, 8, 9, 10, 11);
        // Rows of four bits without gaps; then squares of two by two, the bits of i / 2 and of j % 2 exchanged.
        l = (l & 0xF) | (l >> 1 & 0xF0) | (l >> 2 & 0xF00) | (l >> 3 & 0xF000);
        const Layers::Lanes change = (l ^ l >> 2) & 0x0C0C;
        l ^= change | change << 2;
        // Room between squares for those of the layer above.
        l = (l | l << 8) & 0x00FF00FF;
        l = (l | l << 4) & 0x0F0F0F0F;
        const Layers::Lanes above = __builtin_shufflevector(l, l, 1, 0, 3, 2, 5, 4, 7, 6);
        l |= above << 4;
        first = l[0] | std::uint64_t{l[2]} << 32;
        second = l[4] | std::uint64_t{l[6]} << 32;
    }
};

}  // namespace octavo::csg
