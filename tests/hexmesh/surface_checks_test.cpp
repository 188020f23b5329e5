// SPDX-License-Identifier: Apache-2.0
#include <numbers>
#include <span>

#include <gtest/gtest.h>

#include <octavo/hexmesh/build.hpp>
#include <octavo/hexmesh/conforming.hpp>
#include <octavo/mesh/shapes.hpp>

#include "hexmesh/solids.hpp"

// Surfaces that bound no solid: what build() refuses, and what it says.

namespace octavo::hexmesh {
namespace {

using mesh::Mesh;

TEST(Build, RefusesWhatIsNoSolidAndNamesFacets) {
    Mesh open = mesh::icosphere(1, 3);
    open.triangles.erase(open.triangles.begin() + 7);
    const Result<Built> leaking = build(std::span(&open, 1));
    ASSERT_FALSE(leaking);
    EXPECT_EQ(leaking.error().code, ErrorCode::not_a_solid);
    EXPECT_FALSE(leaking.error().place.faces.empty());
    const Result<Built> closed =
        build(std::span(&open, 1), {.level = 4, .open = classic::OpenPolicy::winding});
    ASSERT_TRUE(closed) << closed.error().describe();
    EXPECT_FALSE(closed->report.solids[0].open_facets.empty());
    expect_exact_volumes(*closed);

    const Mesh inside_out = reversed(mesh::icosphere(1, 3));
    const Mesh doubled = joined(mesh::icosphere(1, 3), moved(mesh::icosphere(1, 3), {0.9, 0, 0}));
    for (const Mesh& mesh : {inside_out, doubled}) {
        const Result<Built> refused = build(std::span(&mesh, 1), {.level = 4});
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().code, ErrorCode::not_a_solid);
        EXPECT_FALSE(refused.error().place.faces.empty());
    }
    const Result<Built> accepted =
        build(std::span(&doubled, 1), {.level = 4, .overlaps = OverlapPolicy::winding});
    ASSERT_TRUE(accepted);
    EXPECT_TRUE(accepted->report.overlaps);
    // Cells inside count once, the exact volume counts twice what is covered twice.
    const SolidReport& solid = accepted->report.solids[0];
    const double one = 4 * std::numbers::pi / 3, lens = std::numbers::pi * (4 + 0.9) * 1.1 * 1.1 / 12;
    EXPECT_LT(solid.filled_volume, solid.exact_volume);
    EXPECT_GT(solid.filled_volume, 0.8 * (2 * one - lens));
}

TEST(Build, NamesOnlyFacetsOfTheMeshWhereClosingAHoleMakesItOverlap) {
    Mesh box{{{0, 0, 0},
              {10, 0, 0},
              {0, 10, 0},
              {10, 10, 0},
              {-8, 7.5, 1.6},
              {9.9, 6, 3.4},
              {4.2, 18, 12.3},
              {15, 3, 8.8}},
             {},
             {}};
    for (const auto& [a, b, c, d] : {std::array{0u, 2u, 3u, 1u},
                                     {0u, 1u, 5u, 4u},
                                     {2u, 6u, 7u, 3u},
                                     {0u, 4u, 6u, 2u},
                                     {1u, 3u, 7u, 5u}}) {
        box.triangles.push_back({a, b, c});
        box.triangles.push_back({a, c, d});
    }
    const Result<Built> refused =
        build(std::span(&box, 1), {.level = 5, .open = classic::OpenPolicy::winding});
    ASSERT_FALSE(refused);
    EXPECT_FALSE(refused.error().place.faces.empty());
    for (const std::uint32_t face : refused.error().place.faces) EXPECT_LT(face, box.triangles.size());
}

TEST(Build, SeesOverlapsWhoseWallsLieOnTheGrid) {
    const Mesh doubled = joined(mesh::box({0, 0, 0}, {2, 2, 2}), mesh::box({1, 0, 0}, {3, 2, 2}));
    const Result<Built> refused = build(std::span(&doubled, 1), {.precision = 1});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::not_a_solid);
    EXPECT_FALSE(refused.error().place.faces.empty());
}

