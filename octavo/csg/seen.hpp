// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/csg/octant_colors.hpp>
#include <octavo/csg/point_colors.hpp>
#include <octavo/csg/program.hpp>

// What is seen of a solid in the eight octants of a cell: their colours, and on which side of the surface points of
// them lie. Fits fold_words.hpp, as does brick_seen.hpp for the 64 cells of a brick.

namespace octavo::csg {

struct Seen {
    using Cells = std::uint8_t;

    OctantColors octants;
    PointColors points;

    static constexpr Seen none() { return {OctantColors::all_white(), PointColors::all_outside()}; }
    static constexpr Seen all() { return {OctantColors::all_black(), PointColors::all_inside()}; }

    /// Cells of `needed` that this, of the operands so far, does not settle. In a symmetric difference nothing does,
    /// and the colours of the rest are needed for pruning even where one operand is gray.
    static bool any(Cells cells) { return cells != 0; }
    Cells unsettled(word::Operation operation, Cells needed) const {
        const std::uint8_t settled = operation == word::union_of       ? octants.black
                                     : operation == word::intersection ? octants.white
                                                                       : std::uint8_t{0};
        return needed & static_cast<std::uint8_t>(~settled);
    }
    /// Operands that were not looked at could still say something of a point.
    void forget_points(word::Operation operation) {
        (operation == word::union_of ? points.outside : points.inside) = 0;
    }
};
inline Seen complement(const Seen& a) { return {complement(a.octants), complement(a.points)}; }
inline Seen unite(const Seen& a, const Seen& b) {
    return {unite(a.octants, b.octants), unite(a.points, b.points)};
}
inline Seen intersect(const Seen& a, const Seen& b) {
    return {intersect(a.octants, b.octants), intersect(a.points, b.points)};
}
inline Seen symmetric_difference(const Seen& a, const Seen& b) {
    return {symmetric_difference(a.octants, b.octants), symmetric_difference(a.points, b.points)};
}

}  // namespace octavo::csg
