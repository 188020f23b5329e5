// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>

#ifdef __SSE2__
#include <immintrin.h>
#endif

#include <octavo/classic/facet.hpp>
#include <octavo/octree/cell.hpp>

// Which of the eight octants of a cell a facet touches, exactly.
//
// Two convex bodies are apart iff one of finitely many axes separates them: for a box and a triangle the three box
// axes, the normal, and the nine cross products of box edges with triangle edges. The linear form of each axis is
// evaluated once for the parent cell; an octant's value is that plus one of two constants an axis, so that eight
// tests cost little more than one. Work in two steps: `Bounds` compares bounds, which decides most pairs high up in
// the tree, and `touched_octants` does the other ten axes for four facets at a time, one facet a SIMD lane.
//
// Exactness: all values of the nine cross products are edge functions of a projected triangle at lattice points of
// the universe, products of 26-bit differences: at most 2^53 in magnitude, so doubles hold them exactly. The
// normal's components are exact doubles too; its form may need 81 bits, so there the doubles are a filter with a
// proved bound and the undecided rest (an octant's corner in the facet's plane, mostly) is redone in 128 bits.
//
// What "touches" means:
//   Touch::interior   the facet meets the open octant. A facet in a wall between octants touches neither. This is
//                     the finest rule for which an untouched cell is all inside or all outside: the classic octree.
//   Touch::half_open  the facet meets the octant with its low sides but without its high sides: what a query needs
//                     that asks for the facets through a point. An infinitely small step of the high sides inwards
//                     turns this into the closed test, so only "<" and "≤" differ between the rules, by the signs of
//                     the axis.
//
// Cost: about 10 ns a pair for the bounds and 20 ns for the rest (bench/micro/octree_bench.cpp).
// Source: T. Akenine-Möller, Fast 3D triangle-box overlap testing, 2001; M. Schwarz and H.-P. Seidel, Fast parallel
// surface and solid voxelization, 2010 (edge functions with per-triangle constants); integers and the octant trick
// are ours.

namespace octavo::classic {

enum class Touch : std::uint8_t { interior, half_open };

/// A set of octants: bit i for octant i.
using OctantSet = std::uint8_t;

/// What the bounds of a facet say about a cell that it touches.
struct Bounds {
    OctantSet octants;  ///< octants that the bounds touch: a superset of those that the facet touches
    bool is_exact;      ///< `octants` is the answer already
    std::uint8_t
        steps;  ///< the steps between low corners of octants that the facet may cross, see octant_steps
};

/// The seven axis-parallel steps that join the low corners of the octants: step i goes from octant `from` to octant
/// `from + (1 << axis)`, and every octant is reached from octant 0 by the steps before it.
struct OctantStep {
    std::uint8_t from, axis;
};
inline constexpr std::array<OctantStep, 7> octant_steps{
    {{0, 0}, {0, 1}, {1, 1}, {0, 2}, {1, 2}, {2, 2}, {3, 2}}};

namespace octant_detail {

/// Octants whose half on each axis is allowed: bits 0–2 allow the low half on x, y, z, bits 3–5 the high half.
constexpr std::array<OctantSet, 64> make_halves_table() {
    std::array<OctantSet, 64> table{};
    for (unsigned halves = 0; halves < 64; ++halves)
        for (unsigned octant = 0; octant < 8; ++octant) {
            bool allowed = true;
            for (unsigned axis = 0; axis < 3; ++axis)
                allowed = allowed && (halves >> (axis + (octant >> axis & 1 ? 3 : 0)) & 1);
            if (allowed) table[halves] = static_cast<OctantSet>(table[halves] | 1U << octant);
        }
    return table;
}

/// Steps whose line may meet the bounds: bits 0–2 tell that the low side's coordinate on x, y, z (displaced a little
/// upwards) lies within the bounds, bits 3–5 the same for the middle.
constexpr std::array<std::uint8_t, 64> make_steps_table() {
    std::array<std::uint8_t, 64> table{};
    for (unsigned lines = 0; lines < 64; ++lines)
        for (unsigned step = 0; step < octant_steps.size(); ++step) {
            bool meets = true;
            for (unsigned axis = 0; axis < 3; ++axis)
                if (axis != octant_steps[step].axis)
                    meets =
                        meets && (lines >> (axis + (octant_steps[step].from >> axis & 1U ? 3U : 0U)) & 1U);
            if (meets) table[lines] = static_cast<std::uint8_t>(table[lines] | 1U << step);
        }
    return table;
}

inline constexpr std::array<OctantSet, 64> halves_table = make_halves_table();
inline constexpr std::array<std::uint8_t, 64> steps_table = make_steps_table();

}  // namespace octant_detail

/// A cell prepared for comparing bounds with it and its octants.
template <Touch touch>
class OctantFrame {
  public:
    explicit OctantFrame(const octree::Cell& cell) {
        const exact::Point low = cell.low, middle = cell.centre(), high = cell.high();
        low_ = {low.x, low.y, low.z, 0};
        middle_ = {middle.x, middle.y, middle.z, 0};
        high_ = {high.x, high.y, high.z, 0};
    }

