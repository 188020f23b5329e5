// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

#include <octavo/mesh/measure.hpp>
#include <octavo/mesh/shapes.hpp>
#include <octavo/mesh/weld.hpp>

#include "surfaces.hpp"

namespace octavo::mesh {
namespace {

TEST(Shapes, AreClosedOrientedOutwardsAndOfTheRightGenus) {
    for (const auto& [name, mesh, genus] : tests::generated_solids()) {
        SCOPED_TRACE(name);
        EXPECT_EQ(tests::count_edges(mesh), tests::EdgeCounts{});
        const Measures measures = measure(mesh);
        EXPECT_GT(measures.volume, 0);
        EXPECT_EQ(measures.components, 1u);
        EXPECT_EQ(measures.used_vertices, static_cast<std::int64_t>(mesh.vertices.size()));
        ASSERT_TRUE(measures.genus.has_value());
        EXPECT_EQ(*measures.genus, genus);
        EXPECT_EQ(equal_vertices(mesh.vertices).kept.size(), mesh.vertices.size());
        for (const Triangle& t : mesh.triangles) {
            const Vec3 a = mesh.vertices[t[0]], b = mesh.vertices[t[1]], c = mesh.vertices[t[2]];
            EXPECT_GT(length(cross(b - a, c - a)), 0);
        }
    }
}

TEST(Shapes, HaveTheVolumeOfTheirFormula) {
    EXPECT_DOUBLE_EQ(measure(box({-1, 0, 2}, {3, 1, 5})).volume, 12);
    EXPECT_DOUBLE_EQ(measure(tetrahedron(1)).volume, 8.0 / 3);
    const double polygon = 0.5 * 31 * std::sin(2 * std::numbers::pi / 31);
    EXPECT_NEAR(measure(cylinder(1, 3, 31)).volume, 3 * polygon, 1e-12);
    EXPECT_NEAR(measure(cone(1, 0, 3, 31)).volume, polygon, 1e-12);
    EXPECT_NEAR(measure(cone(0, 1, 3, 31)).volume, polygon, 1e-12);
    EXPECT_NEAR(measure(cone(1, 0.5, 3, 31)).volume, polygon * (1 + 0.5 + 0.25), 1e-12);
    EXPECT_NEAR(measure(icosphere(1, 64)).volume, 4 * std::numbers::pi / 3, 2e-3);
    EXPECT_NEAR(measure(octasphere(1, 64)).volume, 4 * std::numbers::pi / 3, 3e-3);
    EXPECT_NEAR(measure(torus(3, 1, 400, 200)).volume, 6 * std::numbers::pi * std::numbers::pi, 0.03);
    EXPECT_DOUBLE_EQ(measure(menger_sponge(1)).volume, 20.0 / 27);
    EXPECT_NEAR(measure(menger_sponge(2)).volume, 400.0 / 729, 1e-12);
}

TEST(Shapes, OfRevolutionAreSymmetricToTheLastBit) {
    const auto expect_symmetric = [](const Mesh& mesh, auto&& image) {
        std::set<std::array<double, 3>> points;
        for (const Vec3& v : mesh.vertices) points.insert({v.x + 0.0, v.y + 0.0, v.z + 0.0});
        for (const Vec3& v : mesh.vertices) {
            const Vec3 w = image(v);
            EXPECT_TRUE(points.contains({w.x + 0.0, w.y + 0.0, w.z + 0.0}));
        }
    };
    const auto mirror_x = [](Vec3 v) { return Vec3{-v.x, v.y, v.z}; };
    const auto quarter_turn = [](Vec3 v) { return Vec3{-v.y, v.x, v.z}; };
    for (const Mesh& mesh : {cylinder(1.7, 2, 24), uv_sphere(3.3, 16, 9), torus(3.1, 0.7, 20, 13)}) {
        expect_symmetric(mesh, mirror_x);
        expect_symmetric(mesh, quarter_turn);
    }
    expect_symmetric(octasphere(1.3, 9), mirror_x);
    expect_symmetric(octasphere(1.3, 9), quarter_turn);
}

TEST(Shapes, HaveTheAnnouncedNumberOfTriangles) {
    EXPECT_EQ(octasphere(1, 5).triangles.size(), 8u * 25);
    EXPECT_EQ(icosphere(1, 5).triangles.size(), 20u * 25);
    EXPECT_EQ(torus(3, 1, 7, 5).triangles.size(), 2u * 7 * 5);
    EXPECT_EQ(displaced_sphere(8).triangles.size(), 20u * 64);
}

TEST(DisplacedSphere, IsConcaveAndSeenWholeFromItsCentre) {
    const Mesh mesh = displaced_sphere(24);
    double least = INFINITY, most = 0;
    for (const Triangle& t : mesh.triangles) {
        const Vec3 a = mesh.vertices[t[0]], b = mesh.vertices[t[1]], c = mesh.vertices[t[2]];
        ASSERT_GT(dot(a, cross(b, c)), 0);
        least = std::min(least, length(a)), most = std::max(most, length(a));
    }
    EXPECT_GT(most, 1.3 * least);
}

}  // namespace
}  // namespace octavo::mesh
