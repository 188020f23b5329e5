// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include <octavo/classic/boundary_squares.hpp>
#include <octavo/classic/csg_build.hpp>
#include <octavo/classic/set_operations.hpp>
#include <octavo/classic/to_mesh.hpp>

#include "csg/random_solids.hpp"
#include "effort.hpp"

namespace octavo::classic {
namespace {

double volume_of(const mesh::Mesh& mesh) {
    double sum = 0;
    for (const mesh::Triangle& t : mesh.triangles)
        sum += dot(mesh.vertices[t[0]], cross(mesh.vertices[t[1]], mesh.vertices[t[2]]));
    return sum / 6;
}

/// Each edge has two facets, once in either direction, and the facets at each vertex are one fan.
void expect_manifold(const mesh::Mesh& mesh) {
    std::map<std::pair<mesh::VertexIndex, mesh::VertexIndex>, std::size_t> facet_of;
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
        for (std::size_t i = 0; i < 3; ++i) {
            const auto edge = std::make_pair(mesh.triangles[f][i], mesh.triangles[f][(i + 1) % 3]);
            ASSERT_TRUE(facet_of.emplace(edge, f).second) << "an edge is run along twice in one direction";
        }
    for (const auto& [edge, facet] : facet_of)
        ASSERT_TRUE(facet_of.count({edge.second, edge.first})) << "an edge has one facet only";
    // From facet to facet around each vertex.
    std::map<mesh::VertexIndex, std::size_t> facets_at, start;
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
        for (const mesh::VertexIndex v : mesh.triangles[f]) {
            ++facets_at[v];
            start[v] = f;
        }
    for (const auto& [vertex, count] : facets_at) {
        std::size_t walked = 0, facet = start[vertex];
        do {
            const mesh::Triangle& t = mesh.triangles[facet];
            const std::size_t i = static_cast<std::size_t>(std::find(t.begin(), t.end(), vertex) - t.begin());
            facet = facet_of.at({vertex, t[(i + 2) % 3]});  // across the edge that ends at the vertex
            ++walked;
        } while (facet != start[vertex] && walked <= count);
        ASSERT_EQ(walked, count) << "two fans meet in a vertex";
    }
}

/// No vertex lies inside an edge: all facets of a square grid either share whole edges or nothing.
void expect_conforming(const mesh::Mesh& mesh) {
    std::set<std::array<double, 3>> spots;
    for (const Vec3& v : mesh.vertices) spots.insert({v.x, v.y, v.z});
    for (const mesh::Triangle& t : mesh.triangles) {
        const Vec3 a = mesh.vertices[t[0]], b = mesh.vertices[t[1]], c = mesh.vertices[t[2]];
        ASSERT_GT(length(cross(b - a, c - a)), 0);
        for (const auto& [p, q] : {std::make_pair(a, b), std::make_pair(b, c), std::make_pair(c, a)}) {
            const Vec3 middle = 0.5 * (p + q);
            ASSERT_FALSE(spots.count({middle.x, middle.y, middle.z})) << "a vertex inside an edge";
        }
    }
}

double volume_of(const octree::Octree& tree, bool gray) {
    const octree::OctreeStats stats = tree.stats();
    return octree::world_volume(tree.lattice(), stats.black_volume + (gray ? stats.gray_volume : 0));
}

TEST(ToMesh, RandomSolidsGiveConformingManifoldsOfTheVolumeOfTheirLeaves) {
    csg::tests::RandomSolids random(21);
    for (int round = 0; round < 12; ++round) {
        CsgBuildOptions options;
        options.depth = 4;
        options.universe = Box3{{-5, -5, -5}, {5, 5, 5}};
        const octree::Octree tree = build(random.tree(1 + random.below(6)), options)->octree;
        for (const CountedLeaves counted : {CountedLeaves::black, CountedLeaves::black_and_gray}) {
            const Result<mesh::Mesh> mesh = to_mesh(tree, {counted});
            ASSERT_TRUE(mesh);
            expect_manifold(*mesh);
            expect_conforming(*mesh);
            EXPECT_NEAR(volume_of(*mesh), volume_of(tree, counted == CountedLeaves::black_and_gray), 1e-9);
        }
    }
}

TEST(ToMesh, RandomColoursTouchInEveryWayAndStayManifold) {
    // Leaves of random colours and sizes: edges with four facets and corners with any number of fans.
    for (std::uint32_t seed = 0; seed < 40; ++seed) {
        std::mt19937 engine(seed);
        octree::DfCode code;
        const auto append = [&](const auto& self, int levels) -> void {
            if (levels > 0 && engine() % 3 != 0) {
                code.append(octree::Node::split);
                for (int i = 0; i < 8; ++i) self(self, levels - 1);
            } else {
                code.append(static_cast<octree::Node>(engine() % 2));
            }
        };
        append(append, 3);
        const octree::Octree tree(exact::Lattice{}, 3, code);
        const Result<mesh::Mesh> mesh = to_mesh(tree);
        ASSERT_TRUE(mesh);
        expect_manifold(*mesh);
        expect_conforming(*mesh);
        EXPECT_NEAR(volume_of(*mesh) / volume_of(octree::Octree(exact::Lattice{}, 0,
                                                                [] {
                                                                    octree::DfCode black;
                                                                    black.append(octree::Node::black);
                                                                    return black;
                                                                }()),
                                                 false),
                    volume_of(tree, false) / std::ldexp(1.0, 78), 1e-9);
    }
}

TEST(ToMesh, MoreNodesThanCanBeNumberedAreRefused) {
    if (tests::effort() < 10) GTEST_SKIP() << "takes 1 GB; runs with OCTAVO_TEST_EFFORT=10";
    const std::uint64_t nodes = most_unfolded_nodes + 8;
    Result<octree::DfCode> code =
        octree::DfCode::from_words(std::vector<std::uint64_t>((nodes + 31) / 32), nodes);
    ASSERT_TRUE(code);
    const Result<mesh::Mesh> mesh = to_mesh(octree::Octree(exact::Lattice{}, 21, std::move(*code)));
    ASSERT_FALSE(mesh);
    EXPECT_EQ(mesh.error().code, ErrorCode::limit);
}

TEST(ToMesh, OfNothingIsEmpty) { EXPECT_TRUE(to_mesh(octree::Octree())->triangles.empty()); }

}  // namespace
}  // namespace octavo::classic
