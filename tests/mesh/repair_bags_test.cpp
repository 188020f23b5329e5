// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <random>

#include <gtest/gtest.h>

#include <octavo/mesh/repair.hpp>
#include <octavo/mesh/shapes.hpp>
#include <octavo/mesh/snap.hpp>
#include <octavo/mesh/transform.hpp>
#include <octavo/mesh/validate.hpp>

#include "effort.hpp"
#include "glued_solids.hpp"
#include "repaired.hpp"

// What repair must never do, whatever the input: to bags of bodies that share edges, facets and space.

namespace octavo::mesh {
namespace {

/// Whether no two of its facets meet but at their own edges and corners.
bool is_embedded(const Report& report) {
    for (const ProblemKind kind :
         {ProblemKind::self_intersections, ProblemKind::penetrations, ProblemKind::overlaps,
          ProblemKind::duplicate_facets, ProblemKind::snapped_facets})
        if (report.count(kind) > 0) return false;
    return true;
}

TEST(RepairOfBags, TwiceIsOnceAndWhatIsClosedStaysTheSameSolid) {
    std::size_t closed = 0, embedded = 0, valid = 0, places = 0;
    for (unsigned seed = 0; seed < 3000u * static_cast<unsigned>(tests::effort()); ++seed) {
        SCOPED_TRACE(seed);
        tests::GluedSolids bag(seed);
        const Mesh mesh = bag.next();
        const Mesh once = repaired(mesh).mesh, twice = repaired(once).mesh;
        ASSERT_EQ(once.vertices, twice.vertices);
        ASSERT_EQ(once.triangles, twice.triangles);
        if (!tests::every_edge_balances(mesh)) continue;
        ++closed;
        ASSERT_TRUE(tests::every_edge_balances(once));
        const Report before = report_of(mesh);
        if (before.solid) {
            ++valid;
            ASSERT_TRUE(report_of(once).solid);
        }
        if (!is_embedded(before)) continue;
        ++embedded;
        for (int i = 0; i < 20; ++i) {
            const Vec3 place = bag.place();
            const int was = tests::winding_number(mesh, place), is = tests::winding_number(once, place);
            ASSERT_EQ(std::abs(was), is) << place.x << " " << place.y << " " << place.z;
            places += was != 0;
        }
        ASSERT_EQ(report_of(once).count(ProblemKind::inside_out_shells), 0u);
    }
    EXPECT_GT(closed, 1000u);
    EXPECT_GT(embedded, 300u);
    EXPECT_GT(valid, 100u);
    EXPECT_GT(places, 100u);
}

TEST(RepairOfBags, KeepsAFacetThatTwoBodiesShare) {
    // A box in a higher one on the same ground: two facets are there twice, and both are needed.
    const Mesh shared = both(box({0, 0, 0}, {1, 1, 1}), box({0, 0, 0}, {1, 1, 2}));
    ASSERT_EQ(report_of(shared).count(ProblemKind::duplicate_facets), 2u);
    const Mesh result = repaired(shared).mesh;
    EXPECT_EQ(result.triangles.size(), shared.triangles.size());
    EXPECT_TRUE(tests::every_edge_balances(result));
    // What a file has twice goes as before: a facet, a patch, a sheet that is open, a whole body.
    const Mesh cube = box({0, 0, 0}, {1, 1, 1});
    for (const std::size_t count : {std::size_t{1}, std::size_t{2}, std::size_t{5}, cube.triangles.size()})
        for (const bool is_open : {false, true}) {
            Mesh twice = cube;
            if (is_open) twice.triangles.resize(count);
            for (std::size_t i = 0; i < count; ++i) twice.triangles.push_back(cube.triangles[i]);
            EXPECT_EQ(repaired(twice).mesh.triangles.size(), is_open ? count : cube.triangles.size())
                << count;
        }
}

TEST(RepairOfBags, JoinsABodyToOneThatIsInsideOut) {
    // The common side faces the same way twice until the second body is turned; then it is a wall.
    const Mesh first = box({0, 0, 0}, {1, 1, 1}), second = flipped(box({1, 0, 0}, {2, 1, 1}));
    for (const Mesh& mesh : {both(first, second), both(second, first)}) {
        const Repaired result = repaired(mesh);
        EXPECT_TRUE(tests::every_edge_balances(result.mesh));
        EXPECT_EQ(tests::winding_number(result.mesh, {0.5, 0.4, 0.3}), 1);
        EXPECT_EQ(tests::winding_number(result.mesh, {1.5, 0.4, 0.3}), 1);
        EXPECT_EQ(result.mesh.triangles.size(), 20u);
        EXPECT_TRUE(report_of(result.mesh).solid);
    }
}

TEST(RepairOfBags, TurnsTheBodyThatIsInsideOutAtACommonEdge) {
    const Mesh large = box({0, 0, 0}, {2, 2, 1}), small = box({2, 2, 0}, {3, 3, 1});
    for (const bool swaps : {false, true}) {
        const Mesh bad = swaps ? both(flipped(small), large) : both(large, flipped(small));
        const Report report = report_of(bad);
        EXPECT_EQ(report.count(ProblemKind::inside_out_shells), 1u);
        EXPECT_FALSE(report.solid);
        const Repaired result = repaired(bad);
        EXPECT_EQ(result.report.count(RepairKind::turned_shells), 1u);
        EXPECT_EQ(result.report.count(RepairKind::separated_edges), 1u);
        EXPECT_TRUE(report_of(result.mesh).solid);
        EXPECT_EQ(tests::winding_number(result.mesh, {1.1, 1.2, 0.3}), 1);
        EXPECT_EQ(tests::winding_number(result.mesh, {2.5, 2.6, 0.3}), 1);
    }
    // Within a third body they are a body in a body and a cavity, and right as they are.
    const Mesh around = box({-1, -1, -1}, {4, 4, 2});
    const Mesh inner = join(std::array{around, large, flipped(small)});
    EXPECT_TRUE(report_of(inner).solid);
    EXPECT_EQ(report_of(inner).cavities, 1u);
    EXPECT_EQ(repaired(inner).report.count(RepairKind::turned_shells), 0u);
    // All of it inside out is turned as a whole, and keeps the cavity.
    const Mesh outer = repaired(flipped(inner)).mesh;
    EXPECT_EQ(tests::winding_number(outer, {-0.5, 0.1, 0.3}), 1);
    EXPECT_EQ(tests::winding_number(outer, {1.1, 1.2, 0.3}), 2);
    EXPECT_EQ(tests::winding_number(outer, {2.5, 2.6, 0.3}), 0);
}

}  // namespace
}  // namespace octavo::mesh
