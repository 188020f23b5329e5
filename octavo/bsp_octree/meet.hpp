// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include <octavo/bsp_octree/bsp_octree.hpp>
#include <octavo/bsp_octree/subdivide.hpp>

// The intersection of two nodes of one store, cell by cell; all set operations are this one, by complements.
//
// Both trees are descended together. Where one is white, or black, or both are the same node, the answer is an
// existing node and nothing below is looked at. Where one is a leaf and the other is split, the leaf's faces go down
// with it, cut to the octants, and its tree keeps answering where things are; nothing is rebuilt before it is known
// that it is needed. Where both have faces, each solid's are clipped by the other's tree, and what is left becomes a
// new leaf, or cells again when it is not simple. When one solid's faces are all there and the other's are not, the
// leaf stays as it is.
// Source: algorithms 3.7 and 3.8 in Argüelles, BSP-OctTree. We depart from it in clipping faces by trees and building
// a new tree of what is left, instead of merging the trees (3.4, 3.5) and then rebuilding what has become redundant.

namespace octavo::bsp_octree {

class Meet {
  public:
    /// Cells whose node is not that of the first operand are appended to `edit`, unless it is null.
    Meet(Workspace& workspace, Edit* edit) : workspace_(workspace), edit_(edit) {}

    NodeRef operator()(NodeRef first, NodeRef second);

  private:
    /// A node, or the part of a leaf that lies in the cell at hand.
    struct Operand {
        NodeRef node;
        bool is_part = false;
        Fragments faces{};  ///< of a part, or once they were needed
    };

    /// What a cell becomes. `unchanged`: the first operand; a part of a leaf is then not made a node.
    struct Outcome {
        NodeRef node;
        bool unchanged = false;
    };

    Outcome meet(const octree::Cell& cell, Operand& first, Operand& second);
    /// What needs no look at faces: a node that is there already.
    std::optional<Outcome> settle(Operand& first, Operand& second);
    Outcome meet_octants(const octree::Cell& cell, Operand& first, Operand& second);
    Outcome meet_leaves(const octree::Cell& cell, Operand& first, Operand& second);
    Outcome meet_faces(const octree::Cell& cell, Operand& first, Operand& second);
    NodeRef node_of(Operand& operand);
    std::array<Operand, 8> octants(const octree::Cell& cell, Operand& operand);
    /// Of a leaf, unless they are there; without any it is uniform.
    void load_faces(const octree::Cell& cell, Operand& operand);

    Workspace& workspace_;
    Edit* edit_;
    bsp::Clipper clipper_;
};

}  // namespace octavo::bsp_octree
