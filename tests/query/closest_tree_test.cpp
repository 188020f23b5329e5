// SPDX-License-Identifier: Apache-2.0
#include <atomic>
#include <cstring>
#include <vector>

#include <gtest/gtest.h>

#include <octavo/mesh/shapes.hpp>
#include <octavo/mesh/snap.hpp>
#include <octavo/query/closest.hpp>
#include <octavo/query/closest_tree.hpp>

namespace octavo::query {
namespace {

/// Of 80 000 triangles: four levels of binary splits above what one task builds.
mesh::LatticeMesh large_mesh() { return mesh::snap(mesh::displaced_sphere(64))->mesh; }

template <class Array>
bool same_bytes(const Array& a, const Array& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
}

TEST(ClosestTree, IsTheSameForAnyNumberOfThreads) {
    const mesh::LatticeMesh mesh = large_mesh();
    Context context;
    context.threads = 1;
    const ClosestTree serial = ClosestTree::build(mesh, context);
    for (const int threads : {0, 2, 3}) {
        context.threads = threads;
        const ClosestTree tree = ClosestTree::build(mesh, context);
        EXPECT_TRUE(same_bytes(tree.nodes, serial.nodes)) << threads;
        EXPECT_TRUE(same_bytes(tree.leaves, serial.leaves)) << threads;
    }
}

TEST(ClosestTree, HoldsEveryTriangleOnceUnderItsRoot) {
    const mesh::LatticeMesh mesh = large_mesh();
    const ClosestTree tree = ClosestTree::build(mesh);
    std::vector<int> times(mesh.triangles.size());
    std::vector<std::uint32_t> open{0};
    std::size_t nodes = 0, leaves = 0;
    while (!open.empty()) {
        const TreeNode& node = tree.nodes.at(open.back());
        open.pop_back();
        ++nodes;
        for (const std::uint32_t child : node.child) {
            if (child == 0) continue;
            if ((child & TreeNode::leaf_bit) == 0) {
                open.push_back(child);
                continue;
            }
            ++leaves;
            for (const mesh::FaceIndex face : tree.leaves.at(child & ~TreeNode::leaf_bit).face)
                if (face != TreeLeaf::no_face) ++times.at(face);
        }
    }
    EXPECT_EQ(nodes, tree.nodes.size());
    EXPECT_EQ(leaves, tree.leaves.size());
    EXPECT_EQ(times, std::vector<int>(times.size(), 1));
}

TEST(ClosestTree, BuildingStopsWhenCancelled) {
    const mesh::LatticeMesh mesh = large_mesh();
    const std::atomic<bool> cancel{true};
    Context context;
    context.cancel = &cancel;
    EXPECT_TRUE(ClosestTree::build(mesh, context).nodes.empty());
    ClosestOptions options;
    options.sign = ClosestOptions::Sign::none;
    const auto query = ClosestQuery::build(mesh, options, context);
    ASSERT_FALSE(query.has_value());
    EXPECT_EQ(query.error().code, ErrorCode::cancelled);
}

}  // namespace
}  // namespace octavo::query
