// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <atomic>
#include <random>

#include <gtest/gtest.h>

#include <octavo/mesh/facet_pair.hpp>
#include <octavo/mesh/self_intersection.hpp>
#include <octavo/mesh/snap.hpp>
#include <octavo/mesh/transform.hpp>
#include <octavo/mesh/weld.hpp>

#include "surfaces.hpp"

namespace octavo::mesh {
namespace {

bool operator==(const SelfIntersections& a, const SelfIntersections& b) {
    return a.crossing == b.crossing && a.penetrating == b.penetrating && a.overlapping == b.overlapping &&
           a.touching == b.touching;
}

/// All pairs, without any search.
SelfIntersections by_all_pairs(const LatticeMesh& mesh) {
    SelfIntersections found;
    std::vector<Facet> facets;
    for (const Triangle& t : mesh.triangles) facets.emplace_back(t, mesh.points.data());
    const auto proper = [&](FaceIndex f) {
        const Triangle& t = mesh.triangles[f];
        return t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
    };
    for (FaceIndex i = 0; i < facets.size(); ++i)
        for (FaceIndex j = i + 1; j < facets.size(); ++j) {
            if (!proper(i) || !proper(j)) continue;
            switch (contact(facets[i], facets[j])) {
                case FacetContact::none:
                    break;
                case FacetContact::touching:
                    found.touching.push_back({i, j});
                    break;
                case FacetContact::penetrating:
                    found.penetrating.push_back({i, j});
                    break;
                case FacetContact::crossing:
                    found.crossing.push_back({i, j});
                    break;
                case FacetContact::overlapping:
                    found.overlapping.push_back({i, j});
                    break;
            }
        }
    return found;
}

SelfIntersections search(const LatticeMesh& mesh, int threads = 1) {
    Context context;
    context.threads = threads;
    auto found = find_self_intersections(mesh.points, mesh.triangles, context);
    EXPECT_TRUE(found.has_value());
    return *found;
}

LatticeMesh snapped(const Mesh& mesh) {
    auto result = snap(mesh);
    EXPECT_TRUE(result.has_value());
    return weld(result->mesh);
}

TEST(SelfIntersections, OfGeneratedSolidsAreNone) {
    for (const auto& [name, mesh, genus] : tests::generated_solids()) {
        const SelfIntersections found = search(snapped(mesh));
        EXPECT_TRUE(found == SelfIntersections{}) << name;
    }
}

TEST(SelfIntersections, AreThoseOfAllPairsInRandomSoups) {
    std::mt19937 random(31);
    for (int round = 0; round < 60; ++round) {
        // Few large facets, many small ones, slivers, shared vertices, on coarse grids and fine ones.
        std::uniform_int_distribution<int> shape(0, 3), step(-40, 40);
        const int span = std::array{6, 60, 5000, 60000000}[static_cast<std::size_t>(round) % 4];
        std::uniform_int_distribution<std::int32_t> coordinate(0, span);
        LatticeMesh mesh;
        for (int i = 0; i < 150; ++i) {
            const exact::Point p{coordinate(random), coordinate(random), coordinate(random)};
            mesh.points.push_back(p);
            mesh.points.push_back({coordinate(random), coordinate(random), coordinate(random)});
            const auto near = [&](std::int32_t c) { return std::clamp(c + step(random), 0, span); };
            mesh.points.push_back({near(p.x), near(p.y), near(p.z)});
            mesh.points.push_back({near(p.x), near(p.y), near(p.z)});
        }
        std::uniform_int_distribution<VertexIndex> any(0, 599);
        for (VertexIndex i = 0; i < 150; ++i) switch (shape(random)) {
                case 0:
                    mesh.triangles.push_back({4 * i, 4 * i + 1, any(random)});
                    break;
                case 1:
                    mesh.triangles.push_back({4 * i, 4 * i + 1, 4 * i + 2});
                    break;
                case 2:
                    mesh.triangles.push_back({4 * i, 4 * i + 2, 4 * i + 3});
                    break;
                default:
                    mesh.triangles.push_back({any(random), any(random), any(random)});
            }
        mesh = weld(mesh);
        const SelfIntersections expected = by_all_pairs(mesh), found = search(mesh);
        EXPECT_EQ(found.crossing, expected.crossing);
        EXPECT_EQ(found.penetrating, expected.penetrating);
        EXPECT_EQ(found.overlapping, expected.overlapping);
        EXPECT_EQ(found.touching, expected.touching);
        EXPECT_TRUE(search(mesh, 2) == expected);
    }
}

/// Large stars that meet themselves and each other: a crown of slivers round one vertex, some of them folded over.
TEST(SelfIntersections, InFansOfSliversAreThoseOfAllPairs) {
    std::mt19937 random(32);
    for (const int slivers : {30, 100, 400}) {
        for (const std::int32_t radius : {3000, 30000000}) {
            LatticeMesh mesh;
            mesh.points.push_back({radius, radius, 50});
            std::uniform_real_distribution<double> jitter(0, 3);
            std::uniform_int_distribution<std::int32_t> height(0, 100);
            for (int i = 0; i < slivers; ++i) {
                const double angle = (i + jitter(random)) * 6.283 / slivers;
                const double r = radius * (i % 3 ? 0.9 : 0.5);
                mesh.points.push_back({static_cast<std::int32_t>(radius + r * std::cos(angle)),
                                       static_cast<std::int32_t>(radius + r * std::sin(angle)),
                                       i % 5 ? 50 : height(random)});
            }
            for (int i = 1; i + 1 < slivers; ++i)
                mesh.triangles.push_back({0, static_cast<VertexIndex>(i), static_cast<VertexIndex>(i + 1)});
            mesh.triangles.push_back({1, 5, 9});
            mesh = weld(mesh);
            const SelfIntersections expected = by_all_pairs(mesh);
            EXPECT_FALSE(expected == SelfIntersections{});
            EXPECT_TRUE(search(mesh) == expected) << slivers << " " << radius;
        }
    }
}

/// Fans whose centres lie close together and whose slivers run through each other, with loose facets among them: no
/// cell round a centre holds one fan alone.
TEST(SelfIntersections, InFansThatShareTheirCellsAreThoseOfAllPairs) {
    std::mt19937 random(33);
    for (const std::int32_t radius : {2000, 20000000}) {
        for (int round = 0; round < 6; ++round) {
            const int fans = 2 + round % 3, slivers = 60;
            std::uniform_int_distribution<std::int32_t> offset(-radius / 200, radius / 200),
                height(-radius / 4, radius / 4);
            const auto near_centre = [&] {
                return exact::Point{radius + offset(random), radius + offset(random),
                                    radius + offset(random)};
            };
            LatticeMesh mesh;
            for (int fan = 0; fan < fans; ++fan) {
                const auto centre = static_cast<VertexIndex>(mesh.points.size());
                mesh.points.push_back(near_centre());
                const std::int32_t rim = height(random);
                for (int i = 0; i < slivers; ++i) {
                    const double angle = i * 6.283185 / slivers;
                    mesh.points.push_back({static_cast<std::int32_t>(radius + 0.9 * radius * std::cos(angle)),
                                           static_cast<std::int32_t>(radius + 0.9 * radius * std::sin(angle)),
                                           radius + (i % 7 ? rim : height(random))});
                }
                for (VertexIndex i = 1; i <= slivers; ++i)
                    mesh.triangles.push_back({centre, centre + i, centre + i % slivers + 1});
            }
            for (VertexIndex i = 0; i < 4; ++i) {  // small facets at the centres
                const auto first = static_cast<VertexIndex>(mesh.points.size());
                for (int k = 0; k < 3; ++k) mesh.points.push_back(near_centre());
                mesh.triangles.push_back({first, first + 1, i % 2 ? first + 2 : 0});
            }
            mesh = weld(mesh);
            const SelfIntersections expected = by_all_pairs(mesh);
            EXPECT_GT(expected.crossing.size(), 10u);
            EXPECT_TRUE(search(mesh) == expected) << radius << " " << round;
        }
    }
}

TEST(SelfIntersections, OfTwoSpheresAreThoseOfAllPairs) {
    const Mesh both =
        join(std::array{icosphere(1, 8), transform(icosphere(1, 7), translation({0.7, 0.1, 0.2}))});
    const LatticeMesh mesh = snapped(both);
    const SelfIntersections expected = by_all_pairs(mesh);
    EXPECT_GT(expected.crossing.size(), 50u);
    EXPECT_TRUE(search(mesh) == expected);
}

TEST(SelfIntersections, OfAlignedCubesAreOverlapsAndTouches) {
    const auto pairs_of = [](const Mesh& a, const Mesh& b) {
        return search(snapped(join(std::array{a, b})));
    };
    const Mesh unit = box({0, 0, 0}, {2, 2, 2});
    const SelfIntersections shifted = pairs_of(unit, box({1, 0, 0}, {3, 2, 2}));
    EXPECT_FALSE(shifted.overlapping.empty());
    const SelfIntersections stacked = pairs_of(unit, box({0.5, 0.5, 2}, {1.5, 1.5, 3}));
    EXPECT_FALSE(stacked.overlapping.empty());
    EXPECT_TRUE(stacked.crossing.empty());
    // A vertex of one on the inside of a facet of the other.
    const Mesh tip{{{1, 1, 3}, {1.5, 1, 3}, {1, 1.5, 3}, {0.75, 0.5, 2}},
                   {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}},
                   {}};
    const SelfIntersections touching = pairs_of(unit, tip);
    EXPECT_TRUE(touching.crossing.empty());
    EXPECT_FALSE(touching.touching.empty());
    EXPECT_TRUE(pairs_of(unit, box({3, 3, 3}, {4, 4, 4})) == SelfIntersections{});
}

TEST(SelfIntersections, DoNotDependOnThreads) {
    const Mesh both =
        join(std::array{displaced_sphere(40), transform(displaced_sphere(37), translation({0.3, 0.1, 0}))});
    const LatticeMesh mesh = snapped(both);
    const SelfIntersections one = search(mesh, 1);
    EXPECT_GT(one.crossing.size(), 300u);
    for (const int threads : {2, 5}) EXPECT_TRUE(search(mesh, threads) == one);
}

TEST(SelfIntersections, StopWhenCancelled) {
    const LatticeMesh mesh = snapped(displaced_sphere(20));
    const std::atomic<bool> cancel{true};
    Context context;
    context.cancel = &cancel;
    const auto found = find_self_intersections(mesh.points, mesh.triangles, context);
    ASSERT_FALSE(found.has_value());
    EXPECT_EQ(found.error().code, ErrorCode::cancelled);
}

}  // namespace
}  // namespace octavo::mesh