TEST(Build, SeesOverlapsThinnerThanACell) {
    const Mesh cube = mesh::box({0, 0, 0}, {4.6, 4.6, 4.6});
    const Mesh thin = joined(cube, mesh::box({4.55, 0.1, 0.1}, {9, 4.5, 4.5}));
    const Mesh crumb = joined(cube, mesh::box({1.2, 1.2, 1.2}, {1.3, 1.3, 1.3}));
    const Mesh crumb_inside_out = joined(cube, reversed(mesh::box({6.2, 1.2, 1.2}, {6.3, 1.3, 1.3})));
    for (const Mesh& mesh : {thin, crumb, crumb_inside_out})
        for (const bool conforming : {false, true}) {
            Options options{.precision = 1};
            const auto meshed = [&] {
                return conforming ? build_conforming(std::span(&mesh, 1), options)
                                  : build(std::span(&mesh, 1), options);
            };
            const Result<Built> refused = meshed();
            ASSERT_FALSE(refused);
            EXPECT_EQ(refused.error().code, ErrorCode::not_a_solid);
            EXPECT_FALSE(refused.error().place.faces.empty());
            options.overlaps = OverlapPolicy::winding;
            const Result<Built> accepted = meshed();
            ASSERT_TRUE(accepted) << accepted.error().describe();
            EXPECT_TRUE(accepted->report.overlaps);
        }
    const Mesh cavity = joined(cube, reversed(mesh::box({1.2, 1.2, 1.2}, {1.3, 1.3, 1.3})));
    const Mesh beside = joined(cube, mesh::box({4.6, 0.1, 0.1}, {9, 4.5, 4.5}));
    for (const Mesh& mesh : {cavity, beside}) {
        const Result<Built> built = build(std::span(&mesh, 1), {.precision = 1});
        ASSERT_TRUE(built) << built.error().describe();
        EXPECT_FALSE(built->report.overlaps);
        expect_exact_volumes(*built);
    }
}

TEST(Build, SaysWhereAHoleIsAndRefusesWhatEnclosesNothing) {
    Mesh open = mesh::box({0, 0, 0}, {1, 2, 3});
    open.triangles.pop_back();
    const Result<Built> leaking = build(std::span(&open, 1));
    ASSERT_FALSE(leaking);
    EXPECT_NE(leaking.error().sentence.find("3 edges"), std::string::npos) << leaking.error().sentence;
    EXPECT_NE(leaking.error().sentence.find("the first runs from (1, 0, "), std::string::npos)
        << leaking.error().sentence;
    const Mesh sheet = joined(mesh::box({0, 0, 0}, {1, 2, 3}), reversed(mesh::box({0, 0, 0}, {1, 2, 3})));
    const Result<Built> nothing = build(std::span(&sheet, 1));
    ASSERT_FALSE(nothing);
    EXPECT_EQ(nothing.error().code, ErrorCode::not_a_solid);
}

TEST(Build, SaysThatASurfaceIsInsideOut) {
    const Mesh inverted = reversed(mesh::icosphere(1, 4));
    for (const OverlapPolicy overlaps : {OverlapPolicy::reject, OverlapPolicy::winding})
        for (const bool conforming : {false, true}) {
            Options options{.level = 4, .keep = Keep::half};
            options.overlaps = overlaps;
            const Result<Built> refused = conforming ? build_conforming(std::span(&inverted, 1), options)
                                                     : build(std::span(&inverted, 1), options);
            ASSERT_FALSE(refused) << conforming;
            EXPECT_EQ(refused.error().code, ErrorCode::not_a_solid);
            EXPECT_EQ(refused.error().sentence.rfind("the surface is inside out", 0), 0u)
                << refused.error().sentence;
            EXPECT_FALSE(refused.error().place.faces.empty());
        }
    const Mesh solids[] = {mesh::cube(), inverted};
    const Result<Built> second = build(solids, {.level = 4});
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().place.operand, 1U);
    EXPECT_EQ(second.error().sentence.rfind("the surface is inside out", 0), 0u);
}

}  // namespace
}  // namespace octavo::hexmesh
