// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <octavo/bsp/fragment.hpp>
#include <octavo/bsp/tree.hpp>
#include <octavo/render/eye.hpp>

// The faces in a leaf of an octree from the front to the back, by the leaf's BSP tree.
//
// At a node, what lies on the eye's side of the plane can hide what lies in the plane, and that can hide what lies on
// the other side; never the other way round. So the near side comes first, then the faces in the plane, then the far
// side. Faces go down the tree to the nodes of their planes, and are cut where they lie on both sides. Read backwards,
// it is the painter's order of the source.
// Sources: Fuchs, Kedem and Naylor, On visible surface generation by a priori tree structures, 1980; Argüelles,
// BSP-OctTree, section 3.4.

namespace octavo::render {

/// Sorts one leaf after the other and keeps its memory.
class TreeOrder {
  public:
    /// Appends the fragments, or their parts, to `sorted`: none hides one before it. Faces in one plane come with those
    /// that look at the viewer first.
    void sort(bsp::FragmentPool& pool, const bsp::Tree& tree, const Eye& eye,
              std::span<const bsp::Fragment> fragments, std::vector<bsp::Fragment>& sorted);

  private:
    struct Task {
        bsp::Child child;
        std::uint32_t begin;  ///< fragments from here to the end of the list
        bool is_settled;      ///< they lie in the plane of a node
    };
    void descend(bsp::FragmentPool& pool, const bsp::Node& node, const Eye& eye, std::uint32_t begin);

    std::vector<Task> tasks_;
    std::vector<bsp::Fragment> list_, near_, within_, far_;
};

}  // namespace octavo::render
