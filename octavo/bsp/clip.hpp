// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <octavo/bsp/fragment.hpp>
#include <octavo/bsp/tree.hpp>

// Faces against a tree, and the boundary of an intersection from the boundaries of its operands.
//
// A fragment is sent down a tree and cut by the planes on its way; each piece ends in a leaf and has its label. A
// piece that lies in a node's plane has two answers, one for either side of it; the caller asks for the side that it
// wants to know about. A fragment all of whose pieces have one label is left in one piece: cuts that decide nothing
// do not show in the result. Where the solid touches itself, faces in three planes may cross along one line without
// deciding anything; a piece then has an edge in a plane of the tree, and who wants to know may have pieces apart.

namespace octavo::bsp {

/// A side of a fragment: of the solid whose face it is, or of the space outside.
enum class FaceSide : std::uint8_t { inner, outer };

/// Whether a fragment that is kept as a whole is in one piece also where a piece of it has an edge in a plane that does
/// not cut it.
enum class Whole : std::uint8_t { joined, apart_at_edges };

/// Clips one fragment after the other and keeps its memory.
class Clipper {
  public:
    /// Appends the parts of `fragment` whose `side` lies in the tree's solid to `kept`, and returns whether all of
    /// the fragment does.
    bool clip(FragmentPool& pool, const Fragment& fragment, const Tree& tree, FaceSide side,
              std::vector<Fragment>& kept, Child from = Tree::root, Whole whole = Whole::joined);

    /// Whether the last fragment had pieces in planes of the tree.
    bool met_coplanar() const { return met_coplanar_; }

  private:
    struct Task {
        Fragment fragment;
        Child child;
    };
    std::vector<Task> tasks_;
    bool met_coplanar_ = false;
};

/// What came of the operands' faces.
struct Intersection {
    bool all_of_first = true;   ///< the faces of the first operand are there, whole
    bool none_of_first = true;  ///< and none of them is
    bool all_of_second = true;  ///< the same for the second
    bool none_of_second = true;
};

/// Appends the boundary of the intersection of two solids in a cell, given both boundaries there and a tree of each,
/// which may reach further than the cell. Faces that both solids have, looking the same way, come from the first.
Intersection intersect(FragmentPool& pool, std::span<const Fragment> first, const Tree& first_tree,
                       std::span<const Fragment> second, const Tree& second_tree, Clipper& clipper,
                       std::vector<Fragment>& result);

}  // namespace octavo::bsp
