// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <octavo/io/read.hpp>
#include <octavo/query/closest.hpp>

#include "bp_octree/solids.hpp"
#include "effort.hpp"
#include "models.hpp"
#include "query/closest_oracle.hpp"

namespace octavo::query {
namespace {

/// The mesh's vertices, edge middles, face centres, points on bisectors, and points near and far.
std::vector<Vec3> trying_points(const mesh::LatticeMesh& mesh, std::size_t random_points) {
    std::vector<Vec3> points;
    std::mt19937 random(21);
    const auto world = [&](Vec3 p) {
        const auto& origin = mesh.lattice.origin();
        for (int axis = 0; axis < 3; ++axis)
            p[axis] =
                (static_cast<double>(origin[static_cast<std::size_t>(axis)]) + p[axis]) * mesh.lattice.unit();
        return p;
    };
    const auto vertex = [&](mesh::VertexIndex i) {
        const exact::Point p = mesh.points[i];
        return Vec3{static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)};
    };
    for (std::size_t i = 0; i < mesh.triangles.size() && i < 40; ++i) {
        const mesh::Triangle& t = mesh.triangles[i];
        const Vec3 a = vertex(t[0]), b = vertex(t[1]), c = vertex(t[2]);
        points.push_back(world(a));
        points.push_back(world(0.5 * (a + b)));
        points.push_back(world(0.25 * (a + b) + 0.5 * c));
    }
    const double side = exact::universe_side;
    std::uniform_real_distribution<double> unit(0, 1);
    points.push_back(world({side / 2, side / 2, side / 2}));
    for (std::size_t i = 0; i < random_points; ++i) {
        const double reach = i % 10 == 0 ? 1e3 : i % 10 == 1 ? 1e9 : 1;
        points.push_back(
            world({side * (0.5 + reach * (unit(random) - 0.5)), side * (0.5 + reach * (unit(random) - 0.5)),
                   side * (0.5 + reach * (unit(random) - 0.5))}));
    }
    return points;
}

/// So many points, or more when OCTAVO_TEST_EFFORT says so.
std::size_t scaled(std::size_t points) { return points * static_cast<std::size_t>(tests::effort()); }

void expect_exact(const mesh::LatticeMesh& mesh, std::span<const Vec3> points) {
    ClosestOptions options;
    options.sign = ClosestOptions::Sign::none;
    auto query = ClosestQuery::build(mesh, options);
    ASSERT_TRUE(query.has_value());
    const tests::ClosestOracle oracle(mesh);
    const std::vector<Closest> batch = (*query)(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Closest closest = (*query)(points[i]);
        const tests::ClosestOracle::Answer nearest = oracle(FixedPoint::of(points[i], mesh.lattice));
        ASSERT_EQ(closest.triangle, nearest.face) << "point " << i;
        const double distance = nearest.distance * mesh.lattice.unit();
        ASSERT_NEAR(closest.distance, distance, 1e-15 * distance) << "point " << i;
        ASSERT_NEAR(length(closest.point - points[i]), distance, 1e-8 + 1e-14 * length(points[i]))
            << "point " << i;
        ASSERT_EQ(batch[i].triangle, closest.triangle);
        ASSERT_EQ(batch[i].distance, closest.distance);
        ASSERT_EQ(batch[i].point, closest.point);
    }
}

TEST(Closest, IsTheBruteForceAnswerInWholeNumbersOnACurvedSolid) {
    const mesh::LatticeMesh mesh = tests::on_lattice(tests::bumpy_sphere(5));
    expect_exact(mesh, trying_points(mesh, scaled(400)));
}

TEST(Closest, IsTheBruteForceAnswerInWholeNumbersOnBoxesFullOfTies) {
    mesh::Mesh mesh = tests::box({0, 0, 0}, {4, 4, 4});
    tests::add_box(mesh, {4, 4, 0}, {8, 8, 4});
    tests::add_box(mesh, {1, 1, 1}, {3, 3, 3});
    const mesh::LatticeMesh lattice_mesh = tests::on_lattice(mesh);
    std::vector<Vec3> points = trying_points(lattice_mesh, scaled(200));
    for (double x = -1; x <= 9; x += 1)
        for (double y = -1; y <= 9; y += 1)
            for (double z = -1; z <= 5; z += 1) points.push_back({x, y, z});
    expect_exact(lattice_mesh, points);
}

TEST(Closest, SliversAndDegenerateTrianglesAreMeasuredExactly) {
    mesh::Mesh mesh;
    std::mt19937 random(22);
    std::uniform_real_distribution<double> unit(0, 1);
    for (std::uint32_t i = 0; i < 60; ++i) {
        const Vec3 p{unit(random), unit(random), unit(random)}, q{unit(random), unit(random), unit(random)};
        const double thin = std::pow(10, -static_cast<double>(i % 9));
        const Vec3 r =
            i % 7 == 0   ? p
            : i % 7 == 1 ? 0.5 * (p + q)
                         : p + unit(random) * (q - p) + thin * Vec3{unit(random), unit(random), unit(random)};
        mesh.vertices.insert(mesh.vertices.end(), {p, q, r});
        mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    mesh.triangles.push_back({0, 0, 0});
    const mesh::LatticeMesh lattice_mesh = tests::on_lattice(mesh);
    expect_exact(lattice_mesh, trying_points(lattice_mesh, scaled(300)));
}

TEST(Closest, IsTheBruteForceAnswerInWholeNumbersOnAScan) {
    OCTAVO_NEEDS_MODEL("classic/bunny-closed-100k.ply");
    const auto read = io::read_mesh((tests::models_folder() / "classic/bunny-closed-100k.ply").string());
    ASSERT_TRUE(read.has_value());
    const mesh::LatticeMesh mesh = tests::on_lattice(read->mesh);
    std::vector<Vec3> points = trying_points(mesh, scaled(40));
    // As many as that near the surface.
    std::mt19937 random(23);
    std::normal_distribution<double> near(0, 0.005 * length(read->mesh.bounds().extents()));
    for (std::size_t i = points.size(); i > 0; --i) {
        const Vec3 vertex = read->mesh.vertices[random() % read->mesh.vertices.size()];
        points.push_back(vertex + Vec3{near(random), near(random), near(random)});
    }
    expect_exact(mesh, points);
}

TEST(Closest, DistancesAreNegativeInsideAndZeroOnTheSurface) {
    auto query = ClosestQuery::build(tests::box({0, 0, 0}, {4, 4, 4}));
    ASSERT_TRUE(query.has_value());
    EXPECT_EQ((*query)({1, 2, 1.5}).distance, -1);
    EXPECT_EQ((*query)({1, 2, 1.5}).point, (Vec3{0, 2, 1.5}));
    EXPECT_EQ((*query)({1, 2, 1.5}).normal, (Vec3{-1, 0, 0}));
    EXPECT_EQ((*query)({1, 2, 1.5}).feature, Feature::face);
    EXPECT_EQ((*query)({-3, 2, 8}).distance, 5);
    EXPECT_EQ((*query)({-3, 2, 8}).feature, Feature::edge);
    EXPECT_EQ((*query)({4, 1, 1}).distance, 0);
    EXPECT_EQ((*query)({6, 7, 10}).distance, 7);
    EXPECT_EQ((*query)({6, 7, 10}).feature, Feature::vertex);
}

TEST(Closest, IsZeroWhereTheInsideTestSaysOn) {
    // Beside a body a needle of a body, whose points are all on one line of the lattice.
    mesh::Mesh mesh = tests::box({0, 0, 0}, {40, 40, 40});
    const auto first = static_cast<mesh::VertexIndex>(mesh.vertices.size());
    for (const double t : {0.0, 1.0, 2.0, 5.0}) mesh.vertices.push_back({50 + 3 * t, 60 - t, 10 + 2 * t});
    for (const mesh::Triangle& t : {mesh::Triangle{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}})
        mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    const ClosestQuery distance = *ClosestQuery::build(mesh);
    const InsideQuery inside = *InsideQuery::build(mesh);
    for (const double t : {0.0, 0.5, 1.75, 5.0, 5.5}) {
        const Vec3 place{50 + 3 * t, 60 - t, 10 + 2 * t};
        EXPECT_EQ(distance(place).distance == 0, t <= 5) << t;
        EXPECT_EQ(inside(place), t <= 5 ? Side::on : Side::outside) << t;
    }
}

TEST(Closest, NearerThanItsPointsAreKnownItIsZeroAndNeverMinusZero) {
    const ClosestQuery query = *ClosestQuery::build(tests::box({0, 0, 0}, {4, 4, 4}));
    for (const double x : {-0x1p-61, 0x1p-61}) {
        const double distance = query({x, 2, 1.5}).distance;
        EXPECT_EQ(distance, 0);
        EXPECT_FALSE(std::signbit(distance));
    }
}

TEST(Closest, WhatClosesAnOpenSurfaceHasNoDistance) {
    mesh::Mesh open = tests::box({0, 0, 0}, {4, 4, 4});
    open.triangles.resize(open.triangles.size() - 2);  // the side at z = 4
    ClosestOptions options;
    options.inside.open = classic::OpenPolicy::winding;
    const ClosestQuery query = *ClosestQuery::build(open, options);
    EXPECT_EQ(query({2, 2, 3.5}).distance, -2);
    EXPECT_EQ(query({2, 2, 4}).distance, 2);
    EXPECT_EQ(query({0, 2, 2}).distance, 0);
}

/// A facet without area or length.
void add_point(mesh::LatticeMesh& mesh, exact::Point point) {
    const auto n = static_cast<mesh::VertexIndex>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), 3, point);
    mesh.triangles.push_back({n, n + 1, n + 2});
}

