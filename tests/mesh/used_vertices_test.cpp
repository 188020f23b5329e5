// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <octavo/mesh/shapes.hpp>
#include <octavo/mesh/snap.hpp>
#include <octavo/mesh/topology.hpp>
#include <octavo/mesh/used_vertices.hpp>

namespace octavo::mesh {
namespace {

/// The cube with vertices before, between and behind its own that no facet uses.
Mesh cube_with_unused(const std::vector<Vec3>& unused) {
    const Mesh plain = cube(2);
    Mesh mesh;
    std::vector<VertexIndex> name;
    for (std::size_t i = 0; i < plain.vertices.size(); ++i) {
        for (std::size_t k = i; k < unused.size(); k += plain.vertices.size())
            mesh.vertices.push_back(unused[k]);
        name.push_back(static_cast<VertexIndex>(mesh.vertices.size()));
        mesh.vertices.push_back(plain.vertices[i]);
    }
    for (const Triangle& t : plain.triangles) mesh.triangles.push_back({name[t[0]], name[t[1]], name[t[2]]});
    return mesh;
}

TEST(UsedVertices, AreThoseOfFacets) {
    const Mesh mesh = cube_with_unused({{9, 9, 9}, {0, 0, 0}});
    const std::vector<bool> used = used_vertices(mesh.triangles, mesh.vertices.size());
    EXPECT_FALSE(used[0]);
    EXPECT_TRUE(used[1]);
    EXPECT_FALSE(used[2]);
    EXPECT_EQ(bounds_of_facets(mesh).high, bounds_of_facets(cube(2)).high);
    EXPECT_TRUE(bounds_of_facets(Mesh{{{1, 2, 3}}, {}, {}}).empty());
    const Mesh dropped = without_unused_vertices(mesh);
    EXPECT_EQ(dropped.vertices, cube(2).vertices);
    EXPECT_EQ(dropped.triangles, cube(2).triangles);
    const Mesh two[] = {cube(2), box({5, 5, 5}, {6, 7, 8})};
    EXPECT_EQ(bounds_of_facets(two).high, (Vec3{6, 7, 8}));
}

TEST(UsedVertices, PassOverCornersThatAreNotThere) {
    const Mesh broken{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 7}}, {}};
    EXPECT_EQ(used_vertices(broken.triangles, 3), (std::vector<bool>{true, true, false}));
    EXPECT_EQ(bounds_of_facets(broken).high, (Vec3{1, 0, 0}));
}

TEST(Snap, FitsTheLatticeToFacetsAndPutsOtherVerticesAmongThem) {
    const Mesh plain = cube(2);
    const Result<Snapped> expected = snap(plain);
    ASSERT_TRUE(expected);
    for (const Vec3 unused :
         {Vec3{1e9, 0, 0}, Vec3{0, -1e300, 5}, Vec3{std::nan(""), 0, 0}, Vec3{0.1, 0.2, 0.3}}) {
        const Mesh mesh = cube_with_unused({unused, unused, {3e7, 0, 0}});
        const Result<Snapped> snapped = snap(mesh);
        ASSERT_TRUE(snapped) << snapped.error().describe();
        EXPECT_EQ(snapped->mesh.lattice, expected->mesh.lattice);
        EXPECT_EQ(snapped->mesh.triangles, mesh.triangles);
        ASSERT_EQ(snapped->mesh.points.size(), mesh.vertices.size()) << "indices stay";
        EXPECT_EQ(snapped->report.moved_vertices, 0u);
        for (std::size_t face = 0; face < plain.triangles.size(); ++face)
            for (std::size_t k = 0; k < 3; ++k)
                EXPECT_EQ(snapped->mesh.points[mesh.triangles[face][k]],
                          expected->mesh.points[plain.triangles[face][k]]);
    }
}

TEST(Snap, RefusesUsedVerticesOutsideOrNotFinite) {
    Mesh mesh = cube(2);
    const Result<Snapped> snapped = snap(mesh);
    ASSERT_TRUE(snapped);
    mesh.vertices[3].x = 1e9;
    EXPECT_FALSE(snap(mesh, snapped->mesh.lattice));
    mesh.vertices[3].x = std::nan("");
    EXPECT_FALSE(snap(mesh, snapped->mesh.lattice));
    EXPECT_FALSE(snap(mesh));
    EXPECT_TRUE(snap(Mesh{})) << "nothing is no error";
    EXPECT_TRUE(snap(Mesh{{{1, 2, 3}}, {}, {}}));
}

}  // namespace
}  // namespace octavo::mesh
