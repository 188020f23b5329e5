// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <octavo/bsp/clip.hpp>
#include <octavo/bsp/fragment.hpp>
#include <octavo/bsp/node_polygons.hpp>
#include <octavo/bsp/tree.hpp>

// From a tree back to faces: what of each node's plane lies between inside and outside.
//
// The polygon in which a node's plane meets its region goes down both sub-trees of the node. Where one side answers in
// and the other out, it is a face; it looks to the side that is out. Polygons that no cut decides about stay whole.
// Cost: about 3 µs a node.

namespace octavo::bsp {

/// Extracts one boundary after the other and keeps its memory.
class BoundaryExtractor {
  public:
    /// Appends the faces of the tree's solid inside the cell, which is that of the tree's root.
    void extract(FragmentPool& pool, const octree::Cell& cell, const Tree& tree,
                 std::vector<Fragment>& faces);

  private:
    void add_faces(FragmentPool& pool, const Tree& tree, const Node& node, const Fragment& polygon,
                   std::vector<Fragment>& faces);

    NodePolygons polygons_;
    std::vector<Fragment> front_in_;
    Clipper clipper_;
};

}  // namespace octavo::bsp
