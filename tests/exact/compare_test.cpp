// SPDX-License-Identifier: Apache-2.0
#include <optional>

#include <gtest/gtest.h>

#include <octavo/exact/compare.hpp>

#include "effort.hpp"
#include "exact/generator.hpp"
#include "exact/oracle.hpp"

namespace octavo::exact {
namespace {

using oracle::Fraction;
using oracle::Integer;
using tests::Generator;
using tests::Spot;

/// Checks order, equality and both paths of the coordinate comparison.
template <class P, class Q>
void expect_order(const P& p, const Q& q, const Fraction& p_expected, const Fraction& q_expected) {
    const Sign expected = oracle::compare(p_expected, q_expected);
    ASSERT_EQ(compare(p, q), expected);
    ASSERT_EQ(compare(q, p), -expected);
    ASSERT_EQ(same_point(p, q), expected == Sign::zero);
    for (int axis = 0; axis < 3; ++axis) {
        const Sign coordinate = oracle::compare_coordinate(axis, p_expected, q_expected);
        ASSERT_EQ(compare_coordinate(axis, p, q), coordinate);
        ASSERT_EQ(exact_compare_coordinate(axis, homogeneous(p), homogeneous(q)), coordinate);
    }
}

TEST(Compare, RandomPointsOfAllKindsAgreeWithTheOracle) {
    Generator random(81);
    for (int i = 0; i < 350'000 * tests::effort(); ++i) {  // three pairs each
        const Plane first = random.plane(), second = random.plane(), third = random.plane();
        const Point p = random.point(), q = random.point(), r = random.point();
        const auto edge1 = intersect(p, q, first), edge2 = intersect(q, r, second);
        const auto triple1 = intersect(first, second, third),
                   triple2 = intersect(second, third, random.plane());
        if (!edge1 || !edge2 || !triple1 || !triple2) continue;
        const Fraction e1 = oracle::meet(p, q, first), e2 = oracle::meet(q, r, second);
        const Fraction t1 = oracle::meet(first, second, third);
        expect_order(*edge1, *edge2, e1, e2);
        expect_order(*edge1, *triple1, e1, t1);
        switch (i % 3) {
            case 0:
                expect_order(p, q, oracle::fraction(p), oracle::fraction(q));
                break;
            case 1:
                expect_order(r, *edge1, oracle::fraction(r), e1);
                break;
            default:
                expect_order(r, *triple1, oracle::fraction(r), t1);
        }
    }
}

TEST(Compare, TriplePointsAgreeWithTheOracle) {
    Generator random(82);
    for (int i = 0; i < 200'000 * tests::effort(); ++i) {
        const Plane first = random.plane(), second = random.plane(), third = random.plane(),
                    fourth = random.plane();
        const auto p = intersect(first, second, third), q = intersect(second, third, fourth);
        if (!p || !q) continue;
        expect_order(*p, *q, oracle::meet(first, second, third), oracle::meet(second, third, fourth));
    }
}

TEST(Compare, CoincidentAndNearlyCoincidentPointsOfDifferentKindsAgreeWithTheOracle) {
    Generator random(83);
    int coincident = 0, lattice = 0;
    for (int i = 0; i < 100'000 * tests::effort(); ++i) {
        const Spot spot = Spot::random(random);
        const Plane first = spot.plane(random), second = spot.plane(random), third = spot.plane(random);
        const Plane beside = spot.plane(random, random.coin() ? 1 : -1);
        const auto edge1 = intersect(spot.p, spot.q, first), edge2 = intersect(spot.q, spot.p, second);
        const auto edge3 = intersect(spot.p, spot.q, beside);
        const auto triple1 = intersect(first, second, third), triple2 = intersect(first, second, beside);
        if (!triple1 || !triple2 || !edge3) continue;
        ASSERT_TRUE(same_point(*edge1, *edge2));
        ASSERT_TRUE(same_point(*edge1, *triple1));
        ++coincident;
        const Fraction e1 = oracle::meet(spot.p, spot.q, first), e3 = oracle::meet(spot.p, spot.q, beside);
        const Fraction t1 = oracle::meet(first, second, third), t2 = oracle::meet(first, second, beside);
        ASSERT_FALSE(same_point(*edge1, *edge3));
        expect_order(*edge1, *edge3, e1, e3);
        expect_order(*edge1, *triple2, e1, t2);
        expect_order(*triple1, *edge3, t1, e3);
        expect_order(*triple1, *triple2, t1, t2);
        for (const Point p : {spot.p, spot.q}) {
            expect_order(p, *edge1, oracle::fraction(p), e1);
            expect_order(p, *triple1, oracle::fraction(p), t1);
            lattice += same_point(p, *triple1);
        }
    }
    EXPECT_GT(coincident, 90'000);
    EXPECT_GT(lattice, 1'000);
}

/// The sign of direction . (p - q).
Sign oracle_along(const oracle::Vector& direction, const Fraction& p, const Fraction& q) {
    return oracle::sign(oracle::dot(direction, p.v) * q.w - oracle::dot(direction, q.v) * p.w) *
           oracle::sign(p.w) * oracle::sign(q.w);
}

TEST(CompareAlong, PointsOfALatticeEdgeAgreeWithTheOracle) {
    Generator random(84);
    std::array<int, 3> seen{};
    for (int i = 0; i < 1'000'000 * tests::effort(); ++i) {
        const Spot spot = Spot::random(random);
        const Plane first = i % 8 ? random.plane() : spot.plane(random);
        const Plane second =
            i % 8 ? random.plane() : spot.plane(random, static_cast<int>(random.between(-1, 1)));
        const auto p = intersect(spot.p, spot.q, first), q = intersect(spot.q, spot.p, second);
        if (!p || !q) continue;
        const oracle::Vector direction = oracle::vector(spot.q) - oracle::vector(spot.p);
        const Fraction p_expected = oracle::meet(spot.p, spot.q, first),
                       q_expected = oracle::meet(spot.p, spot.q, second);
        const LineOrder order = LineOrder::along(spot.p, spot.q);
        const Sign sign = compare_along(order, *p, *q);
        ASSERT_EQ(sign, oracle_along(direction, p_expected, q_expected));
        ASSERT_EQ(compare_along(order.reversed(), *p, *q), -sign);
        ASSERT_EQ(compare_along(order, spot.p, *q),
                  oracle_along(direction, oracle::fraction(spot.p), q_expected));
        ASSERT_EQ(compare_along(order, spot.q, spot.p), Sign::positive);
        ++seen[static_cast<std::size_t>(static_cast<int>(sign) + 1)];
    }
    for (const int count : seen) EXPECT_GT(count, 30'000);
}

TEST(CompareAlong, PointsOfTheLineOfTwoPlanesAgreeWithTheOracle) {
    Generator random(85);
    std::array<int, 3> seen{};
    for (int i = 0; i < 350'000 * tests::effort(); ++i) {  // three pairs each
        const bool degenerate = i % 7 == 0;
        const Spot spot = Spot::random(random);
        const auto plane = [&](int shift) { return degenerate ? spot.plane(random, shift) : random.plane(); };
        const Plane first = plane(0), second = plane(0);
        const std::array<Plane, 3> cuts{plane(0), plane(0), plane(random.coin() ? 1 : -1)};
        const Line line(first, second);
        const std::array<std::optional<TriplePoint>, 3> points{
            intersect(line, cuts[0]), intersect(line, cuts[1]), intersect(line, cuts[2])};
        if (!points[0] || !points[1] || !points[2]) continue;
        const std::array<Fraction, 3> expected{oracle::meet(first, second, cuts[0]),
                                               oracle::meet(first, second, cuts[1]),
                                               oracle::meet(first, second, cuts[2])};
        const oracle::Vector m = oracle::normal(first), n = oracle::normal(second);
        const oracle::Vector direction{m.y * n.z - m.z * n.y, m.z * n.x - m.x * n.z, m.x * n.y - m.y * n.x};
        for (std::size_t p = 0; p < 3; ++p) {
            const std::size_t q = (p + 1) % 3;
            const Sign sign = compare_along(LineOrder::along(line), *points[p], *points[q]);
            ASSERT_EQ(sign, oracle_along(direction, expected[p], expected[q]));
            ++seen[static_cast<std::size_t>(static_cast<int>(sign) + 1)];
        }
    }
    EXPECT_GT(seen[0], 400'000);
    EXPECT_GT(seen[1], 40'000);
    EXPECT_GT(seen[2], 400'000);
}

TEST(CompareAlong, CoincidentEndsHaveNoDirection) {
    EXPECT_EQ(LineOrder::along(Point{1, 2, 3}, Point{1, 2, 3}).direction, Sign::zero);
    EXPECT_EQ(LineOrder::along(Line(Plane::across_axis(0, 1), Plane::across_axis(0, 2))).direction,
              Sign::zero);
}

}  // namespace
}  // namespace octavo::exact
