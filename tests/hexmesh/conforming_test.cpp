// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <atomic>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <octavo/hexmesh/conforming.hpp>
#include <octavo/hexmesh/cubic_grid.hpp>
#include <octavo/hexmesh/quality.hpp>
#include <octavo/mesh/hex_sides.hpp>
#include <octavo/mesh/shapes.hpp>

namespace octavo::hexmesh {
namespace {

/// No node lies inside an edge or a side of a cell: every side of one cell is one of another, or on the boundary, whose
/// edges have two sides each, or four where it touches itself.
void expect_conforming(const mesh::HexMesh& mesh) {
    std::map<std::set<mesh::NodeIndex>, int> sides;
    for (const auto& corners : mesh.corners)
        for (const auto& side : mesh::corners_of_side) {
            std::set<mesh::NodeIndex> nodes;
            for (const std::uint8_t corner : side) nodes.insert(corners[corner]);
            ASSERT_EQ(nodes.size(), 4u);
            ++sides[nodes];
        }
    std::size_t boundary = 0;
    for (const auto& [nodes, count] : sides) {
        ASSERT_LE(count, 2);
        boundary += count == 1;
    }
    const mesh::BoundarySides found = mesh::boundary_sides(mesh);
    EXPECT_EQ(found.sides.size(), boundary);
    std::map<std::pair<mesh::NodeIndex, mesh::NodeIndex>, int> edges;
    for (const mesh::HexSide& side : found.sides)
        for (std::size_t i = 0; i < 4; ++i) ++edges[{side.corners[i], side.corners[(i + 1) % 4]}];
    for (const auto& [edge, count] : edges) {
        const auto back = edges.find({edge.second, edge.first});
        ASSERT_TRUE(back != edges.end() && back->second == count) << "a crack";
    }
    std::set<std::array<double, 3>> places;
    for (const Vec3& p : mesh.positions) places.insert({p.x, p.y, p.z});
    EXPECT_EQ(places.size(), mesh.positions.size());
}

TEST(BuildConforming, FillsABoxOnTheGridExactly) {
    const mesh::Mesh box = mesh::box({0, 0, 0}, {18, 27, 9});
    Options options{.precision = 3};
    options.boxes = {{{{8, 8, 2}, {10, 10, 4}}, 1.0 / 3}};
    const Result<Built> built = build_conforming(std::span(&box, 1), options);
    ASSERT_TRUE(built) << built.error().describe();
    expect_conforming(built->mesh);
    const Quality quality = measure_quality(built->mesh);
    EXPECT_EQ(quality.not_proved_positive, 0u);
    EXPECT_GT(quality.least, 0.13);
    EXPECT_LT(quality.least, 0.9) << "templates must occur";
    EXPECT_NEAR(built->report.solids[0].inside_volume, 18 * 27 * 9, 1e-6);
    for (mesh::CellIndex cell = 0; cell < built->mesh.cell_count(); ++cell) {
        Box3 bounds;
        for (const Vec3& p : corners_of(built->mesh, cell)) bounds.add(p);
        const bool meets = bounds.low.x < 10 && bounds.high.x > 8 && bounds.low.y < 10 && bounds.high.y > 8 &&
                           bounds.low.z < 4 && bounds.high.z > 2;
        if (meets) {
            EXPECT_LE(bounds.extents().x, 1.0 / 3 + 1e-12);
        }
    }
}

TEST(BuildConforming, ConformsWhereSizesDiffer) {
    const mesh::Mesh sphere = mesh::icosphere(1, 8);
    Options options{.precision = 0.3};
    options.boxes = {{{{0.2, 0.2, 0.2}, {0.3, 0.5, 0.4}}, 0.04}, {{{-0.9, -0.2, -0.1}, {-0.5, 0, 0}}, 0.1}};
    const Result<Built> built = build_conforming(std::span(&sphere, 1), options);
    ASSERT_TRUE(built) << built.error().describe();
    expect_conforming(built->mesh);
    const Quality quality = measure_quality(built->mesh);
    EXPECT_EQ(quality.not_proved_positive, 0u);
    EXPECT_GT(built->report.largest_cell / built->report.smallest_cell, 2);
    EXPECT_NEAR(built->report.solids[0].inside_volume / quality.volume, 1, 1e-12);
    EXPECT_NEAR(built->report.solids[0].inside_volume / built->report.solids[0].exact_volume, 1, 0.05);
}

TEST(BuildConforming, KnowsSeveralSolids) {
    const std::vector<mesh::Mesh> solids{mesh::box({0, 0, 0}, {2, 1, 1}), mesh::box({1, 0, 0}, {3, 1, 1})};
    const Result<Built> built = build_conforming(solids, {.precision = 0.25});
    ASSERT_TRUE(built);
    expect_conforming(built->mesh);
    std::map<std::vector<mesh::SolidIndex>, int> cells;
    for (mesh::CellIndex cell = 0; cell < built->mesh.cell_count(); ++cell)
        ++cells[built->mesh.set_of(cell).inside];
    EXPECT_EQ(cells, (std::map<std::vector<mesh::SolidIndex>, int>{{{0}, 64}, {{0, 1}, 64}, {{1}, 64}}));
}

TEST(BuildConforming, RefusesMoreLevelsThanItHasAndNamesTheOption) {
    const mesh::Mesh box = mesh::box({0, 0, 0}, {1, 1, 1});
    Options options{.precision = 0.5};
    const double tiny = 0.5 / (177147 * 1.5);  // 3^11, and a little smaller
    options.boxes = {{{{0.4, 0.4, 0.4}, {0.4 + tiny, 0.4 + tiny, 0.4 + tiny}}, tiny}};
    const Result<Built> refused = build_conforming(std::span(&box, 1), options);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::limit);
    EXPECT_NE(refused.error().sentence.find("size in a box"), std::string::npos) << refused.error().sentence;
}

TEST(BuildConforming, RefusesMoreSetsOfSolidsThanCellsCanNumber) {
    // Cells are thirds, and slabs end at thirds: 41^3 sets. The octree has halves, and fewer.
    std::vector<mesh::Mesh> slabs;
    constexpr int thirds = 41;
    constexpr double side = thirds / 3.0;
    for (int axis = 0; axis < 3; ++axis)
        for (int i = 1; i <= thirds; ++i) {
            Vec3 high{side, side, side};
            high[axis] = i / 3.0;
            slabs.push_back(mesh::box({0, 0, 0}, high));
        }
    Options options{.precision = 1};
    options.boxes = {{{{0, 0, 0}, {side, side, side}}, 0.5}};
    const Result<Built> refused = build_conforming(slabs, options);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().sentence.find("65536"), std::string::npos) << refused.error().sentence;
}

