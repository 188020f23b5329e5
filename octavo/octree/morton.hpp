// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <compare>
#include <cstdint>
#include <optional>
#include <type_traits>

#include <octavo/base/check.hpp>
#include <octavo/exact/point.hpp>

#ifdef __BMI2__
#include <immintrin.h>
#endif

// Names of octree cells: one 64-bit word that says where a cell is and how large.
//
// The Morton code of a cell interleaves the bits of its position, x lowest: three bits a level, the root's
// children first. A CellKey holds the code of 21 levels, left-aligned, followed by a one bit directly after
// the last level in use and zeros after that:
//
//     bit 63                                                    0
//     zyx zyx zyx … zyx 1 000 … 000          level = 21 − (trailing zeros) / 3
//     └─ level triples ─┘
//
// So every cell of levels 0…21 has one word and no word names two cells (0 names none); disjoint cells
// compare in Morton order, a cell lies between its fourth and fifth child, and "is an ancestor of" is one
// range test. Source: G. M. Morton, A computer oriented geodetic data base, 1966; the marker bit as in
// Google's S2 library.
//
// Cells are half-open boxes on the lattice: low sides belong to a cell, high sides do not, so every lattice
// point of the universe lies in exactly one cell of a level. A cell of level L has side 2^(26 − L).

namespace octavo::octree {

inline constexpr int max_level = 21;
static_assert(3 * max_level + 1 == 64, "a code of every level and its marker fill one word");
static_assert(max_level <= exact::coordinate_bits, "cells have integer corners");

/// Side of a cell of this level in lattice units.
constexpr std::int32_t cell_side(int level) { return exact::universe_side >> level; }

/// The bits of `x`, `y` and `z` (21 each), interleaved with x lowest.
constexpr std::uint64_t spread_bits(std::uint64_t v) {
    // abc… → a00b00c…, doubling the gaps: 21 bits become 32+32, 16, 8, 4, 2 apart.
    v = (v | v << 32) & 0x001F00000000FFFFULL;
    v = (v | v << 16) & 0x001F0000FF0000FFULL;
    v = (v | v << 8) & 0x100F00F00F00F00FULL;
    v = (v | v << 4) & 0x10C30C30C30C30C3ULL;
    return (v | v << 2) & 0x1249249249249249ULL;
}

/// The inverse: every third bit of `v`, packed.
constexpr std::uint32_t pack_bits(std::uint64_t v) {
    v &= 0x1249249249249249ULL;
    v = (v | v >> 2) & 0x10C30C30C30C30C3ULL;
    v = (v | v >> 4) & 0x100F00F00F00F00FULL;
    v = (v | v >> 8) & 0x001F0000FF0000FFULL;
    v = (v | v >> 16) & 0x001F00000000FFFFULL;
    return static_cast<std::uint32_t>((v | v >> 32) & 0x1FFFFF);
}

constexpr std::uint64_t interleave(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
#ifdef __BMI2__
    if (!std::is_constant_evaluated())
        return _pdep_u64(x, 0x1249249249249249ULL) | _pdep_u64(y, 0x2492492492492492ULL) |
               _pdep_u64(z, 0x4924924924924924ULL);
#endif
    return spread_bits(x) | spread_bits(y) << 1 | spread_bits(z) << 2;
}

constexpr std::array<std::uint32_t, 3> deinterleave(std::uint64_t code) {
#ifdef __BMI2__
    if (!std::is_constant_evaluated())
        return {static_cast<std::uint32_t>(_pext_u64(code, 0x1249249249249249ULL)),
                static_cast<std::uint32_t>(_pext_u64(code, 0x2492492492492492ULL)),
                static_cast<std::uint32_t>(_pext_u64(code, 0x4924924924924924ULL))};
#endif
    return {pack_bits(code), pack_bits(code >> 1), pack_bits(code >> 2)};
}

class CellKey {
  public:
    /// No cell.
    constexpr CellKey() = default;

    static constexpr CellKey root() { return CellKey(1ULL << 63); }

    /// The cell of this level that contains the lattice point.
    static constexpr CellKey at(exact::Point p, int level) {
        constexpr int spare = exact::coordinate_bits - max_level;
        const std::uint64_t code =
            interleave(static_cast<std::uint32_t>(p.x) >> spare, static_cast<std::uint32_t>(p.y) >> spare,
                       static_cast<std::uint32_t>(p.z) >> spare);
        const std::uint64_t marker = marker_of(level);
        return CellKey(((code << 1) & (0 - (marker << 1))) | marker);
    }

