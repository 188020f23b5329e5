// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <octavo/bsp/fragment.hpp>
#include <octavo/bsp/node_polygons.hpp>
#include <octavo/bsp/tree.hpp>

// Labels for the regions of a tree of faces that may cross, cover and nest one another.
//
// Problem: a region is labelled by the face that parts it from its neighbour, which is right where every face has
// outside before it and inside behind it. Where surfaces cross, inside is where they wind about more often than not at
// all, and no single face knows. Idea: all faces are in the tree, so winding numbers are constant in a region; and
// between two neighbours they differ by the faces between them. Each node gives one such pair of neighbours: a spot of
// its polygon is made so small that it lies in front of one region only, behind one region only, and each face in the
// plane covers all of it or nothing. A tree of n nodes has n + 1 regions, and its n pairs join the regions in front of
// each node with those behind it: so they join all, and the winding number of one of them gives every other.
//
// Nothing is rounded, and faces are cut by planes of the tree only: vertices are those of any other tree.
// Cost: about twice that of extracting the boundary, and for each node a look at the boxes of the faces in its plane.

namespace octavo::bsp {

/// Labels one tree after the other and keeps its memory.
class WindingLabels {
  public:
    /// Labels the leaves of the tree of all faces of a closed surface in a cell: in where it winds about at least once.
    /// The fragments are the parts in the cell of input triangles that the pool knows; they may overlap.
    /// `at_low_corner` is the winding number of the cell's low corner, moved by an infinitely small (ε, ε², ε³).
    /// Returns whether the labels were these before, all winding numbers are 0 or 1, and all of every face is between
    /// different ones.
    bool label(FragmentPool& pool, const octree::Cell& cell, std::span<const Fragment> fragments,
               std::span<Node> nodes, std::int32_t at_low_corner);

    /// A face and the box of its triangle, a unit larger than that: approximations of vertices are off by far less.
    struct Face {
        Fragment fragment;
        Box3 box;
    };

  private:
    using Leaf = std::uint32_t;  ///< 2 · node + (is in front of it)
    static constexpr std::uint32_t none = ~std::uint32_t{0};
    /// From a leaf to a neighbour of it.
    struct Step {
        Leaf to;
        std::int32_t change;  ///< of the winding number
        std::uint32_t next;   ///< step from the same leaf
    };

    void sort_by_plane(const FragmentPool& pool, std::span<const Fragment> fragments);
    std::span<const Face> faces_in(PlaneId plane) const;
    bool cancel(FragmentPool& pool) const;
    Leaf leaf_at(const exact::Point& corner, const PlaneTable& planes) const;
    Leaf leaf_beside(FragmentPool& pool, Fragment& spot, std::size_t node, bool is_front) const;
    void join(Leaf front, Leaf back, std::int32_t change);
    void spread(Leaf from, std::int32_t winding);
    bool put_labels(std::span<Node> nodes) const;

    std::span<const Node> nodes_;
    std::vector<Face> faces_;  ///< by plane
    NodePolygons polygons_;
    std::vector<std::uint32_t> first_step_;  ///< by leaf
    std::vector<Step> steps_;
    std::vector<std::int32_t> windings_;  ///< by leaf
    std::vector<Leaf> open_;
    std::vector<char> is_known_;
};

}  // namespace octavo::bsp
