// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <octavo/bsp/clip.hpp>
#include <octavo/bsp/fragment.hpp>
#include <octavo/bsp/tree.hpp>

// From a tree back to faces: what of each node's plane lies between inside and outside.
//
// A node's plane is cut to the cell and to the sides of the nodes above it; that polygon goes down both sub-trees of
// the node. Where one side answers in and the other out, it is a face; it looks to the side that is out. Polygons
// that no cut decides about stay whole.
// Cost: about 3 µs a node. Carrying convex polyhedra down the tree instead, as Nehring-Wirxel, Trettner and Kobbelt
// do, saves the cuts by the nodes above but has to copy and cut the polyhedra: 600 to 850 bytes a node.

namespace octavo::bsp {

/// Extracts one boundary after the other and keeps its memory.
class BoundaryExtractor {
  public:
    /// Appends the faces of the tree's solid inside the cell, which is that of the tree's root.
    void extract(FragmentPool& pool, const octree::Cell& cell, const Tree& tree,
                 std::vector<Fragment>& faces);

  private:
    struct Step {
        std::int32_t node;
        std::uint32_t depth;  ///< of the path above it
        bool is_front;        ///< of its parent
    };
    struct Side {
        PlaneId plane;
        bool is_front;
    };

    Fragment polygon(FragmentPool& pool, const octree::Cell& cell, PlaneId plane);
    void add_faces(FragmentPool& pool, const Tree& tree, const Node& node, const Fragment& polygon,
                   std::vector<Fragment>& faces);

    std::vector<Step> steps_;
    std::vector<Side> path_;
    std::vector<Fragment> front_in_;
    Clipper clipper_;
};

}  // namespace octavo::bsp
