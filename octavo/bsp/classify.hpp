// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <octavo/bsp/fragment.hpp>
#include <octavo/bsp/tree.hpp>
#include <octavo/exact/sign.hpp>

// Where a point lies in a BSP tree: in, out, or on the boundary between.
//
// At a plane that holds the point both sides are asked; it is on the boundary when they differ. This is right also for
// points on walls of the cell. For let R be the region of a node with the point in its closure. Its plane meets the
// inside of R (tree.hpp), so if the point is in the plane too, it is in the closure of that convex section, and
// points on both sides of it in R come as near as one likes. So exactly those leaves are reached whose closure holds
// the point.
//
// Source: algorithm 3.3 in Argüelles, BSP-OctTree, after Thibault and Naylor 1987.

namespace octavo::bsp {

enum class Position : std::uint8_t { out, in, on };

constexpr Position position_of(Label label) { return label == Label::in ? Position::in : Position::out; }

/// The position of what lies at `side(plane)` of each plane of the tree, in the closure of the tree's cell.
template <class SideOfPlane>
Position classify(const Tree& tree, const SideOfPlane& side, Child from = Tree::root) {
    std::vector<Child> others;  // of planes that hold the point
    Child at = from;
    bool in = false, out = false;
    while (true) {
        while (!at.is_leaf()) {
            const Node& node = tree.nodes[at.index()];
            const exact::Sign sign = side(node.plane);
            if (sign == exact::Sign::zero) others.push_back(node.back);
            at = sign == exact::Sign::negative ? node.back : node.front;
        }
        (tree.label(at) == Label::in ? in : out) = true;
        if (in && out) return Position::on;
        if (others.empty()) return in ? Position::in : Position::out;
        at = others.back();
        others.pop_back();
    }
}

/// The label of a cell in which the tree's solid has no boundary: that of its centre, moved by an infinitely small
/// (ε, ε², ε³) off all planes. The cell lies in the closure of the tree's.
Label label_of_uniform_cell(const Tree& tree, const octree::Cell& cell, const PlaneTable& planes);

}  // namespace octavo::bsp