TEST(Closest, FarPointsKeepAllBitsThatFitAndThenTheirDirection) {
    ClosestOptions options;
    options.sign = ClosestOptions::Sign::none;
    mesh::LatticeMesh mesh;
    add_point(mesh, {100, 0, 5});
    add_point(mesh, {100, 2, 5});
    const ClosestQuery aside = *ClosestQuery::build(mesh, options);
    for (const double x : {0x1p53, 0x1p53 + 2, 0x1p57}) {
        EXPECT_EQ(aside({x, 0.6, 5}).triangle, 0u) << x;
        EXPECT_EQ(aside({x, 1.4, 5}).triangle, 1u) << x;
    }
    mesh = {};
    mesh.lattice = *exact::Lattice::from_parts(-23, {});
    add_point(mesh, {4 << 23, 0, 0});
    add_point(mesh, {3 << 23, 3 << 23, 0});
    const ClosestQuery beyond = *ClosestQuery::build(mesh, options);
    for (const double far : {1e290, 1e302, 1e308}) {
        EXPECT_EQ(beyond({far, 1e-6 * far, 0}).triangle, 0u) << far;
        EXPECT_EQ(beyond({far, far, 0}).triangle, 1u) << far;
    }
}

TEST(Closest, FootsOfFarPointsAreOnTheSurface) {
    const ClosestQuery query = *ClosestQuery::build(tests::bumpy_sphere(0, 0));  // an octahedron of radius 1
    for (const double far : {1e3, 1e6, 1e9, 1e12, 1e15}) {
        const Closest closest = query(Vec3{far, far, far} + Vec3{0.1, 0.05, -0.15});
        EXPECT_EQ(closest.feature, Feature::face) << far;
        EXPECT_NEAR(closest.point.x + closest.point.y + closest.point.z, 1, 1e-7) << far;
    }
}

