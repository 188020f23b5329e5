// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/base/huge_page_allocator.hpp>
#include <octavo/mesh/mesh.hpp>
#include <octavo/query/lanes.hpp>

// Boxes of boxes of triangles, eight at a time: where the search for the nearest triangle walks.
//
// Problem: the nearest triangle of a point far off lies behind many boxes that stand nearer than their triangles,
// because boxes along the axes stand off a slanting surface by their own size. Idea: each child has a box that is
// turned so as to lie on its patch of surface (turned_box.hpp), and only a few remain. Nodes hold eight of them,
// compared side by side, leaves up to eight triangles, measured side by side. All in floats, which are enough to
// *exclude*: boxes are rounded outwards, and what is not excluded is decided exactly (triangle_distance.hpp), from the
// whole numbers that the leaves hold.
//
//     along the axes ┌──────┐   turned   ╱╲     a point at distance d looks into all boxes nearer than d:
//                    │    ╱ │           ╱╱      many of the thick ones, few of the thin ones
//                    │  ╱   │          ╱╱
//                    └──────┘          ╲╱
//
// Built top down by binned surface area (I. Wald, On fast construction of SAH-based bounding volume hierarchies,
// 2007), counting full leaves of eight; a node takes eight parts by splitting its largest part again and again. Parts
// are built side by side, each in arrays of its own, which are then joined in the order of a depth-first walk: the tree
// is the same for any number of threads.
// Cost: 288 bytes a node, 320 a leaf: 55 bytes a triangle, and once more while joining; O(n log n).

namespace octavo::query {

inline constexpr std::size_t tree_width = 8;

/// Eight boxes along turned axes. A point p lies in box i iff low ≤ axes · (p − origin) / 32767 ≤ high, in steps.
struct alignas(32) TreeNode {
    static constexpr std::uint32_t leaf_bit = 1U << 31;
    std::array<std::array<Short8, 3>, 3> axes;  ///< of unit length: 32767
    std::array<Short8, 3> low, high;
    std::array<std::uint32_t, tree_width> child;  ///< a node, or with leaf_bit a leaf; 0 for none
    std::array<std::int32_t, 3> origin;
    float step;  ///< lattice units
};

/// Up to eight triangles a, a + u, a + v in lattice units; unused places repeat the last one without its number.
struct alignas(32) TreeLeaf {
    static constexpr mesh::FaceIndex no_face = 0xffffffff;
    std::array<Int8, 3> a, u, v;
    std::array<mesh::FaceIndex, tree_width> face;
};

struct ClosestTree {
    template <class T>
    using Array = std::vector<T, HugePageAllocator<T>>;
    Array<TreeNode> nodes;  ///< the root first; empty only for an empty mesh
    Array<TreeLeaf> leaves;

    /// Cancelled, the tree is not complete.
    static ClosestTree build(const mesh::LatticeMesh& mesh, const Context& context = {});
    std::size_t memory_bytes() const {
        return nodes.capacity() * sizeof(TreeNode) + leaves.capacity() * sizeof(TreeLeaf);
    }
};

}  // namespace octavo::query
