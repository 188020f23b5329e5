// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <octavo/hexmesh/build.hpp>
#include <octavo/mesh/shapes.hpp>

#include "hexmesh/solids.hpp"

// Surfaces in the walls between cells: cells beside them are as small as cells that a surface passes through.

namespace octavo::hexmesh {
namespace {

using mesh::Mesh;

struct BoxSolid {
    Box3 box;
    double size;  ///< asked for on its surface
};

Box3 box_of(const mesh::HexMesh& mesh, mesh::CellIndex cell) {
    return {mesh.position(mesh.corners[cell][0]), mesh.position(mesh.corners[cell][7])};
}

/// Whether a part of one of the faces of `solid` lies in a side of `cell` or inside it.
bool has_a_part_of_the_surface(const Box3& cell, const Box3& solid) {
    for (int axis = 0; axis < 3; ++axis)
        for (const double plane : {solid.low[axis], solid.high[axis]}) {
            bool overlaps = cell.low[axis] <= plane && plane <= cell.high[axis];
            for (const int other : {(axis + 1) % 3, (axis + 2) % 3})
                overlaps = overlaps && std::max(cell.low[other], solid.low[other]) <
                                           std::min(cell.high[other], solid.high[other]);
            if (overlaps) return true;
        }
    return false;
}

TEST(RefineAtWalls, SplitsAtTheFacesOfABoxOnTheGrid) {
    const Mesh box = mesh::box({0, 0, 0}, {16, 8, 8});
    const Result<Built> built = build(std::span(&box, 1), {.precision = 0.5});
    ASSERT_TRUE(built) << built.error().describe();
    EXPECT_EQ(built->report.smallest_cell, 0.5);
    EXPECT_EQ(built->report.largest_cell, 2);
    EXPECT_EQ(built->report.boundary_cells, 0u) << "it passes through none of them";
    for (mesh::CellIndex cell = 0; cell < built->mesh.cell_count(); ++cell) {
        const Box3 seen = box_of(built->mesh, cell);
        if (has_a_part_of_the_surface(seen, {{0, 0, 0}, {16, 8, 8}})) {
            EXPECT_EQ(seen.high.x - seen.low.x, 0.5);
        }
    }
    expect_exact_volumes(*built);
}

TEST(RefineAtWalls, GivesEverySurfaceItsSizeAmongRandomBoxes) {
    std::mt19937_64 random(11);
    const auto at = [&](int below) { return static_cast<double>(random() % static_cast<unsigned>(below)); };
    std::size_t beside = 0;
    for (int round = 0; round < 40; ++round) {
        std::vector<BoxSolid> boxes;
        std::vector<Mesh> solids;
        Options options{.precision = 4};
        for (mesh::SolidIndex solid = 0; solid < 3; ++solid) {
            const double size = std::vector<double>{0.5, 1, 2}[random() % 3];
            const Vec3 low = size * Vec3{at(6), at(6), at(6)};
            const Vec3 high = low + size * Vec3{1 + at(8), 1 + at(8), 1 + at(8)};
            boxes.push_back({{low, high}, size});
            solids.push_back(mesh::box(low, high));
            options.solids.push_back({.solid = solid, .surface = size});
        }
        options.keep = round % 2 ? Keep::all : Keep::touched;
        options.balance = round % 3 ? octree::Contact::edge : octree::Contact::face;
        const Result<Built> built = build(solids, options);
        ASSERT_TRUE(built) << built.error().describe();
        expect_exact_volumes(*built);
        for (mesh::CellIndex cell = 0; cell < built->mesh.cell_count(); ++cell) {
            const Box3 seen = box_of(built->mesh, cell);
            for (const BoxSolid& solid : boxes)
                if (has_a_part_of_the_surface(seen, solid.box)) {
                    ASSERT_LE(seen.high.x - seen.low.x, solid.size) << round;
                    ++beside;
                }
        }
    }
    EXPECT_GT(beside, 10'000u);
}

TEST(RefineAtWalls, ReachesCellsThatTheSurfaceOfACoarserSolidPassesThrough) {
    // The ball asks for cells of 2, the box for 0.25 on faces that lie in the walls of the ball's cells.
    const std::vector<Mesh> solids{moved(mesh::icosphere(5, 6), {4.1, 4.2, 4.3}),
                                   mesh::box({4, 4, 4}, {8, 8, 12})};
    Options options{.precision = 2};
    options.solids = {{.solid = 1, .surface = 0.25}};
    const Result<Built> built = build(solids, options);
    ASSERT_TRUE(built) << built.error().describe();
    expect_exact_volumes(*built);
    for (mesh::CellIndex cell = 0; cell < built->mesh.cell_count(); ++cell) {
        const Box3 seen = box_of(built->mesh, cell);
        if (has_a_part_of_the_surface(seen, {{4, 4, 4}, {8, 8, 12}})) {
            EXPECT_LE(seen.high.x - seen.low.x, 0.25);
        }
    }
}

TEST(RefineAtWalls, LeavesAloneWhereShellsTouchFaceToFace) {
    // The faces between the two halves cancel: no surface is there, and cells in the middle stay large.
    const Mesh halves = joined(mesh::box({0, 0, 0}, {16, 16, 16}), mesh::box({16, 0, 0}, {32, 16, 16}));
    const Result<Built> built = build(std::span(&halves, 1), {.precision = 1});
    ASSERT_TRUE(built) << built.error().describe();
    std::size_t large = 0;
    for (mesh::CellIndex cell = 0; cell < built->mesh.cell_count(); ++cell) {
        const Box3 seen = box_of(built->mesh, cell);
        large += (seen.low.x == 16 || seen.high.x == 16) && seen.high.x - seen.low.x == 4;
    }
    EXPECT_GT(large, 0u);
}

TEST(RefineAtWalls, CountsLayersFromThere) {
    const Mesh box = mesh::box({0, 0, 0}, {32, 32, 32});
    const Result<Built> built = build(std::span(&box, 1), {.precision = 1, .layers = 3});
    ASSERT_TRUE(built) << built.error().describe();
    for (mesh::CellIndex cell = 0; cell < built->mesh.cell_count(); ++cell) {
        const Box3 seen = box_of(built->mesh, cell);
        for (int axis = 0; axis < 3; ++axis)
            if (seen.low[axis] < 4 || seen.high[axis] > 28) {
                ASSERT_EQ(seen.high.x - seen.low.x, 1);
            }
    }
    EXPECT_GT(built->report.largest_cell, 1);
}

TEST(RefineAtWalls, RefusesTooManyCellsBeforeItHasThem) {
    const Mesh box = mesh::box({0, 0, 0}, {1024, 1024, 1024});
    const Result<Built> refused = build(std::span(&box, 1), {.precision = 1.0 / 1024, .max_cells = 100'000});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::limit);
    EXPECT_EQ(refused.error().option, "max_cells");
}

}  // namespace
}  // namespace octavo::hexmesh