    /// The facet must touch the cell.
    Bounds bounds(const Facet& facet) const {
        const Comparison low = compare(facet.low.data()), high = compare(facet.high.data());
        // Half-open: the high half owns the middle, and the facet's bounds are closed.
        const unsigned in_low = low.below_middle,
                       in_high = touch == Touch::interior ? high.above_middle : 7 & ~high.below_middle;
        const OctantSet octants = octant_detail::halves_table[in_low | in_high << 3];
        // A displaced coordinate v + ε lies within [low, high] iff low ≤ v < high.
        const unsigned lines =
            (7 & ~low.above_low & high.above_low) | (7 & ~low.above_middle & high.above_middle) << 3;
        const bool one = (octants & (octants - 1)) == 0;
        // Two octants side by side and nothing of the facet outside the cell: it has points in both.
        const unsigned beyond = touch == Touch::interior ? high.above_high : 7 & ~high.below_high;
        const bool within = (low.below_low | beyond) == 0;
        const OctantSet rest = octants & (octants - 1);
        return {octants, one || (within && (rest & (rest - 1)) == 0), octant_detail::steps_table[lines]};
    }

  private:
    /// One bit an axis.
    struct Comparison {
        unsigned below_low, above_low, below_middle, above_middle, below_high, above_high;
    };
    using Lanes = std::array<std::int32_t, 4>;

#ifdef __SSE2__
    // Reads four words of which the last belongs to the next field of Facet.
    Comparison compare(const std::int32_t* words) const {
        const __m128i v = _mm_loadu_si128(reinterpret_cast<const __m128i*>(words));
        const auto load = [](const Lanes& lanes) {
            return _mm_load_si128(reinterpret_cast<const __m128i*>(lanes.data()));
        };
        const auto bits = [](__m128i lanes) {
            return static_cast<unsigned>(_mm_movemask_ps(_mm_castsi128_ps(lanes))) & 7;
        };
        return {bits(_mm_cmplt_epi32(v, load(low_))),    bits(_mm_cmpgt_epi32(v, load(low_))),
                bits(_mm_cmplt_epi32(v, load(middle_))), bits(_mm_cmpgt_epi32(v, load(middle_))),
                bits(_mm_cmplt_epi32(v, load(high_))),   bits(_mm_cmpgt_epi32(v, load(high_)))};
    }
#else
    Comparison compare(const std::int32_t* words) const {
        Comparison result{};
        for (unsigned axis = 0; axis < 3; ++axis) {
            const std::int32_t v = words[axis];
            result.below_low |= unsigned{v < low_[axis]} << axis;
            result.above_low |= unsigned{v > low_[axis]} << axis;
            result.below_middle |= unsigned{v < middle_[axis]} << axis;
            result.above_middle |= unsigned{v > middle_[axis]} << axis;
            result.below_high |= unsigned{v < high_[axis]} << axis;
            result.above_high |= unsigned{v > high_[axis]} << axis;
        }
        return result;
    }
#endif

    alignas(16) Lanes low_, middle_, high_;
};

/// The octants of `cell` that each of up to four facets touches, as far as the edges and the normal can tell: to be
/// intersected with the octants of the bounds. Facets beyond the last may be repeated or null.
std::array<OctantSet, 4> touched_octants(const std::array<const Facet*, 4>& facets, const octree::Cell& cell,
                                         Touch touch);

/// The textbook test of one facet against one cell with 128-bit integers: the oracle of the fast one.
bool touches(const Facet& facet, const octree::Cell& cell, Touch touch);

}  // namespace octavo::classic
