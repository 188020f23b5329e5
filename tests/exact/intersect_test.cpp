// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <octavo/exact/intersect.hpp>

#include "effort.hpp"
#include "exact/generator.hpp"
#include "exact/oracle.hpp"

namespace octavo::exact {
namespace {

using tests::Generator;
using tests::Spot;

TEST(Intersect, EdgeAndPlaneAgreeWithTheOracle) {
    Generator random(11);
    int parallel = 0;
    for (int i = 0; i < 1'000'000 * tests::effort(); ++i) {
        const Point p = random.point(), q = random.point();
        const Plane plane = random.plane();
        const auto point = intersect(p, q, plane);
        const oracle::Fraction expected = oracle::meet(p, q, plane);
        ASSERT_EQ(point.has_value(), expected.w != 0);
        if (point) {
            ASSERT_TRUE(oracle::same(*point, expected));
        }
        parallel += !point;
    }
    EXPECT_GT(parallel, 0);
}

TEST(Intersect, ThreePlanesAgreeWithTheOracle) {
    Generator random(12);
    int parallel = 0;
    for (int i = 0; i < 1'000'000 * tests::effort(); ++i) {
        const Plane first = random.plane(), second = random.plane(), third = random.plane();
        const auto point = intersect(first, second, third);
        const oracle::Fraction expected = oracle::meet(first, second, third);
        ASSERT_EQ(point.has_value(), expected.w != 0);
        if (point) {
            ASSERT_TRUE(oracle::same(*point, expected));
        }
        parallel += !point;
    }
    EXPECT_GT(parallel, 0);
}

TEST(Intersect, TwoPlanesAndOneAcrossAnAxisAgreeWithTheOracle) {
    Generator random(15);
    int parallel = 0;
    for (int i = 0; i < 300'000 * tests::effort(); ++i) {
        const Point p = random.point();
        AxisPlane across{i % 3, 2 * p[i % 3] - (random.coin() ? 1 : 0)};
        if (i % 100 == 0) across.twice = i % 200 == 0 ? 1 << 27 : -1;
        const Plane wall = Plane::from_coefficients(across.axis == 0 ? 2 : 0, across.axis == 1 ? 2 : 0,
                                                    across.axis == 2 ? 2 : 0, -int128{across.twice});
        const Plane first = random.plane(), second = random.plane();
        const auto point = intersect(first, second, across);
        const oracle::Fraction expected = oracle::meet(first, second, wall);
        ASSERT_EQ(point.has_value(), expected.w != 0);
        if (point) {
            ASSERT_TRUE(oracle::same(*point, expected));
        }
        parallel += !point;
    }
    EXPECT_GT(parallel, 0);
}

TEST(Intersect, PlanesThroughOneLineOrParallelHaveNoPoint) {
    Generator random(13);
    for (int i = 0; i < 100'000 * tests::effort(); ++i) {
        const Point p = random.point(), q = random.coin() ? random.point() : random.near(p, 2);
        const Plane first = Plane::through(p, q, random.point()),
                    second = Plane::through(p, q, random.point());
        const Plane third = Plane::through(q, p, random.near(p, 10));
        if (first.degenerate() || second.degenerate() || third.degenerate()) continue;
        ASSERT_FALSE(intersect(first, second, third));
        ASSERT_FALSE(intersect(p, q, first));
        const Plane shifted = Plane::from_coefficients(first.a(), first.b(), first.c(), first.d() - 1);
        ASSERT_FALSE(intersect(first, shifted, random.plane()));
        ASSERT_TRUE(Line(first, shifted).degenerate());
    }
}

TEST(Intersect, TheLinesDirectionIsTheCrossProductOfTheNormals) {
    const Line line(Plane::across_axis(2, 5), Plane::across_axis(0, 7));
    EXPECT_EQ(line.direction(0), 0);
    EXPECT_EQ(line.direction(1), 1);
    EXPECT_EQ(line.direction(2), 0);
}

TEST(Intersect, PlanesThroughASpotOfAnEdgeMeetThere) {
    Generator random(14);
    for (int i = 0; i < 100'000 * tests::effort(); ++i) {
        const Spot spot = Spot::random(random);
        const Plane first = spot.plane(random), second = spot.plane(random), third = spot.plane(random);
        const auto mix = [&](std::int32_t from, std::int32_t to) {
            return oracle::Integer(from) * (spot.m - spot.k) + oracle::Integer(to) * spot.k;
        };
        const oracle::Fraction expected{
            {mix(spot.p.x, spot.q.x), mix(spot.p.y, spot.q.y), mix(spot.p.z, spot.q.z)}, spot.m};
        ASSERT_TRUE(oracle::same(*intersect(spot.p, spot.q, first), expected));
        if (const auto point = intersect(first, second, third)) {
            ASSERT_TRUE(oracle::same(*point, expected));
        }
    }
}

TEST(Intersect, TheWidestPlanesStayInTheBudget) {
    // All combinations of the extreme coefficients: the bounds of bit_budget.hpp are attained within their
    // slack.
    const std::int64_t n = (std::int64_t{1} << budget::normal) - 1;
    const int128 d = (int128{1} << budget::offset) - 1;
    const auto plane = [&](int bits) {
        const auto pick = [&](int bit) { return bits >> bit & 1 ? n : -n; };
        return Plane::from_coefficients(pick(0), pick(1), pick(2), bits & 8 ? d : -d);
    };
    int points = 0;
    for (int i = 0; i < 16; ++i)
        for (int j = 0; j < 16; ++j)
            for (int k = 0; k < 16; ++k) {
                const auto point = intersect(plane(i), plane(j), plane(k));
                if (!point) continue;
                ++points;
                ASSERT_TRUE(oracle::same(*point, oracle::meet(plane(i), plane(j), plane(k))));
            }
    for (int i = 0; i < 16; ++i)
        for (int j = 0; j < 16; ++j)
            for (int axis = 0; axis < 3; ++axis) {
                const AxisPlane across{axis, 1 << 27};
                const auto point = intersect(plane(i), plane(j), across);
                if (!point) continue;
                ++points;
                ASSERT_TRUE(oracle::same(*point, oracle::meet(plane(i), plane(j), across.plane())));
            }
    EXPECT_GT(points, 0);
}

}  // namespace
}  // namespace octavo::exact