TEST(BuildConforming, RefusesTooManyCellsBeforeItHasThem) {
    const mesh::Mesh box = mesh::box({0, 0, 0}, {1000, 1000, 1000});
    const Result<Built> refused =
        build_conforming(std::span(&box, 1), {.precision = 1, .largest = 0, .max_cells = 20'000'000});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::limit);
    EXPECT_EQ(refused.error().option, "max_cells");
}

TEST(BuildConforming, AllowsAsManyCellsAsItHas) {
    const mesh::Mesh solid = mesh::icosphere(1, 8);
    Options options{.precision = 0.3};
    options.boxes = {{{{0.2, 0.2, 0.2}, {0.3, 0.5, 0.4}}, 0.04}};
    const Result<Built> built = build_conforming(std::span(&solid, 1), options);
    ASSERT_TRUE(built);
    options.max_cells = built->report.tree_cells;
    EXPECT_TRUE(build_conforming(std::span(&solid, 1), options));
    --options.max_cells;
    EXPECT_FALSE(build_conforming(std::span(&solid, 1), options));
}

TEST(CubicGrid, IsFullWhenItHasMoreLeavesThanAllowed) {
    const auto leaves_of = [](CubicGrid& grid) {
        std::uint64_t leaves = 0;
        grid.for_each_leaf([&](const CubicGrid::Leaf&) { ++leaves; });
        return leaves;
    };
    const auto fill = [](CubicGrid& grid) {
        for (std::int64_t x = 0; x < 4; ++x)
            for (std::int64_t y = 0; y < 4; ++y) grid.add_root({x, y, 0}), grid.add_root({x, y, 0});
        // Two cells that are cut and share an edge: those between them have no template.
        grid.refine_to(0, {10, 13, 4});
        grid.refine_to(0, {13, 10, 4});
        grid.close();
    };
    CubicGrid grid(3);
    fill(grid);
    const std::uint64_t leaves = leaves_of(grid);
    EXPECT_GT(leaves, 16u + 3 * 26u) << "closing must cut more";
    CubicGrid enough(3, leaves), less(3, leaves - 1);
    fill(enough), fill(less);
    EXPECT_FALSE(enough.is_full());
    EXPECT_TRUE(less.is_full());
}

TEST(CubicGrid, StopsWhenItIsCancelled) {
    const std::atomic<bool> cancel = true;
    Context context;
    context.cancel = &cancel;
    CubicGrid grid(3), whole(3);
    for (CubicGrid* each : {&grid, &whole}) {
        each->add_root({0, 0, 0});
        each->refine_to(0, {1, 4, 4}), each->refine_to(0, {4, 1, 4});
    }
    grid.close(context), whole.close();
    std::size_t cut_in_part = 0, cut = 0;
    grid.for_each_leaf([&](const CubicGrid::Leaf&) { ++cut_in_part; });
    whole.for_each_leaf([&](const CubicGrid::Leaf&) { ++cut; });
    EXPECT_LT(cut_in_part, cut);
}

TEST(BuildConforming, IsTheSameForAnyNumberOfThreadsAndRefusesWhatIsOpen) {
    const mesh::Mesh solid = mesh::displaced_sphere(10);
    Context one, two;
    one.threads = 1, two.threads = 2;
    const Result<Built> a = build_conforming(std::span(&solid, 1), {.level = 4}, one),
                        b = build_conforming(std::span(&solid, 1), {.level = 4}, two);
    ASSERT_TRUE(a && b);
    EXPECT_EQ(a->mesh.corners, b->mesh.corners);
    EXPECT_EQ(a->mesh.positions, b->mesh.positions);
    mesh::Mesh open = solid;
    open.triangles.pop_back();
    const Result<Built> refused = build_conforming(std::span(&open, 1), {.level = 4});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::not_a_solid);
    const Result<Built> tiny = build_conforming(std::span(&solid, 1), {.precision = 1e-6});
    ASSERT_FALSE(tiny);
}

}  // namespace
}  // namespace octavo::hexmesh
