// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/mesh/mesh.hpp>

// Boxes of boxes of triangles, eight at a time: where the search for the nearest triangle walks.
//
// Problem: a walk down a binary tree misses the cache at every step. Idea: nodes with eight children whose boxes are
// compared by one vector instruction an axis and side, and leaves of up to eight triangles that are measured side by
// side. All of it in floats, which are enough to *exclude*: boxes are rounded outwards, and each triangle carries a
// bound on the error of its measured distance. What is not excluded is decided exactly (triangle_distance.hpp).
//
// Built top down by binned surface area (I. Wald, On fast construction of SAH-based bounding volume hierarchies,
// 2007), counting full leaves of eight; a node takes eight parts by splitting its largest part again and again.
// Cost: 224 bytes a node, 384 a leaf: 55 to 65 bytes a triangle; O(n log n).

namespace octavo::query {

inline constexpr std::size_t tree_width = 8;

/// Eight floats that are computed with at once; GCC and Clang make AVX of it, or pairs of SSE or WebAssembly vectors.
using Float8 = float __attribute__((vector_size(32)));
using Int8 = std::int32_t __attribute__((vector_size(32)));

struct alignas(32) TreeNode {
    static constexpr std::uint32_t leaf_bit = 1U << 31;
    std::array<Float8, 3> low, high;                ///< of the children; unused ones are nowhere (low > high)
    std::array<std::uint32_t, tree_width> child{};  ///< a node, or with leaf_bit a leaf
};

/// Up to eight triangles a, a + u, a + v, relative to an origin of their own; unused places repeat the first one.
struct alignas(32) TreeLeaf {
    std::array<Float8, 3> a, u, v;
    Float8 error;  ///< of the distance, relative to the size of the numbers that it is computed from
    std::array<mesh::FaceIndex, tree_width> face{};
    std::array<std::int32_t, 3> origin{};
    float extent = 0;  ///< no coordinate of a, a + u, a + v is greater
    std::uint32_t count = 0;
};

struct ClosestTree {
    std::vector<TreeNode> nodes;  ///< the root first; empty only for an empty mesh
    std::vector<TreeLeaf> leaves;

    static ClosestTree build(const mesh::LatticeMesh& mesh);
    std::size_t memory_bytes() const {
        return nodes.capacity() * sizeof(TreeNode) + leaves.capacity() * sizeof(TreeLeaf);
    }
};

}  // namespace octavo::query
