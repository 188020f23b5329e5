// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/csg/layers.hpp>
#include <octavo/csg/octant_colors.hpp>
#include <octavo/csg/point_colors.hpp>
#include <octavo/csg/program.hpp>

// What is seen of a solid in several cells at once: their colours, and on which side of the surface points of them
// lie. Once for the eight octants of a cell, once for the 64 cells of a brick. Both fit fold_words.hpp.

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

/// Two sets that exclude each other: cells that are white and black, or corners outside and inside.
struct LayerPair {
    Layers out, in;
};
inline LayerPair complement(const LayerPair& a) { return {a.in, a.out}; }
inline LayerPair unite(const LayerPair& a, const LayerPair& b) { return {a.out & b.out, a.in | b.in}; }
inline LayerPair intersect(const LayerPair& a, const LayerPair& b) { return {a.out | b.out, a.in & b.in}; }
inline LayerPair symmetric_difference(const LayerPair& a, const LayerPair& b) {
    const Layers known = (a.out | a.in) & (b.out | b.in), odd = a.in ^ b.in;
    return {without(known, odd), known & odd};
}

struct BrickSeen {
    using Cells = Layers;

    LayerPair cells;    ///< white and black
    LayerPair corners;  ///< outside and inside
    LayerPair
        reached;  ///< cells with some point outside, and with some point inside; a corner need not be marked

    static BrickSeen none() {
        return {{Layers::cells(), {}}, {Layers::corners(), {}}, {Layers::cells(), {}}};
    }
    static BrickSeen all() { return {{{}, Layers::cells()}, {{}, Layers::corners()}, {{}, Layers::cells()}}; }

    static bool any(const Cells& cells) { return cells.any(); }
    Cells unsettled(word::Operation operation, const Cells& needed) const {
        if (operation == word::union_of) return without(needed, cells.in);
        return operation == word::intersection ? without(needed, cells.out) : needed;
    }
    void forget_points(word::Operation operation) {
        (operation == word::union_of ? corners.out : corners.in) = {};
        (operation == word::union_of ? reached.out : reached.in) = {};
    }
    Layers gray() const { return without(without(Layers::cells(), cells.out), cells.in); }
    /// Cells that no two of their points prove to be gray.
    Layers unproved() const {
        return without(gray(), (reached.out | cells_with_corner(corners.out)) &
                                   (reached.in | cells_with_corner(corners.in)));
    }
};
inline BrickSeen complement(const BrickSeen& a) {
    return {complement(a.cells), complement(a.corners), complement(a.reached)};
}
/// A point inside one is inside the union; one outside one is outside the union where the other is white.
inline BrickSeen unite(const BrickSeen& a, const BrickSeen& b) {
    return {unite(a.cells, b.cells),
            unite(a.corners, b.corners),
            {(a.reached.out & b.cells.out) | (b.reached.out & a.cells.out), a.reached.in | b.reached.in}};
}
inline BrickSeen intersect(const BrickSeen& a, const BrickSeen& b) {
    return {intersect(a.cells, b.cells),
            intersect(a.corners, b.corners),
            {a.reached.out | b.reached.out, (a.reached.in & b.cells.in) | (b.reached.in & a.cells.in)}};
}
inline BrickSeen symmetric_difference(const BrickSeen& a, const BrickSeen& b) {
    const auto where_other_is_decided = [](const LayerPair& reached, const LayerPair& cells) {
        return LayerPair{(reached.out & cells.out) | (reached.in & cells.in),
                         (reached.out & cells.in) | (reached.in & cells.out)};
    };
    const LayerPair of_a = where_other_is_decided(a.reached, b.cells),
                    of_b = where_other_is_decided(b.reached, a.cells);
    return {symmetric_difference(a.cells, b.cells),
            symmetric_difference(a.corners, b.corners),
            {of_a.out | of_b.out, of_a.in | of_b.in}};
}

}  // namespace octavo::csg
