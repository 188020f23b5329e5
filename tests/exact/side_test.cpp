// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <octavo/exact/side.hpp>

#include "effort.hpp"
#include "exact/generator.hpp"
#include "exact/oracle.hpp"

namespace octavo::exact {
namespace {

using tests::Generator;
using tests::Spot;

TEST(SideOfPlane, LatticePointsAgreeWithTheOracle) {
    Generator random(1);
    int zeros = 0;
    for (int i = 0; i < 1'000'000 * tests::effort(); ++i) {
        const Plane plane = random.plane();
        const Point p = random.point();
        const Sign side = side_of(plane, p);
        ASSERT_EQ(side, oracle::side_of(plane, oracle::fraction(p)));
        zeros += side == Sign::zero;
    }
    EXPECT_GT(zeros, 0);
}

TEST(SideOfPlane, LatticePointsOfThePlaneAndTheirNeighboursAgreeWithTheOracle) {
    Generator random(2);
    int zeros = 0;
    for (int i = 0; i < 100'000 * tests::effort(); ++i) {
        // q + r - p completes the parallelogram, in the plane though not always in the universe.
        const Point p =
            random.near({universe_side / 2, universe_side / 2, universe_side / 2}, universe_side / 8);
        const Point q = random.coin() ? random.near(p, universe_side / 8) : random.near(p, 4);
        const Point r = random.coin() ? random.near(p, universe_side / 8) : random.nearly_between(p, q);
        const Plane plane = Plane::through(p, q, r);
        const Point on{q.x + r.x - p.x, q.y + r.y - p.y, q.z + r.z - p.z};
        ASSERT_EQ(side_of(plane, on), Sign::zero);
        const Point beside = random.near(on, 1);
        const Sign side = side_of(plane, beside);
        ASSERT_EQ(side, oracle::side_of(plane, oracle::fraction(beside)));
        ASSERT_EQ(side_of(plane.reversed(), beside), -side);
        zeros += side == Sign::zero;
    }
    EXPECT_GT(zeros, 0);
}

TEST(SideOfPlane, EdgePointsAgreeWithTheOracle) {
    Generator random(3);
    for (int i = 0; i < 1'000'000 * tests::effort(); ++i) {
        const Point p = random.point(), q = random.point();
        const Plane cut = random.plane(), plane = random.plane();
        const auto point = intersect(p, q, cut);
        if (!point) continue;
        const Sign side = oracle::side_of(plane, oracle::meet(p, q, cut));
        ASSERT_EQ(side_of(plane, *point), side);
        ASSERT_EQ(exact_side_of(plane, *point), side);
    }
}

TEST(SideOfPlane, TriplePointsAgreeWithTheOracle) {
    Generator random(4);
    for (int i = 0; i < 1'000'000 * tests::effort(); ++i) {
        const Plane first = random.plane(), second = random.plane(), third = random.plane();
        const Plane plane = random.plane();
        const auto point = intersect(first, second, third);
        if (!point) continue;
        const Sign side = oracle::side_of(plane, oracle::meet(first, second, third));
        ASSERT_EQ(side_of(plane, *point), side);
        ASSERT_EQ(exact_side_of(plane, *point), side);
    }
}

TEST(SideOfPlane, ConstructedPointsOnOrNextToThePlaneAgreeWithTheOracle) {
    Generator random(5);
    std::array<int, 3> sides{};
    for (int i = 0; i < 100'000 * tests::effort(); ++i) {
        const Spot spot = Spot::random(random);
        const Plane first = spot.plane(random), second = spot.plane(random), third = spot.plane(random);
        const int shift = static_cast<int>(random.between(-1, 1));
        const Plane plane = spot.plane(random, shift);
        const auto edge_point = intersect(spot.p, spot.q, first);
        ASSERT_TRUE(edge_point);
        // The planes pass through the spot and the last one by `shift` beside it.
        ASSERT_EQ(side_of(plane, *edge_point), static_cast<Sign>(shift));
        ASSERT_EQ(exact_side_of(plane, *edge_point), static_cast<Sign>(shift));
        const auto triple_point = intersect(first, second, third);
        if (!triple_point) continue;
        ASSERT_EQ(side_of(plane, *triple_point), static_cast<Sign>(shift));
        ASSERT_EQ(exact_side_of(plane, *triple_point), static_cast<Sign>(shift));
        ++sides[static_cast<std::size_t>(shift + 1)];
    }
    for (const int count : sides) EXPECT_GT(count, 30'000);
}

TEST(SideOfAxisPlane, AllKindsOfPointsAgreeWithTheOracle) {
    Generator random(6);
    int zeros = 0;
    for (int i = 0; i < 1'000'000 * tests::effort(); ++i) {
        const Point p = random.point(), q = random.point();
        const bool degenerate = i % 4 == 0;
        const AxisPlane cut{static_cast<int>(random.between(0, 2)),
                            static_cast<std::int32_t>(random.between(0, 1 << 27))};
        const Plane first = degenerate ? cut.plane() : random.plane();
        AxisPlane plane{static_cast<int>(random.between(0, 2)), 2 * random.coordinate()};
        if (degenerate)
            plane = {cut.axis, cut.twice + static_cast<int>(random.between(-1, 1))};
        else if (random.coin())
            plane.twice = 2 * p[plane.axis];
        ASSERT_EQ(side_of(plane, p), oracle::side_of(plane, oracle::fraction(p)));
        ASSERT_EQ(side_of(plane, p), side_of(plane.plane(), p));
        if (const auto point = intersect(p, q, first)) {
            const Sign side = side_of(plane, *point);
            ASSERT_EQ(side, oracle::side_of(plane, oracle::meet(p, q, first)));
            zeros += side == Sign::zero;
        }
        const Plane second = random.plane(), third = random.plane();
        if (const auto point = intersect(first, second, third)) {
            const Sign side = side_of(plane, *point);
            ASSERT_EQ(side, oracle::side_of(plane, oracle::meet(first, second, third)));
            zeros += side == Sign::zero;
        }
    }
    EXPECT_GT(zeros, 100'000);
}

}  // namespace
}  // namespace octavo::exact