    /// The cell of this level whose left-aligned 63-bit Morton code is `code`.
    static constexpr CellKey from_code(std::uint64_t code, int level) {
        return CellKey(code << 1 | marker_of(level));
    }

    /// The key whose word is `bits`; `is_valid` tells whether that is the name of a cell.
    static constexpr CellKey from_bits(std::uint64_t bits) { return CellKey(bits); }

    constexpr std::uint64_t bits() const { return bits_; }
    constexpr bool is_valid() const { return bits_ != 0 && std::countr_zero(bits_) % 3 == 0; }

    constexpr int level() const { return max_level - std::countr_zero(bits_) / 3; }
    constexpr std::uint64_t code() const { return (bits_ ^ marker()) >> 1; }

    /// The lowest lattice point of the cell, and its side.
    constexpr exact::Point low() const {
        constexpr int spare = exact::coordinate_bits - max_level;
        const std::array<std::uint32_t, 3> position = deinterleave(code());
        return {static_cast<std::int32_t>(position[0] << spare),
                static_cast<std::int32_t>(position[1] << spare),
                static_cast<std::int32_t>(position[2] << spare)};
    }
    constexpr std::int32_t side() const { return cell_side(level()); }

    /// Octant `index` of the cell: bit 0 is set in the high half of x, bit 1 of y, bit 2 of z.
    constexpr CellKey child(int index) const {
        const std::uint64_t step = marker() >> 3;
        return CellKey((bits_ ^ marker()) | static_cast<std::uint64_t>(index) * (step << 1) | step);
    }
    /// Which octant of its parent the cell is. Not for the root.
    constexpr int child_index() const { return static_cast<int>(bits_ >> (std::countr_zero(bits_) + 1)) & 7; }
    constexpr CellKey parent() const { return ancestor(level() - 1); }
    /// The cell of this level, at most its own, that contains the cell.
    constexpr CellKey ancestor(int level) const {
        const std::uint64_t marker = marker_of(level);
        return CellKey((bits_ & (0 - (marker << 1))) | marker);
    }

    /// The first and the last key of the cell's descendants, itself included.
    constexpr CellKey first_descendant() const { return CellKey(bits_ - (marker() - 1)); }
    constexpr CellKey last_descendant() const { return CellKey(bits_ + (marker() - 1)); }
    /// True when `other` is the cell or lies in it.
    constexpr bool contains(CellKey other) const {
        return first_descendant().bits_ <= other.bits_ && other.bits_ <= last_descendant().bits_;
    }
    /// Half-open: true for points of low sides, false for points of high sides.
    constexpr bool contains(exact::Point p) const { return contains(at(p, max_level)); }

    /// The cell of the same level `dx`, `dy`, `dz` sides away (−1, 0 or 1 each: one component set is a
    /// neighbour by face, two by edge, three by corner). None outside the universe.
    constexpr std::optional<CellKey> neighbour(int dx, int dy, int dz) const {
        const std::int64_t s = side();
        const exact::Point corner = low();
        const std::int64_t x = corner.x + dx * s, y = corner.y + dy * s, z = corner.z + dz * s;
        const auto inside = [](std::int64_t v) { return v >= 0 && v < exact::universe_side; };
        if (!inside(x) || !inside(y) || !inside(z)) return std::nullopt;
        return at({static_cast<std::int32_t>(x), static_cast<std::int32_t>(y), static_cast<std::int32_t>(z)},
                  level());
    }

    friend constexpr auto operator<=>(CellKey, CellKey) = default;

  private:
    constexpr explicit CellKey(std::uint64_t bits) : bits_(bits) {}

    static constexpr std::uint64_t marker_of(int level) { return 1ULL << (3 * (max_level - level)); }
    constexpr std::uint64_t marker() const { return bits_ & (0 - bits_); }

    std::uint64_t bits_ = 0;
};

/// Depth-first order: a cell directly before its descendants, siblings by octant.
struct DepthFirst {
    constexpr bool operator()(CellKey a, CellKey b) const {
        const std::uint64_t first_a = a.first_descendant().bits(), first_b = b.first_descendant().bits();
        return first_a != first_b ? first_a < first_b : a.level() < b.level();
    }
};

/// Breadth-first order: by level, then by Morton code.
struct BreadthFirst {
    constexpr bool operator()(CellKey a, CellKey b) const {
        return a.level() != b.level() ? a.level() < b.level() : a < b;
    }
};

}  // namespace octavo::octree
