// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <octavo/boolean/expression.hpp>
#include <octavo/hexmesh/buffer_layer.hpp>
#include <octavo/hexmesh/build.hpp>
#include <octavo/hexmesh/fit.hpp>
#include <octavo/hexmesh/quality.hpp>
#include <octavo/io/openscad_csg.hpp>
#include <octavo/mesh/hex_sides.hpp>
#include <octavo/mesh/shapes.hpp>
#include <octavo/mesh/used_vertices.hpp>

#include "hexmesh/solids.hpp"
#include "places.hpp"

namespace octavo::hexmesh {
namespace {

using mesh::HexSide;
using mesh::NodeIndex;

/// How many boundary sides run along each edge, in one direction less the other and in both.
struct Use {
    int balance = 0, sides = 0;
};

/// Large edges are cut at the nodes that hang on them.
std::map<std::pair<NodeIndex, NodeIndex>, Use> boundary_edges(const mesh::HexMesh& mesh) {
    std::map<std::pair<NodeIndex, NodeIndex>, NodeIndex> middles;
    for (const mesh::EdgeHangingNode& h : mesh.edge_hanging)
        middles[std::minmax(h.masters[0], h.masters[1])] = h.node;
    std::set<NodeIndex> on_boundary;
    const std::vector<HexSide> sides = mesh::boundary_sides(mesh).sides;
    for (const HexSide& side : sides) on_boundary.insert(side.corners.begin(), side.corners.end());
    std::map<std::pair<NodeIndex, NodeIndex>, Use> edges;
    const auto run = [&](NodeIndex a, NodeIndex b) {
        Use& use = edges[std::minmax(a, b)];
        use.balance += a < b ? 1 : -1;
        ++use.sides;
    };
    for (const HexSide& side : sides)
        for (std::size_t i = 0; i < 4; ++i) {
            const NodeIndex a = side.corners[i], b = side.corners[(i + 1) % 4];
            const auto middle = middles.find(std::minmax(a, b));
            if (middle == middles.end() || !on_boundary.contains(middle->second)) {
                run(a, b);
            } else {
                run(a, middle->second);
                run(middle->second, b);
            }
        }
    return edges;
}

void expect_closed_manifold(const mesh::HexMesh& mesh) {
    for (const auto& [edge, use] : boundary_edges(mesh)) {
        ASSERT_EQ(use.balance, 0) << "the boundary is open";
        ASSERT_EQ(use.sides, 2) << "the boundary touches itself";
    }
}

double volume_inside(const mesh::HexMesh& mesh) {
    double six = 0;
    for (const HexSide& side : mesh::boundary_sides(mesh).sides) {
        const auto at = [&](std::size_t i) { return mesh.position(side.corners[i]); };
        six += dot(at(0), cross(at(1), at(2))) + dot(at(0), cross(at(2), at(3)));
    }
    return six / 6;
}

std::vector<mesh::Mesh> parts() {
    return {mesh::icosphere(1, 12),
            mesh::gear(),
            mesh::bearing_housing(),
            mesh::displaced_sphere(12),
            mesh::torus(2, 0.7, 40, 17),
            mesh::menger_sponge(2),
            mesh::box({0.01, 0, 0}, {3, 2, 0.11})};
}

TEST(KeepManifold, HasABoundaryThatNeverTouchesItself) {
    std::uint64_t changed = 0;
    for (const mesh::Mesh& part : parts())
        for (const int level : {4, 5}) {
            const Result<Built> built =
                build(std::span(&part, 1), {.level = level, .layers = 1, .keep = Keep::manifold});
            ASSERT_TRUE(built);
            expect_closed_manifold(built->mesh);
            const HalfFilled& half = built->report.half_filled;
            changed += half.added + half.left_out;
            const Result<Built> plain =
                build(std::span(&part, 1), {.level = level, .layers = 1, .keep = Keep::half});
            ASSERT_TRUE(plain);
            EXPECT_EQ(built->mesh.cell_count(), plain->mesh.cell_count() + half.added - half.left_out);
        }
    EXPECT_GT(changed, 10u) << "or nothing was tested";
}

TEST(KeepManifold, LeavesNoSideCoveredInPart) {
    // Cells of two sizes meet on the surface, a bracket's as well as a ball's.
    const auto file =
        io::read_csg(std::string(tests::source_folder) + "/docs/examples/bracket.csg", {.faceted = true});
    ASSERT_TRUE(file);
    const auto bracket = boolean::evaluate(file->expression);
    ASSERT_TRUE(bracket);
    const Box3 bounds = mesh::bounds_of_facets(std::span(&bracket->mesh, 1));
    const Vec3 middle = 0.5 * (bounds.low + bounds.high);
    const std::vector<std::pair<mesh::Mesh, Options>> cases{
        {bracket->mesh, {.precision = 2, .boxes = {{{bounds.low, middle}, 0.5}}}},
        {mesh::icosphere(1, 16), {.precision = 0.25, .boxes = {{{{-2, -2, -2}, {0.1, 0.2, 0.3}}, 0.0625}}}}};
    std::size_t covered = 0;
    for (const auto& [solid, sizes] : cases) {
        Options options = sizes;
        options.keep = Keep::half;
        const Result<Built> half = build(std::span(&solid, 1), options);
        options.keep = Keep::manifold;
        Result<Built> manifold = build(std::span(&solid, 1), options);
        ASSERT_TRUE(half && manifold);
        covered += mesh::boundary_sides(half->mesh).partly_covered;
        EXPECT_EQ(mesh::boundary_sides(manifold->mesh).partly_covered, 0u);
        EXPECT_EQ(manifold->report.largest_cell, half->report.largest_cell) << "not all cells were split";
        expect_exact_volumes(*manifold);
        EXPECT_TRUE(insert_buffer_layer(manifold->mesh));
        expect_closed_manifold(manifold->mesh);
    }
    EXPECT_GT(covered, 4u) << "or nothing was tested";
}

TEST(BufferLayer, KeepsTheBoundaryAndTheVolume) {
    for (const mesh::Mesh& part : parts()) {
        Result<Built> built = build(std::span(&part, 1), {.level = 5, .layers = 1, .keep = Keep::manifold});
        ASSERT_TRUE(built);
        const mesh::HexMesh before = built->mesh;
        const std::size_t sides = mesh::boundary_sides(before).sides.size();
        ASSERT_TRUE(insert_buffer_layer(built->mesh));
        const mesh::HexMesh& after = built->mesh;
        ASSERT_EQ(after.cell_count(), before.cell_count() + sides);
        EXPECT_EQ(after.set_of_cell.size(), after.cell_count());
        EXPECT_EQ(measure_quality(after).not_proved_positive, 0u);
        const std::vector<HexSide> outside = mesh::boundary_sides(after).sides;
        ASSERT_EQ(outside.size(), sides);
        for (const HexSide& side : outside) {
            ASSERT_GE(side.cell, before.cell_count()) << "only cells of the layer are on the boundary";
            for (const NodeIndex node : side.corners) ASSERT_EQ(after.position(node), before.position(node));
        }
        EXPECT_NEAR(volume_inside(after) / volume_inside(before), 1, 1e-12);
    }
}

/// Cells of two sizes on the surface: large sides of the boundary meet smaller ones.
Built graded_ball() {
    const mesh::Mesh sphere = mesh::icosphere(1, 16);
    Options options{.precision = 0.2, .layers = 1, .keep = Keep::manifold};
    options.boxes = {{{{-2, -2, -2}, {2, 2, 0.1}}, 0.1}};
    Result<Built> built = build(std::span(&sphere, 1), options);
    EXPECT_TRUE(built);
    return std::move(*built);
}

TEST(BufferLayer, TiesTheNodesBetweenCellsOfTwoSizes) {
    Built built = graded_ball();
    const mesh::HexMesh before = built.mesh;
    ASSERT_TRUE(insert_buffer_layer(built.mesh));
    EXPECT_GT(built.mesh.edge_hanging.size(), before.edge_hanging.size() + 10);
    expect_closed_manifold(built.mesh);
    const mesh::Mesh sphere = mesh::icosphere(1, 16);
    const Result<FitReport> report =
        fit(built.mesh, std::span(&sphere, 1), {.buffer_layer = BufferLayer::none});
    ASSERT_TRUE(report);
    EXPECT_EQ(measure_quality(built.mesh).not_proved_positive, 0u);
    EXPECT_GE(measure_quality(built.mesh).least, 0.15);
    for (const mesh::EdgeHangingNode& h : built.mesh.edge_hanging)
        ASSERT_EQ(built.mesh.positions[h.node],
                  0.5 * (built.mesh.positions[h.masters[0]] + built.mesh.positions[h.masters[1]]));
    EXPECT_GT(report->nodes_on_surface, report->boundary_nodes * 98 / 100);
}

TEST(BufferLayer, RefusesABoundaryThatTouchesItself) {
    // Two cubes with a common edge, and two with a common corner.
    for (const Vec3 low : {Vec3{1, 1, 0}, Vec3{1, 1, 1}}) {
        const std::vector<mesh::Mesh> solids{mesh::box({0, 0, 0}, {1, 1, 1}),
                                             mesh::box(low, low + Vec3{1, 1, 1})};
        Result<Built> built = build(solids, {.precision = 0.5, .largest = 0.5});
        ASSERT_TRUE(built);
        const mesh::HexMesh before = built->mesh;
        EXPECT_FALSE(insert_buffer_layer(built->mesh));
        EXPECT_EQ(built->mesh.corners, before.corners);
        EXPECT_TRUE(built->mesh.positions.empty());
    }
}

}  // namespace
}  // namespace octavo::hexmesh
