// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <limits>
#include <optional>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include <octavo/boolean/evaluate.hpp>
#include <octavo/hexmesh/build.hpp>
#include <octavo/hexmesh/conforming.hpp>
#include <octavo/io/read.hpp>
#include <octavo/mesh/shapes.hpp>

#include "effort.hpp"
#include "hexmesh/solids.hpp"
#include "models.hpp"

namespace octavo::hexmesh {
namespace {

using mesh::Mesh;

/// Everything a mesh of hexahedra promises about itself.
void expect_consistent(const Built& built) {
    const mesh::HexMesh& mesh = built.mesh;
    ASSERT_EQ(mesh.corners.size(), mesh.cells.size());
    ASSERT_EQ(mesh.set_of_cell.size(), mesh.cells.size());
    ASSERT_TRUE(std::is_sorted(mesh.cells.begin(), mesh.cells.end()));
    std::size_t boundary_entries = 0;
    for (mesh::CellIndex cell = 0; cell < mesh.cells.size(); ++cell)
        boundary_entries += mesh.set_of(cell).boundary.size();
    if (!mesh.fractions.empty()) {
        EXPECT_EQ(mesh.fractions.size(), boundary_entries);
    }
    for (const double fraction : mesh.fractions)
        ASSERT_TRUE(fraction > -1e-9 && fraction < 1 + 1e-9) << fraction;
    EXPECT_EQ(std::set<exact::Point>(mesh.nodes.begin(), mesh.nodes.end()).size(), mesh.nodes.size());
}

TEST(Build, RefusesMoreCellsThanAllowed) {
    const Mesh gear = mesh::gear();
    for (const int layers : {0, 3}) {
        Options options{.level = 5, .layers = layers};
        const Result<Built> built = build(std::span(&gear, 1), options);
        ASSERT_TRUE(built);
        options.max_cells = built->report.tree_cells;
        EXPECT_TRUE(build(std::span(&gear, 1), options));
        for (const std::uint64_t fewer : {built->report.tree_cells - 1, built->report.tree_cells / 2}) {
            options.max_cells = fewer;
            const Result<Built> refused = build(std::span(&gear, 1), options);
            ASSERT_FALSE(refused);
            EXPECT_EQ(refused.error().code, ErrorCode::limit);
        }
    }
    const Result<Built> huge = build(std::span(&gear, 1), {.level = 17, .max_cells = 50'000});
    ASSERT_FALSE(huge);
    EXPECT_EQ(huge.error().code, ErrorCode::limit);
}

TEST(Build, FillsEachSolidToItsExactVolume) {
    const std::vector<Mesh> solids{mesh::icosphere(1, 6),
                                   mesh::gear(),
                                   mesh::bearing_housing(),
                                   mesh::torus(2, 0.7, 40, 17),
                                   mesh::displaced_sphere(12),
                                   mesh::menger_sponge(2),
                                   moved(mesh::tetrahedron(), {1e3, 0.1, -7})};
    for (const Mesh& solid : solids)
        for (const int level : {3, 5}) {
            const Result<Built> built = build(std::span(&solid, 1), {.level = level});
            ASSERT_TRUE(built) << built.error().describe();
            expect_consistent(*built);
            expect_exact_volumes(*built);
            EXPECT_GT(built->report.boundary_cells + built->report.inside_cells, 0u);
        }
}

TEST(Build, GivesAbsoluteCellsOnMultiplesOfTheirSide) {
    // A part alone and beside another one far away: the same cells where the part is.
    const Mesh part = mesh::bearing_housing();
    const std::vector<Mesh> both{part, moved(mesh::cube(3), {500, 20, 30})};
    const Options options{.precision = 3};
    const Result<Built> alone = build(std::span(&part, 1), options), together = build(both, options);
    ASSERT_TRUE(alone && together);
    EXPECT_EQ(alone->report.smallest_cell, 2);
    EXPECT_EQ(together->report.smallest_cell, 2);
    const auto boundary_corners = [](const Built& built) {
        std::set<std::array<double, 3>> corners;
        for (mesh::CellIndex cell = 0; cell < built.mesh.cells.size(); ++cell) {
            const auto& boundary = built.mesh.set_of(cell).boundary;
            if (std::find(boundary.begin(), boundary.end(), 0u) == boundary.end()) continue;
            const Vec3 low = built.mesh.position(built.mesh.corners[cell][0]);
            EXPECT_EQ(low.x, 2 * std::floor(low.x / 2));
            corners.insert({low.x, low.y, low.z});
        }
        return corners;
    };
    EXPECT_EQ(boundary_corners(*alone), boundary_corners(*together));
}

TEST(Build, TakesNoNoticeOfVerticesThatNoFacetUses) {
    const Mesh sphere = mesh::icosphere(1, 8);
    const Result<Built> plain = build(std::span(&sphere, 1), {.level = 5});
    const Result<Built> plain_conforming = build_conforming(std::span(&sphere, 1), {.level = 4});
    ASSERT_TRUE(plain && plain_conforming);
    for (const double x : {5000.0, 1e9, std::numeric_limits<double>::infinity()}) {
        Mesh solid = sphere;
        solid.vertices.push_back({x, 0, 0});
        const Result<Built> built = build(std::span(&solid, 1), {.level = 5});
        ASSERT_TRUE(built) << built.error().describe();
        EXPECT_EQ(built->mesh.cells, plain->mesh.cells);
        EXPECT_EQ(built->mesh.fractions, plain->mesh.fractions);
        EXPECT_EQ(built->report.solids[0].largest_displacement, plain->report.solids[0].largest_displacement);
        const Result<Built> conforming = build_conforming(std::span(&solid, 1), {.level = 4});
        ASSERT_TRUE(conforming) << conforming.error().describe();
        EXPECT_EQ(conforming->mesh.positions, plain_conforming->mesh.positions);
    }
}

TEST(Build, FitsABoxOnTheGridWithoutBoundaryCells) {
    const Mesh box = mesh::box({0, 0, 0}, {1, 2, 0.5});
    const Result<Built> built = build(std::span(&box, 1), {.precision = 0.25, .largest = 0.25});
    ASSERT_TRUE(built);
    EXPECT_EQ(built->report.boundary_cells, 0u);
    EXPECT_EQ(built->report.inside_cells, 4u * 8 * 2);
    EXPECT_EQ(built->mesh.nodes.size(), 5u * 9 * 3);
    EXPECT_EQ(built->mesh.hanging_nodes(), 0u);
    EXPECT_EQ(built->report.solids[0].filled_volume, 1);
}

TEST(Build, KnowsWhichSolidsEachCellLiesIn) {
    // Two overlapping boxes on the grid and one that touches the first: every cell can be told by its centre.
    const std::vector<std::pair<Vec3, Vec3>> boxes{
        {{0, 0, 0}, {2, 2, 2}}, {{1, 1, 0}, {3, 3, 2}}, {{-1, 0, 0}, {0, 2, 2}}};
    std::vector<Mesh> solids;
    for (const auto& [low, high] : boxes) solids.push_back(mesh::box(low, high));
    const Result<Built> built = build(solids, {.precision = 0.5, .largest = 0.5});
    ASSERT_TRUE(built);
    EXPECT_EQ(built->mesh.cells.size(), (64u + 64 - 16) + 32);
    for (mesh::CellIndex cell = 0; cell < built->mesh.cells.size(); ++cell) {
        const Vec3 centre = 0.5 * (built->mesh.position(built->mesh.corners[cell][0]) +
                                   built->mesh.position(built->mesh.corners[cell][7]));
        mesh::SolidSet expected;
        for (mesh::SolidIndex solid = 0; solid < boxes.size(); ++solid) {
            bool inside = true;
            for (int axis = 0; axis < 3; ++axis)
                inside = inside && boxes[solid].first[axis] < centre[axis] &&
                         centre[axis] < boxes[solid].second[axis];
            if (inside) expected.inside.push_back(solid);
        }
        ASSERT_EQ(built->mesh.set_of(cell), expected);
    }
    expect_exact_volumes(*built);
}

TEST(Build, KeepsInnerVoidsEmpty) {
    const Mesh shell = joined(mesh::icosphere(1, 8), reversed(mesh::icosphere(0.5, 8)));
    const Result<Built> built = build(std::span(&shell, 1), {.precision = 0.07});
    ASSERT_TRUE(built) << built.error().describe();
    expect_exact_volumes(*built);
    for (mesh::CellIndex cell = 0; cell < built->mesh.cells.size(); ++cell)
        EXPECT_GT(length(built->mesh.position(built->mesh.corners[cell][0])), 0.3);
}

TEST(Build, GradesByBoxSolidAndCurvature) {
    const std::vector<Mesh> solids{mesh::icosphere(1, 10), moved(mesh::icosphere(1, 10), {3, 0, 0})};
    Options options{.precision = 0.25};
    const Result<Built> plain = build(solids, options);
    options.solids = {{.solid = 1, .surface = 0.0625, .interior = 0.125}};
    options.boxes = {{{{-0.2, -0.2, -0.2}, {0.2, 0.2, 0.2}}, 0.05}};
    const Result<Built> graded = build(solids, options);
    ASSERT_TRUE(plain && graded);
    expect_consistent(*graded);
    expect_exact_volumes(*graded);
    for (mesh::CellIndex cell = 0; cell < graded->mesh.cells.size(); ++cell) {
        const double side = graded->mesh.lattice.unit() * graded->mesh.cells[cell].side();
        const mesh::SolidSet& set = graded->mesh.set_of(cell);
        if (!set.inside.empty() && set.inside[0] == 1) {
            EXPECT_LE(side, 0.125);
        }
        if (!set.boundary.empty()) {
            EXPECT_LE(side, set.boundary[0] == 1 ? 0.0625 : 0.25);
        }
        const Vec3 low = graded->mesh.position(graded->mesh.corners[cell][0]);
        if (std::max({std::fabs(low.x), std::fabs(low.y), std::fabs(low.z)}) < 0.19) {
            EXPECT_LE(side, 0.05);
        }
    }
    EXPECT_EQ(plain->report.smallest_cell, 0.25);
    EXPECT_EQ(graded->report.smallest_cell, 0.03125);

    const Mesh cylinder = mesh::cylinder(1, 2, 64);
    const Result<Built> curved = build(
        std::span(&cylinder, 1), {.precision = 0.5, .curvature = {.smallest = 0.0625, .angle_degrees = 5}});
    ASSERT_TRUE(curved);
    expect_exact_volumes(*curved);
    EXPECT_EQ(curved->report.smallest_cell, 0.0625);
}

TEST(Build, RefinesThinWallsByProximity) {
    const Mesh plate = mesh::box({0.01, 0.02, 0.03}, {2, 2, 0.06});  // in one layer down to cells of 1/16
    const Result<Built> coarse = build(std::span(&plate, 1), {.precision = 0.25});
    const Result<Built> fine =
        build(std::span(&plate, 1), {.precision = 0.25, .proximity = {.smallest = 0.03125}});
    ASSERT_TRUE(coarse && fine);
    EXPECT_EQ(coarse->report.inside_cells, 0u);
    EXPECT_EQ(fine->report.smallest_cell, 0.03125);
    expect_exact_volumes(*fine);
}

TEST(Build, KeepsLargerCellsAwayFromTheBoundaryByLayers) {
    const Mesh solid = mesh::icosphere(1, 12);
    for (const int layers : {0, 1, 3}) {
        const Result<Built> built = build(std::span(&solid, 1), {.precision = 0.07, .layers = layers});
        ASSERT_TRUE(built);
        expect_consistent(*built);
        expect_exact_volumes(*built);
        std::set<octree::CellKey> cells(built->mesh.cells.begin(), built->mesh.cells.end());
        std::size_t larger = 0;
        for (mesh::CellIndex cell = 0; cell < built->mesh.cells.size(); ++cell) {
            if (built->mesh.set_of(cell).boundary.empty()) continue;
            for (int dz = -layers; dz <= layers; ++dz)
                for (int dy = -layers; dy <= layers; ++dy)
                    for (int dx = -layers; dx <= layers; ++dx) {
                        const octree::CellKey key = built->mesh.cells[cell];
                        const exact::Point low = key.low();
                        const octree::CellKey next = octree::CellKey::at(
                            {low.x + dx * key.side(), low.y + dy * key.side(), low.z + dz * key.side()},
                            key.level());
                        for (int level = 1; level < key.level(); ++level)
                            larger += cells.contains(next.ancestor(level));
                    }
        }
        EXPECT_EQ(larger, 0u) << layers;
        EXPECT_GT(built->report.largest_cell, built->report.smallest_cell);
    }
}

TEST(Build, GivesTheSameBytesForAnyNumberOfThreads) {
    const std::vector<Mesh> solids{mesh::displaced_sphere(40), moved(mesh::gear(), {0.5, 0, 0})};
    const Options options{.precision = 0.5, .solids = {{.solid = 0, .surface = 0.03}}};
    const Result<Built> one = build(solids, options, {.threads = 1, .on_progress = {}}),
                        two = build(solids, options, {.threads = 2, .on_progress = {}});
    ASSERT_TRUE(one && two);
    EXPECT_EQ(one->mesh.cells, two->mesh.cells);
    EXPECT_EQ(one->mesh.corners, two->mesh.corners);
    EXPECT_EQ(one->mesh.nodes, two->mesh.nodes);
    EXPECT_EQ(one->mesh.sets, two->mesh.sets);
    EXPECT_EQ(one->mesh.set_of_cell, two->mesh.set_of_cell);
    EXPECT_EQ(one->mesh.fractions, two->mesh.fractions);
    EXPECT_EQ(one->mesh.edge_hanging, two->mesh.edge_hanging);
    EXPECT_EQ(one->mesh.face_hanging, two->mesh.face_hanging);
}

TEST(Build, RefusesAMeshWithoutCells) {
    const Mesh sheet = mesh::box({0.1, 0.1, 0.1}, {10.1, 10.1, 0.101});
    for (const Keep keep : {Keep::half, Keep::manifold}) {
        const Result<Built> refused = build(std::span(&sheet, 1), {.level = 4, .keep = keep});
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().code, ErrorCode::bad_input);
        EXPECT_NE(refused.error().sentence.find("no cells"), std::string::npos);
    }
    EXPECT_FALSE(build_conforming(std::span(&sheet, 1), {.level = 4}));
    EXPECT_TRUE(build(std::span(&sheet, 1), {.level = 4}));
}

TEST(Build, KeepsWhatOneSolidKeepsWhenItIsGivenTwice) {
    const Mesh sphere = mesh::icosphere(1, 12);
    const std::vector<Mesh> twice{sphere, sphere};
    for (const Keep keep : {Keep::half, Keep::manifold}) {
        const Options options{.precision = 0.13, .layers = 1, .keep = keep};
        const Result<Built> once = build(std::span(&sphere, 1), options), both = build(twice, options);
        ASSERT_TRUE(once && both);
        EXPECT_EQ(once->mesh.cells, both->mesh.cells);
    }
}

TEST(Build, KeepsCellsThatTouchingSolidsFillTogether) {
    // Three boxes meet in the line x = 0.45, y = 0.6, and none of them fills half of a cell there.
    const std::vector<Mesh> parts{mesh::box({-2, -2, 0}, {0.45, 0.6, 2}),
                                  mesh::box({0.45, -2, 0}, {2, 0.6, 2}), mesh::box({-2, 0.6, 0}, {2, 2, 2})};
    const Mesh whole = mesh::box({-2, -2, 0}, {2, 2, 2});
    const Options options{.precision = 1, .largest = 1, .keep = Keep::half};
    const Result<Built> together = build(parts, options), one = build(std::span(&whole, 1), options);
    ASSERT_TRUE(together && one);
    EXPECT_EQ(together->mesh.cells, one->mesh.cells);
}

TEST(Build, SaysWhenRoundsOfSplittingWereNotEnough) {
    // Where cells of two sizes meet on the surface smaller ones cover a part of a larger one's side.
    const Mesh ball = mesh::icosphere(1, 16);
    Options options{.precision = 0.25, .boxes = {{{{-2, -2, -2}, {0.1, 0.2, 0.3}}, 0.0625}}};
    options.keep = Keep::manifold;
    const Result<Built> enough = build(std::span(&ball, 1), options);
    options.splitting_rounds = 0;
    const Result<Built> few = build(std::span(&ball, 1), options);
    ASSERT_TRUE(enough && few);
    EXPECT_EQ(enough->report.cut_off_cells, 0u);
    EXPECT_GT(few->report.cut_off_cells, 0u);
    EXPECT_LT(few->mesh.cells.size(), enough->mesh.cells.size());
}

TEST(Build, RefusesOptionsThatMakeNoSense) {
    const Mesh solid = mesh::cube();
    const auto code = [&](const Options& options) {
        const Result<Built> built = build(std::span(&solid, 1), options);
        return built ? ErrorCode::internal : built.error().code;
    };
    EXPECT_EQ(code({.precision = -1}), ErrorCode::bad_input);
    EXPECT_EQ(code({.precision = 1e-9}), ErrorCode::limit);
    EXPECT_EQ(code({.level = 22}), ErrorCode::bad_input);
    EXPECT_EQ(code({.solids = {{.solid = 1, .surface = 1}}}), ErrorCode::bad_input);
    EXPECT_EQ(code({.boxes = {{{}, 1}}}), ErrorCode::bad_input);
    const Result<Built> nothing = build({});
    EXPECT_FALSE(nothing);
    const std::atomic<bool> cancel = true;
    const Result<Built> cancelled = build(std::span(&solid, 1), {}, {.on_progress = {}, .cancel = &cancel});
    ASSERT_FALSE(cancelled);
    EXPECT_EQ(cancelled.error().code, ErrorCode::cancelled);
}

TEST(Build, MeshesDefectiveModelsRightlyOrSaysWhatIsWrongWhere) {
    const std::filesystem::path folder = tests::models_folder() / "defective";
    OCTAVO_NEEDS_MODEL("defective/cube-open.off");
    int meshed = 0, refused = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const auto model = io::read_mesh(entry.path().string());
        if (!model) continue;  // io/ has its own tests
        const Result<Built> built = build(std::span(&model->mesh, 1), {.level = 5});
        if (built) {
            expect_consistent(*built);
            expect_exact_volumes(*built);
            ++meshed;
        } else {
            EXPECT_EQ(built.error().code, ErrorCode::not_a_solid) << entry.path();
            EXPECT_FALSE(built.error().place.faces.empty()) << entry.path();
            ++refused;
        }
    }
    EXPECT_GT(meshed, 8);
    EXPECT_GT(refused, 25);
}

TEST(Build, FillsRealModelsToTheirExactVolume) {
    int tested = 0;
    for (const char* name : {"mechanical/anchor-7k.off", "mechanical/knot.off", "mechanical/fandisk-13k.obj",
                             "mechanical/plate-holes.stl", "classic/homer.off", "mechanical/snowflake.obj"}) {
        OCTAVO_NEEDS_MODEL(name);
        const auto model = io::read_mesh((tests::models_folder() / name).string());
        ASSERT_TRUE(model) << name;
        const Result<Built> built = build(std::span(&model->mesh, 1), {.level = 6});
        ASSERT_TRUE(built) << name << ": " << built.error().describe();
        expect_consistent(*built);
        expect_exact_volumes(*built);
        ++tested;
    }
    EXPECT_EQ(tested, 6);
}

/// A model that is closed but overlaps itself, or not as a solid at all, made one by a union with nothing.
std::optional<Result<Built>> build_united(const Mesh& model) {
    const auto united = boolean::unite(std::span(&model, 1));
    if (!united || united->mesh.triangles.empty()) return std::nullopt;
    return build(std::span(&united->mesh, 1), {.level = 7, .overlaps = OverlapPolicy::winding});
}

TEST(Build, FillsEveryModelThereIsToItsExactVolume) {
    if (tests::effort() < 10) GTEST_SKIP() << "set OCTAVO_TEST_EFFORT to 10 or more";
    OCTAVO_NEEDS_MODEL("classic");
    int filled = 0, united = 0, refused = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(tests::models_folder())) {
        const std::string extension = entry.path().extension().string();
        if (extension != ".ply" && extension != ".obj" && extension != ".off" && extension != ".stl")
            continue;
        const auto model = io::read_mesh(entry.path().string());
        if (!model) continue;
        SCOPED_TRACE(entry.path());
        const Result<Built> built = build(std::span(&model->mesh, 1), {.level = 7});
        if (built) {
            expect_exact_volumes(*built);
            ++filled;
            continue;
        }
        EXPECT_EQ(built.error().code, ErrorCode::not_a_solid);
        EXPECT_FALSE(built.error().place.faces.empty());
        if (const std::optional<Result<Built>> again = build_united(model->mesh)) {
            ASSERT_TRUE(*again) << again->error().describe();
            expect_exact_volumes(**again);
            ++united;
        } else {
            ++refused;
        }
    }
    std::cout << filled << " models filled, " << united << " as unions, " << refused
              << " refused with the place\n";
    EXPECT_GT(filled, 0);
}

}  // namespace
}  // namespace octavo::hexmesh
