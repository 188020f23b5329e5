// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <octavo/bsp/plane_table.hpp>

// A BSP tree of planes of a table, as an array of nodes in preorder.
//
// A node halves its region by a plane; children are nodes or labelled leaves. The region of the root is a cell, and
// *every node's plane meets the inside of its region*: builders cut fragments to the region first. Classification of
// points on walls and planes relies on it (classify.hpp).
//
// Complement is a bit on whoever refers to the tree, not a change of it: labels are read through it.

namespace octavo::bsp {

enum class Label : std::uint8_t { out = 0, in = 1 };

constexpr Label opposite(Label label) { return label == Label::in ? Label::out : Label::in; }

/// A node's index in its tree, or a leaf.
struct Child {
    std::int32_t value = -1;

    static constexpr Child leaf(Label label) { return {-1 - static_cast<std::int32_t>(label)}; }
    static constexpr Child node(std::size_t index) { return {static_cast<std::int32_t>(index)}; }
    constexpr bool is_leaf() const { return value < 0; }
    constexpr Label label() const { return static_cast<Label>(-1 - value); }
    constexpr std::size_t index() const { return static_cast<std::size_t>(value); }
    friend constexpr bool operator==(Child, Child) = default;
};

struct Node {
    PlaneId plane = 0;
    Child front, back;  ///< where the plane's normal points, and the other side
    friend constexpr bool operator==(const Node&, const Node&) = default;
};

/// A tree with at least one node; the root is node 0.
struct Tree {
    std::span<const Node> nodes;
    bool complemented = false;

    static constexpr Child root = Child::node(0);
    Label label(Child leaf) const { return complemented ? opposite(leaf.label()) : leaf.label(); }
};

}  // namespace octavo::bsp
