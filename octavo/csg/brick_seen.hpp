// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/csg/layers.hpp>
#include <octavo/csg/program.hpp>

// What is seen of a solid in the 64 cells of a brick, as fold_words.hpp folds it: first their colours and their
// corners, then, where that leaves cells open, their colours again and which of them some point inside and some point
// outside is known to lie in.

namespace octavo::csg {

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
inline Layers neither(const LayerPair& a, const Layers& all) { return without(without(all, a.out), a.in); }

/// Cells of `needed` that operands of this colour leave open.
inline Layers unsettled(word::Operation operation, const LayerPair& cells, const Layers& needed) {
    if (operation == word::union_of) return without(needed, cells.in);
    return operation == word::intersection ? without(needed, cells.out) : needed;
}
/// An operand was not looked at, and could still say something of a point.
inline void forget(word::Operation operation, LayerPair& points) {
    (operation == word::union_of ? points.out : points.in) = {};
}

struct CornersSeen {
    using Cells = Layers;

    LayerPair cells;    ///< white and black
    LayerPair corners;  ///< outside and inside

    static constexpr CornersSeen none() { return {{Layers::cells(), {}}, {Layers::corners(), {}}}; }
    static constexpr CornersSeen all() { return {{{}, Layers::cells()}, {{}, Layers::corners()}}; }

    static bool any(const Cells& cells) { return cells.any(); }
    Cells unsettled(word::Operation operation, const Cells& needed) const {
        return csg::unsettled(operation, cells, needed);
    }
    void forget_points(word::Operation operation) { forget(operation, corners); }

    /// Cells that hold some point outside and some point inside. They need not be marked.
    LayerPair reached() const {
        return {cells.out | cells_with_corner(corners.out), cells.in | cells_with_corner(corners.in)};
    }
};
inline CornersSeen complement(const CornersSeen& a) { return {complement(a.cells), complement(a.corners)}; }
inline CornersSeen unite(const CornersSeen& a, const CornersSeen& b) {
    return {unite(a.cells, b.cells), unite(a.corners, b.corners)};
}
inline CornersSeen intersect(const CornersSeen& a, const CornersSeen& b) {
    return {intersect(a.cells, b.cells), intersect(a.corners, b.corners)};
}
inline CornersSeen symmetric_difference(const CornersSeen& a, const CornersSeen& b) {
    return {symmetric_difference(a.cells, b.cells), symmetric_difference(a.corners, b.corners)};
}

struct ReachSeen {
    using Cells = Layers;

    LayerPair cells;    ///< white and black
    LayerPair reached;  ///< with some point outside, and with some point inside; both may be

    static constexpr ReachSeen none() { return {{Layers::cells(), {}}, {Layers::cells(), {}}}; }
    static constexpr ReachSeen all() { return {{{}, Layers::cells()}, {{}, Layers::cells()}}; }

    static bool any(const Cells& cells) { return cells.any(); }
    Cells unsettled(word::Operation operation, const Cells& needed) const {
        return csg::unsettled(operation, cells, needed);
    }
    void forget_points(word::Operation operation) { forget(operation, reached); }
};
inline ReachSeen complement(const ReachSeen& a) { return {complement(a.cells), complement(a.reached)}; }
/// A point inside one is inside the union; one outside one is outside the union where the other is white.
inline ReachSeen unite(const ReachSeen& a, const ReachSeen& b) {
    return {unite(a.cells, b.cells),
            {(a.reached.out & b.cells.out) | (b.reached.out & a.cells.out), a.reached.in | b.reached.in}};
}
inline ReachSeen intersect(const ReachSeen& a, const ReachSeen& b) {
    return {intersect(a.cells, b.cells),
            {a.reached.out | b.reached.out, (a.reached.in & b.cells.in) | (b.reached.in & a.cells.in)}};
}
inline ReachSeen symmetric_difference(const ReachSeen& a, const ReachSeen& b) {
    const auto where_other_is_decided = [](const LayerPair& reached, const LayerPair& cells) {
        return LayerPair{(reached.out & cells.out) | (reached.in & cells.in),
                         (reached.out & cells.in) | (reached.in & cells.out)};
    };
    const LayerPair of_a = where_other_is_decided(a.reached, b.cells),
                    of_b = where_other_is_decided(b.reached, a.cells);
    return {symmetric_difference(a.cells, b.cells), {of_a.out | of_b.out, of_a.in | of_b.in}};
}

/// Both at once, of the bounding boxes of leaves and a point of each: what is seen before a leaf is looked at.
struct BoundsSeen {
    using Cells = Layers;

    CornersSeen corners;
    ReachSeen reach;

    static constexpr BoundsSeen none() { return {CornersSeen::none(), ReachSeen::none()}; }
    static constexpr BoundsSeen all() { return {CornersSeen::all(), ReachSeen::all()}; }

    static bool any(const Cells& cells) { return cells.any(); }
    Cells unsettled(word::Operation operation, const Cells& needed) const {
        return corners.unsettled(operation, needed);
    }
    void forget_points(word::Operation operation) {
        corners.forget_points(operation);
        reach.forget_points(operation);
    }
    /// Cells with some point outside and some point inside.
    Layers gray() const {
        const LayerPair by_corners = corners.reached();
        return (by_corners.out | reach.reached.out) & (by_corners.in | reach.reached.in);
    }
};
inline BoundsSeen complement(const BoundsSeen& a) { return {complement(a.corners), complement(a.reach)}; }
inline BoundsSeen unite(const BoundsSeen& a, const BoundsSeen& b) {
    return {unite(a.corners, b.corners), unite(a.reach, b.reach)};
}
inline BoundsSeen intersect(const BoundsSeen& a, const BoundsSeen& b) {
    return {intersect(a.corners, b.corners), intersect(a.reach, b.reach)};
}
inline BoundsSeen symmetric_difference(const BoundsSeen& a, const BoundsSeen& b) {
    return {symmetric_difference(a.corners, b.corners), symmetric_difference(a.reach, b.reach)};
}

}  // namespace octavo::csg
