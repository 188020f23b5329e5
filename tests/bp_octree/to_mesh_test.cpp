// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>

#include <gtest/gtest.h>

#include <octavo/bp_octree/build.hpp>
#include <octavo/bp_octree/certify.hpp>
#include <octavo/bp_octree/to_mesh.hpp>
#include <octavo/mesh/measure.hpp>

#include "bp_octree/solids.hpp"

namespace octavo::bp_octree {
namespace {

BpOctree sample_tree() {
    BuildOptions options;
    options.leaf_triangles = 8;
    auto tree = build(tests::on_lattice(tests::bumpy_sphere(4)), options);
    EXPECT_TRUE(tree.has_value());
    return std::move(tree).value();
}

TEST(ToMesh, EveryLevelIsClosedAndHasTheVolumeOfItsFigures) {
    const BpOctree tree = sample_tree();
    for (int level = 0; level <= tree.deepest() + 1; ++level) {
        ToMeshOptions options;
        options.level = level;
        const mesh::Mesh mesh = to_mesh(tree, options);
        std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
        for (const mesh::Triangle& t : mesh.triangles)
            for (std::size_t k = 0; k < 3; ++k) {
                ++edges[{t[k], t[(k + 1) % 3]}];
                --edges[{t[(k + 1) % 3], t[k]}];
            }
        for (const auto& [edge, balance] : edges) ASSERT_EQ(balance, 0);
        ASSERT_EQ(mesh.sources.size(), mesh.triangles.size());
        const double volume = tree.levels[static_cast<std::size_t>(std::min(level, tree.deepest()))].volume;
        EXPECT_NEAR(mesh::measure(mesh).volume, volume, 1e-9 * volume);
    }
}

TEST(ToMesh, WithoutCellFacesOnlyBoundingPlanesAreDrawn) {
    const BpOctree tree = sample_tree();
    ToMeshOptions options;
    options.level = 2;
    const std::size_t all = to_mesh(tree, options).triangles.size();
    options.cell_faces = false;
    const std::size_t some = to_mesh(tree, options).triangles.size();
    EXPECT_GT(some, 100U);
    EXPECT_LT(some, all);
}

TEST(Certify, AcceptsWhatBuildMakesAndNoticesEveryLie) {
    const BpOctree tree = sample_tree();
    EXPECT_TRUE(certify(tree).has_value());

    for (std::size_t i = 0; i < tree.planes.size(); i += 97) {
        BpOctree lie = tree;
        // Two steps, because rounding outwards may leave one.
        lie.planes[i].offset = static_cast<std::uint16_t>(lie.planes[i].offset - 2);
        ASSERT_FALSE(certify(lie).has_value()) << i;
    }
    BpOctree colours = tree;
    *std::find(colours.nodes.begin(), colours.nodes.end(), octree::Node::black) = octree::Node::white;
    EXPECT_FALSE(certify(colours).has_value());
    BpOctree windings = tree;
    windings.leaf_winding[7] ^= 1;
    EXPECT_FALSE(certify(windings).has_value());
    BpOctree triangles = tree;
    std::swap(triangles.leaf_triangles[3], triangles.leaf_triangles.back());
    EXPECT_FALSE(certify(triangles).has_value());
    BpOctree closed = tree;
    closed.is_solid = false;
    EXPECT_FALSE(certify(closed).has_value());
}

}  // namespace
}  // namespace octavo::bp_octree
