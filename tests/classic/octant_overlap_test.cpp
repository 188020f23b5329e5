// SPDX-License-Identifier: Apache-2.0
#include <random>
#include <vector>

#include <classic/rational.hpp>
#include <classic/solids.hpp>
#include <gtest/gtest.h>

#include <octavo/classic/facet.hpp>
#include <octavo/classic/octant_overlap.hpp>

#include "effort.hpp"

namespace octavo::classic {
namespace {

using octree::Cell;
using octree::CellKey;
using tests::GridPoints;

Facet facet_of(std::array<exact::Point, 3> p) {
    mesh::LatticeMesh mesh;
    mesh.points.assign(p.begin(), p.end());
    mesh.triangles = {{0, 1, 2}};
    return facets_of(mesh)->at(0);
}

bool has_area(std::array<exact::Point, 3> p) {
    mesh::LatticeMesh mesh;
    mesh.points.assign(p.begin(), p.end());
    mesh.triangles = {{0, 1, 2}};
    return !facets_of(mesh)->empty();
}

bool oracle(const std::array<exact::Point, 3>& p, const Cell& cell, Touch touch) {
    return touch == Touch::interior ? tests::meets_open_box(p, cell.low, cell.high())
                                    : tests::meets_half_open_box(p, cell.low, cell.high());
}

template <Touch touch>
OctantSet fast_octants(const std::array<const Facet*, 4>& four, std::size_t lane, const Cell& cell) {
    const Bounds bounds = OctantFrame<touch>(cell).bounds(*four[lane]);
    if (bounds.is_exact) return bounds.octants;
    return bounds.octants & touched_octants(four, cell, touch)[lane];
}

/// A triangle and a cell it may touch, of one of the kinds that matter.
struct Case {
    std::array<exact::Point, 3> triangle;
    Cell cell;
};

Case random_case(std::mt19937& random) {
    const auto below = [&](std::int32_t bound) {
        return static_cast<std::int32_t>(random() % static_cast<unsigned>(bound));
    };
    const int level = static_cast<int>(random() % 12);
    const exact::Point inside{below(exact::universe_side), below(exact::universe_side),
                              below(exact::universe_side)};
    const Cell cell = Cell::of(CellKey::at(inside, level));
    const std::int32_t side = cell.side();
    // Corners on a grid of 1, 1/2, 1/4… of the cell (degenerate), or anywhere, up to several sides away.
    const std::int32_t reach = 1 << (random() % 3);
    const unsigned kind = static_cast<unsigned>(random() % 4);
    Case result{{}, cell};
    for (exact::Point& p : result.triangle) {
        std::int32_t* coordinates[3] = {&p.x, &p.y, &p.z};
        for (int axis = 0; axis < 3; ++axis) {
            const std::int64_t width = std::int64_t{side} * reach;
            std::int64_t offset =
                static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(width + 1)) -
                (width - side) / 2;
            if (kind < 3) offset &= -(std::int64_t{side} >> kind);
            *coordinates[axis] = static_cast<std::int32_t>(
                std::clamp<std::int64_t>(cell.low[axis] + offset, 0, exact::universe_side - 1));
        }
    }
    return result;
}

TEST(TouchesOracle, AgreesWithClippingInRationals) {
    std::mt19937 random(1);
    for (int round = 0; round < 4000 * tests::effort(); ++round) {
        const Case c = random_case(random);
        if (!has_area(c.triangle)) continue;
        for (const Touch touch : {Touch::interior, Touch::half_open})
            ASSERT_EQ(touches(facet_of(c.triangle), c.cell, touch), oracle(c.triangle, c.cell, touch))
                << round;
    }
}

template <Touch touch>
void expect_fast_octants_equal_the_textbook_test(unsigned seed) {
    std::mt19937 random(seed);
    int touched_cells = 0;
    std::array<int, 9> by_count{};
    for (int round = 0; round < 400000 * tests::effort(); ++round) {
        // Four facets at a time for one cell; those that do not touch it are outside the precondition.
        const Case c = random_case(random);
        if (!has_area(c.triangle)) continue;
        const Facet facet = facet_of(c.triangle);
        if (!touches(facet, c.cell, touch)) continue;
        std::array<exact::Point, 3> turned{c.triangle[1], c.triangle[0], c.triangle[2]};
        const Facet other = facet_of(turned);
        const std::array<const Facet*, 4> four{&facet, &other, &facet, nullptr};
        ++touched_cells;
        OctantSet expected = 0;
        for (int i = 0; i < 8; ++i)
            if (touches(facet, c.cell.child(i), touch)) expected = static_cast<OctantSet>(expected | 1 << i);
        ++by_count[static_cast<std::size_t>(std::popcount(expected))];
        ASSERT_EQ(fast_octants<touch>(four, 0, c.cell), expected) << round;
        ASSERT_EQ(fast_octants<touch>(four, 1, c.cell), expected) << round << " turned";
    }
    EXPECT_GT(touched_cells, 50000);
    for (std::size_t count = 1; count <= 7; ++count) EXPECT_GT(by_count[count], 100) << count << " octants";
}

TEST(OctantOverlap, EqualsTheTextbookTestOfEachOctantForInteriors) {
    expect_fast_octants_equal_the_textbook_test<Touch::interior>(2);
}

TEST(OctantOverlap, EqualsTheTextbookTestOfEachOctantForHalfOpenCells) {
    expect_fast_octants_equal_the_textbook_test<Touch::half_open>(3);
}

TEST(OctantOverlap, TouchesNoInteriorWithAFacetInAWall) {
    const std::int32_t half = exact::universe_side / 2;
    const Facet wall = facet_of({exact::Point{half, 0, 0}, {half, half, 0}, {half, 0, half}});
    EXPECT_EQ(OctantFrame<Touch::interior>(Cell::root()).bounds(wall).octants, 0);
    EXPECT_TRUE(OctantFrame<Touch::interior>(Cell::root()).bounds(wall).is_exact);
    // Half-open: the wall belongs to the high side; its far edges, at half, lie in the next octants again.
    const std::array<const Facet*, 4> four{&wall};
    EXPECT_EQ(fast_octants<Touch::half_open>(four, 0, Cell::root()), 0b00101010) << "octants 1, 3, 5";
}

TEST(FacetsOf, LeavesOutFacetsWithoutAreaAndRefusesBadIndices) {
    mesh::LatticeMesh mesh;
    mesh.points = {{0, 0, 0}, {10, 10, 10}, {20, 20, 20}, {0, 5, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 1, 3}, {1, 1, 3}};
    const Result<std::vector<Facet>> facets = facets_of(mesh);
    ASSERT_EQ(facets->size(), 1u);
    EXPECT_EQ(facets->at(0).source, 1u);
    mesh.triangles.push_back({0, 1, 4});
    ASSERT_FALSE(facets_of(mesh));
    EXPECT_EQ(facets_of(mesh).error().place.faces, std::vector<std::uint32_t>{3});
    mesh.triangles.pop_back();
    mesh.points.push_back({0, 0, exact::universe_side});
    EXPECT_FALSE(facets_of(mesh));
}

}  // namespace
}  // namespace octavo::classic
