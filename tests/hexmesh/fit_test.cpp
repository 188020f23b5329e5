// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <octavo/hexmesh/build.hpp>
#include <octavo/hexmesh/conforming.hpp>
#include <octavo/hexmesh/fit.hpp>
#include <octavo/mesh/hex_sides.hpp>
#include <octavo/mesh/shapes.hpp>

namespace octavo::hexmesh {
namespace {

void expect_valid(const mesh::HexMesh& mesh, double least) {
    const Quality quality = measure_quality(mesh);
    EXPECT_EQ(quality.not_proved_positive, 0u);
    EXPECT_GE(quality.least, least);
    for (const mesh::EdgeHangingNode& hanging : mesh.edge_hanging)
        ASSERT_EQ(mesh.positions[hanging.node],
                  0.5 * (mesh.positions[hanging.masters[0]] + mesh.positions[hanging.masters[1]]));
    for (const mesh::FaceHangingNode& hanging : mesh.face_hanging) {
        Vec3 sum;
        for (const mesh::NodeIndex master : hanging.masters) sum = sum + mesh.positions[master];
        ASSERT_EQ(mesh.positions[hanging.node], 0.25 * sum);
    }
}

double largest_distance_from_unit_sphere(const mesh::HexMesh& mesh) {
    double largest = 0;
    for (const mesh::HexSide& side : mesh::boundary_sides(mesh).sides)
        for (const mesh::NodeIndex node : side.corners)
            largest = std::max(largest, std::fabs(length(mesh.positions[node]) - 1));
    return largest;
}

TEST(Fit, DrawsTheBoundaryOfASphereOntoIt) {
    const mesh::Mesh sphere = mesh::icosphere(1, 20);
    Result<Built> built =
        build(std::span(&sphere, 1), {.precision = 0.07, .layers = 1, .keep = Keep::manifold});
    ASSERT_TRUE(built);
    ASSERT_GT(built->mesh.hanging_nodes(), 100u);
    const Result<FitReport> report = fit(built->mesh, std::span(&sphere, 1));
    ASSERT_TRUE(report) << report.error().describe();
    EXPECT_TRUE(report->has_buffer_layer);
    expect_valid(built->mesh, 0.2);
    EXPECT_GT(report->boundary_nodes, 1000u);
    EXPECT_GE(report->nodes_on_surface, report->boundary_nodes - report->boundary_nodes / 1000);
    EXPECT_LT(report->mean_distance, report->mean_distance_before / 1000);
    EXPECT_LT(report->largest_distance, report->largest_distance_before / 10);
    EXPECT_LT(largest_distance_from_unit_sphere(built->mesh), 0.005) << "facets lie inside the sphere";
    EXPECT_GT(measure_quality(built->mesh).mean, 0.8);
}

TEST(Fit, DrawsStepsNearTheSurfaceWithoutALayer) {
    // Cells with two sides on the sphere stop at the least quality, so some nodes must stay behind.
    const mesh::Mesh sphere = mesh::icosphere(1, 20);
    Result<Built> built = build(std::span(&sphere, 1), {.precision = 0.07, .layers = 1, .keep = Keep::half});
    ASSERT_TRUE(built);
    const Result<FitReport> report =
        fit(built->mesh, std::span(&sphere, 1), {.buffer_layer = BufferLayer::none});
    ASSERT_TRUE(report) << report.error().describe();
    EXPECT_FALSE(report->has_buffer_layer);
    EXPECT_TRUE(built->mesh.is_octree());
    expect_valid(built->mesh, 0.2);
    EXPECT_LT(report->mean_distance, report->mean_distance_before / 7);
    EXPECT_LT(report->largest_distance, report->largest_distance_before);
    EXPECT_GT(report->nodes_on_surface, report->boundary_nodes / 2);
    EXPECT_NEAR(largest_distance_from_unit_sphere(built->mesh), report->largest_distance, 0.01)
        << "the report tells how far nodes stay behind";
}

TEST(Fit, KeepsEveryCellValidOnThinAndSharpParts) {
    const std::vector<mesh::Mesh> solids{mesh::gear(), mesh::menger_sponge(2),
                                         mesh::box({0.01, 0, 0}, {3, 2, 0.11})};
    for (const mesh::Mesh& solid : solids) {
        Result<Built> built = build(std::span(&solid, 1), {.level = 4, .layers = 1, .keep = Keep::manifold});
        ASSERT_TRUE(built);
        Result<Built> conforming = build_conforming(std::span(&solid, 1), {.level = 4});
        ASSERT_TRUE(conforming);
        for (mesh::HexMesh* mesh : {&built->mesh, &conforming->mesh}) {
            const double before = measure_quality(*mesh).least;
            const Result<FitReport> report = fit(*mesh, std::span(&solid, 1));
            ASSERT_TRUE(report);
            expect_valid(*mesh, std::min(before, 0.2));
            EXPECT_LE(report->mean_distance, report->mean_distance_before);
        }
    }
}

TEST(Fit, LeavesABoxOnTheGridAsItIs) {
    const mesh::Mesh box = mesh::box({0, 0, 0}, {3, 2, 1});
    Result<Built> built = build(std::span(&box, 1), {.precision = 0.25, .largest = 0.25, .keep = Keep::half});
    ASSERT_TRUE(built);
    const Result<FitReport> report = fit(built->mesh, std::span(&box, 1));
    ASSERT_TRUE(report);
    EXPECT_EQ(report->nodes_on_surface, report->boundary_nodes);
    Box3 bounds;
    double volume = 0;
    for (mesh::CellIndex cell = 0; cell < built->mesh.cell_count(); ++cell) {
        const CellCorners corners = corners_of(built->mesh, cell);
        for (const Vec3& p : corners) bounds.add(p);
        volume += dot(corners[1] - corners[0], cross(corners[2] - corners[0], corners[4] - corners[0]));
    }
    EXPECT_NEAR(volume, 6, 0.01);
    EXPECT_EQ(bounds.low, (Vec3{0, 0, 0}));
    EXPECT_EQ(bounds.high, (Vec3{3, 2, 1}));
    expect_valid(built->mesh, 0.9);
}

TEST(Fit, MovesNothingWhereTheBoundaryLiesOnTheSurface) {
    // Cells of two sizes, whose nodes smoothing would move.
    const mesh::Mesh box = mesh::box({0, 0, 0}, {8, 8, 8});
    Result<Built> built = build(std::span(&box, 1), {.precision = 0.5, .keep = Keep::manifold});
    ASSERT_TRUE(built && built->mesh.hanging_nodes() > 100);
    const mesh::HexMesh before = built->mesh;
    const Result<FitReport> report = fit(built->mesh, std::span(&box, 1));
    ASSERT_TRUE(report);
    EXPECT_FALSE(report->has_buffer_layer);
    EXPECT_EQ(report->nodes_on_surface, report->boundary_nodes);
    for (mesh::NodeIndex node = 0; node < before.node_count(); ++node)
        ASSERT_EQ(built->mesh.position(node), before.position(node));
    expect_valid(built->mesh, 1);
}

TEST(Fit, DrawsInterfacesOntoTheirSurface) {
    // A ball in a ball: the nodes between the two materials go to the inner sphere.
    const std::vector<mesh::Mesh> solids{mesh::icosphere(1, 12), mesh::icosphere(0.5, 12)};
    Result<Built> built = build(solids, {.precision = 0.1, .layers = 1, .keep = Keep::manifold});
    ASSERT_TRUE(built);
    const Result<FitReport> report = fit(built->mesh, solids);
    ASSERT_TRUE(report);
    expect_valid(built->mesh, 0.2);
    EXPECT_LT(report->mean_distance, report->mean_distance_before / 10);
}

Box3 bounds_of(const mesh::HexMesh& mesh, mesh::SolidIndex solid) {
    Box3 bounds;
    for (mesh::CellIndex cell = 0; cell < mesh.cell_count(); ++cell) {
        const mesh::SolidSet& set = mesh.set_of(cell);
        for (const auto* solids : {&set.inside, &set.boundary})
            if (std::find(solids->begin(), solids->end(), solid) != solids->end())
                for (const Vec3& corner : corners_of(mesh, cell)) bounds.add(corner);
    }
    return bounds;
}

void expect_cube(const Box3& bounds, double half) {
    EXPECT_NEAR(length(bounds.low - Vec3{-half, -half, -half}), 0, 1e-6);
    EXPECT_NEAR(length(bounds.high - Vec3{half, half, half}), 0, 1e-6);
}

mesh::Mesh cube(double half) { return mesh::box({-half, -half, -half}, {half, half, half}); }

TEST(Fit, DrawsTheBoundaryPastASurfaceJustBelowIt) {
    // No cell lies between the cubes, so those on the boundary belong to both; the outer cube's surface is farther off.
    const std::vector<mesh::Mesh> solids{cube(5.3), cube(5.05)};
    for (const Keep keep : {Keep::manifold, Keep::half}) {
        Result<Built> built = build(solids, {.precision = 1, .layers = 1, .keep = keep});
        ASSERT_TRUE(built);
        const Result<FitReport> report = fit(built->mesh, solids);
        ASSERT_TRUE(report) << report.error().describe();
        EXPECT_EQ(report->nodes_on_surface, report->boundary_nodes);
        expect_cube(bounds_of(built->mesh, 0), 5.3);
        EXPECT_NEAR(report->mean_distance_before, 0.3, 0.1);
    }
}

TEST(Fit, DrawsEachSurfaceToItsOwnSolid) {
    // The inner cube's cells end at 4, where the plate is nearer than the cube; the plate has no cells at all.
    const std::vector<mesh::Mesh> solids{cube(7.3), cube(4.4), mesh::box({4.05, -3, -3}, {4.15, 3, 3})};
    Result<Built> built = build(solids, {.precision = 1, .layers = 1, .keep = Keep::manifold});
    ASSERT_TRUE(built);
    const Result<FitReport> report = fit(built->mesh, solids);
    ASSERT_TRUE(report) << report.error().describe();
    expect_cube(bounds_of(built->mesh, 0), 7.3);
    expect_cube(bounds_of(built->mesh, 1), 4.4);
}

TEST(Fit, DrawsToTheFacesThatCloseHolesToo) {
    // A box without its top: the cap's nodes are at 4 and belong to 4.4, not to the rim or nowhere.
    mesh::Mesh open = mesh::box({-4.4, -4.4, -4.4}, {4.4, 4.4, 4.4});
    std::erase_if(open.triangles, [&](const mesh::Triangle& t) {
        return open.vertices[t[0]].z > 0 && open.vertices[t[1]].z > 0 && open.vertices[t[2]].z > 0;
    });
    ASSERT_EQ(open.triangles.size(), 10u);
    Result<Built> built =
        build(std::span(&open, 1),
              {.precision = 1, .layers = 1, .keep = Keep::manifold, .open = classic::OpenPolicy::winding});
    ASSERT_TRUE(built) << built.error().describe();
    const Result<FitReport> report = fit(built->mesh, std::span(&open, 1));
    ASSERT_TRUE(report) << report.error().describe();
    EXPECT_EQ(report->nodes_on_surface, report->boundary_nodes);
    EXPECT_NEAR(report->largest_distance_before, 0.4, 1e-6);
    expect_cube(bounds_of(built->mesh, 0), 4.4);
}

TEST(Fit, TakesNoNoticeOfVerticesThatNoFacetUses) {
    const mesh::Mesh sphere = mesh::icosphere(1, 8);
    const Options meshing{.precision = 0.2, .layers = 1, .keep = Keep::manifold};
    Result<Built> plain = build(std::span(&sphere, 1), meshing);
    ASSERT_TRUE(plain);
    const Result<FitReport> expected = fit(plain->mesh, std::span(&sphere, 1));
    ASSERT_TRUE(expected);
    EXPECT_LT(expected->mean_distance, 1e-4);
    for (const double x : {5000.0, 1e9, 1e300}) {
        mesh::Mesh solid = sphere;
        solid.vertices.push_back({x, 0, 0});
        Result<Built> built = build(std::span(&solid, 1), meshing);
        ASSERT_TRUE(built);
        const Result<FitReport> report = fit(built->mesh, std::span(&solid, 1));
        ASSERT_TRUE(report) << report.error().describe();
        EXPECT_EQ(built->mesh.positions, plain->mesh.positions);
        EXPECT_EQ(report->mean_distance, expected->mean_distance);
        EXPECT_EQ(report->nodes_on_surface, expected->nodes_on_surface);
    }
}

TEST(Fit, RefusesMeshesInWhichMastersHang) {
    const mesh::Mesh solid = mesh::icosphere(1, 8);
    Result<Built> built = build(std::span(&solid, 1),
                                {.precision = 0.1, .balance = octree::Contact::face, .keep = Keep::manifold});
    ASSERT_TRUE(built);
    const std::vector<mesh::HexMesh> before{built->mesh};
    const Result<FitReport> report = fit(built->mesh, std::span(&solid, 1));
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().code, ErrorCode::bad_input);
    EXPECT_EQ(built->mesh.positions, before[0].positions);
}

TEST(Fit, IsTheSameForAnyNumberOfThreadsAndCanBeCancelled) {
    const mesh::Mesh solid = mesh::displaced_sphere(10);
    Result<Built> a = build(std::span(&solid, 1), {.level = 4, .layers = 1, .keep = Keep::manifold});
    ASSERT_TRUE(a);
    mesh::HexMesh b = a->mesh, c = a->mesh;
    Context one, two, stopped;
    one.threads = 1, two.threads = 2;
    ASSERT_TRUE(fit(a->mesh, std::span(&solid, 1), {}, one) && fit(b, std::span(&solid, 1), {}, two));
    EXPECT_EQ(a->mesh.positions, b.positions);
    const std::atomic<bool> cancel = true;
    stopped.cancel = &cancel;
    const Result<FitReport> cancelled = fit(c, std::span(&solid, 1), {}, stopped);
    ASSERT_FALSE(cancelled);
    EXPECT_EQ(cancelled.error().code, ErrorCode::cancelled);
}

}  // namespace
}  // namespace octavo::hexmesh
