// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/csg/octant_colors.hpp>
#include <octavo/csg/point_colors.hpp>
#include <octavo/csg/program.hpp>

// What is seen of a solid in the eight octants of a cell: their colours, and on which side of the surface points of
// them lie. Fits fold_words.hpp, as does brick_seen.hpp for the 64 cells of a brick.

namespace octavo::csg {

/// Cells of `needed` that operands of these colours do not settle. In a symmetric difference nothing does, and the
/// colours of the rest are needed for pruning even where one operand is gray.
inline std::uint8_t unsettled(word::Operation operation, OctantColors colors, std::uint8_t needed) {
    const std::uint8_t settled = operation == word::union_of       ? colors.black
                                 : operation == word::intersection ? colors.white
                                                                   : std::uint8_t{0};
    return needed & static_cast<std::uint8_t>(~settled);
}

/// The colours alone: all that is asked for above the last level.
struct ColorsSeen {
    using Cells = std::uint8_t;
    static constexpr bool has_points = false;

    OctantColors octants;

    static constexpr ColorsSeen none() { return {OctantColors::all_white()}; }
    static constexpr ColorsSeen all() { return {OctantColors::all_black()}; }
    static bool any(Cells cells) { return cells != 0; }
    Cells unsettled(word::Operation operation, Cells needed) const {
        return csg::unsettled(operation, octants, needed);
    }
    void forget_points(word::Operation) {}
};
inline ColorsSeen complement(ColorsSeen a) { return {complement(a.octants)}; }
inline ColorsSeen unite(ColorsSeen a, ColorsSeen b) { return {unite(a.octants, b.octants)}; }
inline ColorsSeen intersect(ColorsSeen a, ColorsSeen b) { return {intersect(a.octants, b.octants)}; }
inline ColorsSeen symmetric_difference(ColorsSeen a, ColorsSeen b) {
    return {symmetric_difference(a.octants, b.octants)};
}

struct Seen {
    using Cells = std::uint8_t;
    static constexpr bool has_points = true;

    OctantColors octants;
    PointColors points;

    static constexpr Seen none() { return {OctantColors::all_white(), PointColors::all_outside()}; }
    static constexpr Seen all() { return {OctantColors::all_black(), PointColors::all_inside()}; }

    static bool any(Cells cells) { return cells != 0; }
    Cells unsettled(word::Operation operation, Cells needed) const {
        return csg::unsettled(operation, octants, needed);
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
