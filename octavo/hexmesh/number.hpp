// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <octavo/base/result.hpp>
#include <octavo/mesh/hex_mesh.hpp>

// Numbers the nodes of a balanced octree's cells and finds the hanging ones with their masters.
//
// Idea: no point is ever looked up. A corner of a cell lies in exactly one leaf (cells are half-open), its *home*. In a
// balanced tree it is the home's low corner or one of twelve places on the home's low edges and faces: so a node is
// (home, slot), thirteen bits a leaf say which slots are in use, and a running sum of their counts numbers all nodes,
// leaf by leaf, in an order that keeps neighbours together. Homes of a cell's corners are its neighbours on the high
// sides, which the walk of CellTree hands over. Only nodes on the high sides of the universe have no home; they
// are sorted.
//
// Hanging nodes are found from the larger cell: a used slot, or a used low corner of a smaller neighbour, in the
// middle of one of its edges or faces.
//
// Cost: two walks and one pass over the corners; besides the result 11 bytes a leaf.
// Compare: T. Isaac, C. Burstedde, L. C. Wilcox, O. Ghattas, Recursive algorithms for distributed forests of octrees,
// 2015, whose nodes come from a walk over all faces, edges and corners.

namespace octavo::hexmesh {

struct Numbering {
    std::vector<std::array<mesh::NodeIndex, 8>> corners;  ///< per kept leaf
    std::vector<exact::Point> nodes;
    std::vector<mesh::EdgeHangingNode> edge_hanging;
    std::vector<mesh::FaceHangingNode> face_hanging;
};

/// Numbers the corners of those `leaves` for which `kept` is not zero; an empty `kept` keeps all. The leaves fill
/// the universe, are sorted and are balanced. Only kept leaves make nodes hang.
/// Under balance by face alone masters may hang themselves, and only middles of edges and faces of kept cells are
/// listed. Errors: limit beyond 2^31 − 2 leaves or 2^32 − 1 nodes.
Result<Numbering> number_nodes(std::span<const octree::CellKey> leaves, std::vector<std::uint8_t> kept = {});

}  // namespace octavo::hexmesh