TEST(Closest, PointsThatAreNotFiniteAndPointsFarAwayAreAnsweredByRule) {
    auto query = ClosestQuery::build(tests::box({0, 0, 0}, {4, 4, 4}));
    ASSERT_TRUE(query.has_value());
    const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
    EXPECT_TRUE(std::isnan((*query)({nan, 0, 0}).distance));
    EXPECT_TRUE(std::isnan((*query)({nan, infinity, 0}).distance));
    EXPECT_EQ((*query)({0, -infinity, 0}).distance, infinity);
    EXPECT_EQ((*query)({0, -infinity, 0}).triangle, Closest::no_triangle);
    for (const double far : {1e6, 1e15, 1e30, 1e150}) {
        const Closest closest = (*query)({far, 2, 2});
        EXPECT_NEAR(closest.distance, far - 4, 1e-15 * far);
        EXPECT_EQ(closest.point.x, 4);
    }
    EXPECT_EQ((*query)({1e300, 1e300, 1e300}).point, (Vec3{4, 4, 4}));
}

TEST(Closest, OpenMeshesHaveDistancesWithoutASignOnly) {
    mesh::Mesh mesh = tests::bumpy_sphere(2);
    mesh.triangles.pop_back();
    EXPECT_EQ(ClosestQuery::build(mesh).error().code, ErrorCode::not_a_solid);
    ClosestOptions options;
    options.sign = ClosestOptions::Sign::none;
    EXPECT_TRUE(ClosestQuery::build(mesh, options).has_value());
    EXPECT_EQ(ClosestQuery::build(mesh::LatticeMesh{}, options).error().code, ErrorCode::bad_input);
    mesh::LatticeMesh lying = tests::on_lattice(tests::bumpy_sphere(1));
    lying.triangles.back()[1] = 1000;
    EXPECT_EQ(ClosestQuery::build(lying, options).error().place.faces.size(), 1u);
    lying.triangles.pop_back();
    lying.points[0].x = 1 << 30;
    EXPECT_EQ(ClosestQuery::build(lying, options).error().code, ErrorCode::bad_input);
}

}  // namespace
}  // namespace octavo::query
