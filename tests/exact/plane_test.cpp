// SPDX-License-Identifier: Apache-2.0
#include <numeric>

#include <gtest/gtest.h>

#include <octavo/exact/orient.hpp>
#include <octavo/exact/plane.hpp>
#include <octavo/exact/side.hpp>

#include "effort.hpp"
#include "exact/generator.hpp"
#include "exact/oracle.hpp"

namespace octavo::exact {
namespace {

using oracle::Integer;
using tests::Generator;

TEST(Plane, ThroughThreePointsAgreesWithTheOracle) {
    Generator random(61);
    for (int i = 0; i < 1'000'000 * tests::effort(); ++i) {
        const Point p = random.point(), q = random.point();
        const Point r = i % 8 ? random.point() : random.nearly_between(p, q);
        const Plane plane = Plane::through(p, q, r);
        // Minors of the matrix of the three homogeneous points, a formula without differences.
        const oracle::Vector x{p.x, q.x, r.x}, y{p.y, q.y, r.y}, z{p.z, q.z, r.z}, one{1, 1, 1};
        ASSERT_EQ(oracle::integer(plane.a()), oracle::determinant(y, z, one));
        ASSERT_EQ(oracle::integer(plane.b()), oracle::determinant(z, x, one));
        ASSERT_EQ(oracle::integer(plane.c()), oracle::determinant(x, y, one));
        ASSERT_EQ(oracle::integer(plane.d()), -oracle::determinant(x, y, z));
        ASSERT_EQ(plane.d_approximation(), static_cast<double>(plane.d()));
    }
}

TEST(Plane, ANormalPointsWhereThePointsRunCounterClockwise) {
    const Plane plane = Plane::through({0, 0, 5}, {1, 0, 5}, {0, 1, 5});
    EXPECT_EQ(plane.c(), 1);
    EXPECT_EQ(side_of(plane, Point{9, 9, 6}), Sign::positive);
    EXPECT_EQ(side_of(plane.reversed(), Point{9, 9, 6}), Sign::negative);
}

TEST(Plane, IsDegenerateExactlyWhenThePointsAreCollinear) {
    Generator random(62);
    int degenerate = 0;
    for (int i = 0; i < 1'000'000 * tests::effort(); ++i) {
        const Point p = random.near({1000, 1000, 1000}, 3), q = random.near(p, 3);
        const Point r =
            random.coin() ? random.near(p, 4) : Point{2 * q.x - p.x, 2 * q.y - p.y, 2 * q.z - p.z};
        ASSERT_EQ(Plane::through(p, q, r).degenerate(), collinear(p, q, r));
        degenerate += collinear(p, q, r);
    }
    EXPECT_GT(degenerate, 100'000);
}

TEST(Plane, AlongAnAxisSeesWhatOrient2dSees) {
    Generator random(63);
    for (int i = 0; i < 100'000 * tests::effort(); ++i) {
        const Point p = random.point(), q = random.point(),
                    r = random.coin() ? random.point() : random.near(q, 1);
        for (int axis = 0; axis < 3; ++axis) {
            const Plane plane = Plane::along_axis(axis, p, q);
            ASSERT_EQ(side_of(plane, r), orient2d(axis, p, q, r));
            ASSERT_EQ(plane.normal(axis), 0);
        }
    }
}

TEST(Plane, AcrossAnAxisIsPositiveBeyondIt) {
    for (int axis = 0; axis < 3; ++axis) {
        Point p{7, 7, 7};
        EXPECT_EQ(side_of(Plane::across_axis(axis, 7), p), Sign::zero);
        EXPECT_EQ(side_of(Plane::across_axis(axis, 6), p), Sign::positive);
        EXPECT_EQ(side_of(Plane::across_axis(axis, 8), p), Sign::negative);
        EXPECT_EQ(side_of(AxisPlane{axis, 15}.plane(), p), Sign::negative);
    }
}

TEST(Plane, DominantAxisHasTheGreatestComponentAndTheFirstOfEquals) {
    EXPECT_EQ(Plane::from_coefficients(-5, 4, 3, 0).dominant_axis(), 0);
    EXPECT_EQ(Plane::from_coefficients(-5, 5, 3, 0).dominant_axis(), 0);
    EXPECT_EQ(Plane::from_coefficients(1, -5, 5, 0).dominant_axis(), 1);
    EXPECT_EQ(Plane::from_coefficients(0, 0, -1, 0).dominant_axis(), 2);
}

/// By the rank of the coefficients' matrix and the sign of a dot product.
PlaneRelation oracle_relation(const Plane& first, const Plane& second) {
    const oracle::Vector m = oracle::normal(first), n = oracle::normal(second);
    const auto minor = [](const Integer& a, const Integer& b, const Integer& c, const Integer& d) {
        return Integer(a * d - b * c);
    };
    if (minor(m.x, m.y, n.x, n.y) != 0 || minor(m.x, m.z, n.x, n.z) != 0 || minor(m.y, m.z, n.y, n.z) != 0)
        return PlaneRelation::crossing;
    const bool same_way = oracle::dot(m, n) > 0;
    const Integer d = oracle::integer(first.d()), e = oracle::integer(second.d());
    const bool coincide =
        minor(m.x, d, n.x, e) == 0 && minor(m.y, d, n.y, e) == 0 && minor(m.z, d, n.z, e) == 0;
    return coincide ? (same_way ? PlaneRelation::same : PlaneRelation::opposite)
                    : (same_way ? PlaneRelation::parallel : PlaneRelation::antiparallel);
}

TEST(PlaneRelationTest, RandomPlanesAgreeWithTheOracle) {
    Generator random(64);
    for (int i = 0; i < 1'000'000 * tests::effort(); ++i) {
        const Plane first = random.plane(), second = random.plane();
        ASSERT_EQ(relation(first, second), oracle_relation(first, second));
    }
}

TEST(PlaneRelationTest, MultiplesAndNearMultiplesAgreeWithTheOracle) {
    Generator random(65);
    std::array<int, 5> seen{};
    for (int i = 0; i < 200'000 * tests::effort(); ++i) {
        std::int64_t a = random.signed_bits(40), b = random.signed_bits(40),
                     c = random.coin() ? 0 : random.signed_bits(40);
        const int128 d = random.offset() >> 13;
        const std::int64_t k = random.between(1, 4000),
                           l = random.coin() ? random.between(1, 4000) : -random.between(1, 4000);
        const Plane first = Plane::from_coefficients(a * k, b * k, c * k, d * k);
        const std::int64_t tilt = random.word() % 4 == 0, shift = random.coin();
        const Plane second = Plane::from_coefficients(a * l + tilt, b * l, c * l, d * l + shift);
        if (first.degenerate() || second.degenerate()) continue;
        const PlaneRelation found = relation(first, second);
        ASSERT_EQ(found, oracle_relation(first, second));
        ++seen[static_cast<std::size_t>(found)];
        const bool same = found == PlaneRelation::same;
        ASSERT_EQ(primitive(first) == primitive(second), same);
        ASSERT_EQ(primitive(first) == primitive(second.reversed()), found == PlaneRelation::opposite);
    }
    for (const int count : seen) EXPECT_GT(count, 10'000);
}

TEST(PlaneRelationTest, ThePrimitiveFormIsTheSamePlaneWithCoprimeCoefficients) {
    Generator random(66);
    for (int i = 0; i < 100'000 * tests::effort(); ++i) {
        const Plane plane = random.plane(), reduced = primitive(plane);
        ASSERT_EQ(relation(plane, reduced), PlaneRelation::same);
        const std::int64_t normals = std::gcd(std::gcd(reduced.a(), reduced.b()), reduced.c());
        ASSERT_EQ(gcd(Integer(normals), oracle::integer(reduced.d())), 1);
        ASSERT_EQ(primitive(reduced), reduced);
    }
}

TEST(PlaneDeathTest, CoefficientsOutOfTheBudgetAreRefused) {
    const std::int64_t n = std::int64_t{1} << budget::normal;
    EXPECT_DEATH(Plane::from_coefficients(n, 0, 0, 0), "bit budget");
    EXPECT_DEATH(Plane::from_coefficients(0, -n, 0, 0), "bit budget");
    EXPECT_DEATH(Plane::from_coefficients(1, 0, 0, int128{1} << budget::offset), "bit budget");
    EXPECT_DEATH(relation(Plane(), Plane::across_axis(0, 1)), "degenerate");
}

}  // namespace
}  // namespace octavo::exact
