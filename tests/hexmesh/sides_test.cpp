// SPDX-License-Identifier: Apache-2.0
#include <map>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include <octavo/hexmesh/build.hpp>
#include <octavo/hexmesh/to_polyhedra.hpp>
#include <octavo/mesh/hex_sides.hpp>
#include <octavo/mesh/material_names.hpp>
#include <octavo/mesh/shapes.hpp>

namespace octavo::hexmesh {
namespace {

/// The boundary by another way: polyhedra know their neighbours by walking the tree.
std::map<mesh::CellIndex, double> boundary_areas(const mesh::HexMesh& mesh) {
    std::map<mesh::CellIndex, double> areas;
    const mesh::PolyhedralMesh polyhedra = to_polyhedra(mesh);
    for (std::size_t face = polyhedra.neighbour.size(); face < polyhedra.owner.size(); ++face) {
        Vec3 twice;
        const std::uint32_t begin = polyhedra.face_begin[face], end = polyhedra.face_begin[face + 1];
        for (std::uint32_t i = begin + 2; i < end; ++i) {
            const Vec3 a = polyhedra.points[polyhedra.face_points[begin]];
            twice = twice + cross(polyhedra.points[polyhedra.face_points[i - 1]] - a,
                                  polyhedra.points[polyhedra.face_points[i]] - a);
        }
        areas[polyhedra.owner[face]] += length(twice) / 2;
    }
    return areas;
}

TEST(BoundarySides, AreThoseThatNoCellLiesBehind) {
    for (const mesh::Mesh& solid : {mesh::icosphere(1, 6), mesh::gear(), mesh::menger_sponge(2)}) {
        const Result<Built> built = build(std::span(&solid, 1), {.level = 5});
        ASSERT_TRUE(built);
        const mesh::BoundarySides found = mesh::boundary_sides(built->mesh);
        EXPECT_EQ(found.partly_covered, 0u);
        std::map<mesh::CellIndex, double> areas;
        for (const mesh::HexSide& side : found.sides) {
            const Vec3 a = built->mesh.position(side.corners[0]);
            const Vec3 normal =
                cross(built->mesh.position(side.corners[1]) - a, built->mesh.position(side.corners[3]) - a);
            areas[side.cell] += length(normal);
            // Outwards: away from the middle of the cell.
            const Vec3 middle = 0.5 * (built->mesh.position(built->mesh.corners[side.cell][0]) +
                                       built->mesh.position(built->mesh.corners[side.cell][7]));
            ASSERT_GT(dot(normal, a - middle), 0);
            ASSERT_EQ(normal[static_cast<int>(side.side / 2)] > 0, side.side % 2 == 1);
        }
        EXPECT_EQ(areas, boundary_areas(built->mesh));
    }
}

TEST(BoundarySides, CountsLargerSidesThatAreCoveredInPart) {
    const mesh::Mesh solid = mesh::icosphere(1, 8);
    Options options{.precision = 0.25};
    options.boxes = {{{{-1, -1, -1}, {0.1, 0.1, 0.1}}, 0.0625}};
    const Result<Built> built = build(std::span(&solid, 1), options);
    ASSERT_TRUE(built);
    EXPECT_GT(mesh::boundary_sides(built->mesh).partly_covered, 0u);
}

TEST(Materials, JoinInsideAndBoundary) {
    const std::vector<mesh::Mesh> solids{mesh::box({0, 0, 0}, {2, 2, 2}), mesh::box({1.1, 0, 0}, {3, 2, 2})};
    const Result<Built> built = build(solids, {.precision = 0.5, .largest = 0.5});
    ASSERT_TRUE(built);
    const mesh::Materials materials = mesh::materials_of(built->mesh);
    EXPECT_EQ(materials.solids, (std::vector<std::vector<mesh::SolidIndex>>{{0}, {0, 1}, {1}}));
    for (mesh::CellIndex cell = 0; cell < built->mesh.cell_count(); ++cell) {
        const double x = built->mesh.position(built->mesh.corners[cell][0]).x;
        EXPECT_EQ(materials.of(built->mesh, cell), x < 1 ? 0u : x < 2 ? 1u : 2u);
    }
    const std::string names[] = {"a"};
    const mesh::MaterialNames named = mesh::name_materials(materials, names, {});
    EXPECT_EQ(named.materials, (std::vector<std::string>{"a", "a+solid_1", "solid_1"}));
    EXPECT_EQ(named.outside, "outside");
}

TEST(BuildKeepingHalf, GivesEachCellToWhoeverFillsHalfOfIt) {
    // Two boxes that meet at x = 1.3 inside a cell, and stop a quarter of a cell beyond the grid.
    const std::vector<mesh::Mesh> solids{mesh::box({0, 0, 0}, {1.3, 2, 2.1}),
                                         mesh::box({1.3, 0, 0}, {3, 2, 2.4})};
    const Result<Built> built = build(solids, {.precision = 0.5, .largest = 0.5, .keep = Keep::half});
    ASSERT_TRUE(built);
    std::map<std::vector<mesh::SolidIndex>, std::size_t> cells;
    const mesh::Materials materials = mesh::materials_of(built->mesh);
    for (mesh::CellIndex cell = 0; cell < built->mesh.cell_count(); ++cell)
        ++cells[materials.solids[materials.of(built->mesh, cell)]];
    // Solid 0 fills three fifths of the cells from 1 to 1.5; of the top layer solid 0 fills a fifth, solid 1 four
    // fifths.
    EXPECT_EQ(cells,
              (std::map<std::vector<mesh::SolidIndex>, std::size_t>{{{0}, 3 * 4 * 4}, {{1}, 3 * 4 * 5}}));
    std::size_t entries = 0;
    for (mesh::CellIndex cell = 0; cell < built->mesh.cell_count(); ++cell)
        entries += built->mesh.set_of(cell).boundary.size();
    EXPECT_EQ(built->mesh.fractions.size(), entries);
    for (const SolidReport& solid : built->report.solids)
        EXPECT_NEAR(solid.filled_volume / solid.exact_volume, 1, 1e-9);
}

}  // namespace
}  // namespace octavo::hexmesh
