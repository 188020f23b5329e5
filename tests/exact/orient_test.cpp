// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <octavo/exact/orient.hpp>
#include <octavo/exact/orient_in_plane.hpp>

#include "effort.hpp"
#include "exact/generator.hpp"
#include "exact/oracle.hpp"

namespace octavo::exact {
namespace {

using oracle::Fraction;
using oracle::Integer;
using tests::Generator;
using tests::Spot;

/// The 4x4 determinant of the homogeneous points, expanded along the column of ones.
Sign oracle_orient3d(Point p, Point q, Point r, Point s) {
    const oracle::Vector a = oracle::vector(p), b = oracle::vector(q), c = oracle::vector(r),
                         d = oracle::vector(s);
    return oracle::sign(oracle::determinant(b, c, d) - oracle::determinant(a, c, d) +
                        oracle::determinant(a, b, d) - oracle::determinant(a, b, c));
}

TEST(Orient3d, RandomPointsAgreeWithTheOracle) {
    Generator random(71);
    for (int i = 0; i < 1'000'000 * tests::effort(); ++i) {
        const Point p = random.point(), q = random.point(), r = random.point(), s = random.point();
        ASSERT_EQ(orient3d(p, q, r, s), oracle_orient3d(p, q, r, s));
    }
}

TEST(Orient3d, CoplanarSliverAndCoincidentPointsAgreeWithTheOracle) {
    Generator random(72);
    std::array<int, 3> seen{};
    for (int i = 0; i < 300'000 * tests::effort(); ++i) {
        const Point p =
            random.near({universe_side / 2, universe_side / 2, universe_side / 2}, universe_side / 8);
        const Point q = random.near(p, random.coin() ? universe_side / 8 : 3);
        const Point r = random.coin() ? random.near(p, 5) : random.nearly_between(p, q);
        Point s{q.x + r.x - p.x, q.y + r.y - p.y, q.z + r.z - p.z};
        if (i % 3 == 0) s = random.near(s, 1);
        if (i % 5 == 0) s = random.coin() ? p : q;
        const Sign sign = orient3d(p, q, r, s);
        ASSERT_EQ(sign, oracle_orient3d(p, q, r, s));
        ASSERT_EQ(orient3d(q, p, r, s), -sign);
        ++seen[static_cast<std::size_t>(static_cast<int>(sign) + 1)];
    }
    for (const int count : seen) EXPECT_GT(count, 1'000);
    EXPECT_GT(seen[1], 100'000);
}

TEST(Orient3d, SaysOnWhichSideOfACounterClockwiseTriangleAPointLies) {
    EXPECT_EQ(orient3d({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}), Sign::positive);
}

TEST(Orient3d, CornersOfTheUniverseStayInTheBudget) {
    const auto corner = [](int bits) {
        const std::int32_t far = universe_side - 1;
        return Point{bits & 1 ? far : 0, bits & 2 ? far : 0, bits & 4 ? far : 0};
    };
    for (int i = 0; i < 8 * 8 * 8 * 8; ++i) {
        const Point p = corner(i), q = corner(i >> 3), r = corner(i >> 6), s = corner(i >> 9);
        ASSERT_EQ(orient3d(p, q, r, s), oracle_orient3d(p, q, r, s));
    }
}

TEST(Orient2d, LatticePointsAgreeWithTheOracle) {
    Generator random(73);
    int zeros = 0;
    for (int i = 0; i < 1'300'000 * tests::effort(); ++i) {
        const Point p = random.point(), q = random.point();
        Point r = random.point();
        if (i % 4 == 0) r = random.nearly_between(p, q);
        if (i % 4 == 1) {
            const Point step = random.near({3, 3, 3}, 3);
            r = {p.x / 2 + step.x, p.y / 2 + step.y, p.z / 2 + step.z};
            const Point middle{p.x / 4 + r.x / 2, p.y / 4 + r.y / 2, p.z / 4 + r.z / 2};
            const int axis = static_cast<int>(random.between(0, 2));
            ASSERT_EQ(
                orient2d(axis, middle, r, p),
                oracle::orient2d(axis, oracle::fraction(middle), oracle::fraction(r), oracle::fraction(p)));
        }
        const int axis = static_cast<int>(random.between(0, 2));
        const Sign sign = orient2d(axis, p, q, r);
        ASSERT_EQ(sign,
                  oracle::orient2d(axis, oracle::fraction(p), oracle::fraction(q), oracle::fraction(r)));
        zeros += sign == Sign::zero;
    }
    EXPECT_GT(zeros, 1'000);
}

TEST(Orient2d, PointsOfOneLineAreCollinearInEveryProjection) {
    Generator random(74);
    for (int i = 0; i < 100'000 * tests::effort(); ++i) {
        const Point step = random.near({50, 50, 50}, 50),
                    p = random.near({1 << 25, 1 << 25, 1 << 25}, 1 << 24);
        const auto at = [&](std::int32_t k) {
            return Point{p.x + k * step.x, p.y - k * step.y, p.z + k * step.z};
        };
        const Point q = at(static_cast<std::int32_t>(random.between(-10000, 10000)));
        const Point r = at(static_cast<std::int32_t>(random.between(-10000, 10000)));
        ASSERT_TRUE(collinear(p, q, r));
        const Point beside = random.near(r, 1);
        bool flat = true;
        for (int axis = 0; axis < 3; ++axis)
            flat = flat && oracle::orient2d(axis, oracle::fraction(p), oracle::fraction(q),
                                            oracle::fraction(beside)) == Sign::zero;
        ASSERT_EQ(collinear(p, q, beside), flat);
    }
}

/// Checks both paths of the predicate for three points of any kinds against the oracle.
template <class P, class Q, class R>
void expect_orientation(int axis, const P& p, const Q& q, const R& r, Sign expected) {
    ASSERT_EQ(orient2d(axis, p, q, r), expected);
    ASSERT_EQ(exact_orient2d(axis, homogeneous(p), homogeneous(q), homogeneous(r)), expected);
    ASSERT_EQ(orient2d(axis, r, q, p), -expected);
}

TEST(OrientInPlane, RandomPointsOfAllKindsAgreeWithTheOracle) {
    Generator random(75);
    for (int i = 0; i < 350'000 * tests::effort(); ++i) {
        const int axis = i % 3;
        const Plane first = random.plane(), second = random.plane(), third = random.plane(),
                    fourth = random.plane();
        const Point p = random.point(), q = random.point(), r = random.point();
        const auto edge1 = intersect(p, q, first), edge2 = intersect(q, r, second),
                   edge3 = intersect(r, p, third);
        const auto triple1 = intersect(first, second, third), triple2 = intersect(first, second, fourth),
                   triple3 = intersect(first, third, fourth);
        if (!edge1 || !edge2 || !edge3 || !triple1 || !triple2 || !triple3) continue;
        const Fraction e1 = oracle::meet(p, q, first), e2 = oracle::meet(q, r, second),
                       e3 = oracle::meet(r, p, third);
        const Fraction t1 = oracle::meet(first, second, third), t2 = oracle::meet(first, second, fourth),
                       t3 = oracle::meet(first, third, fourth);
        expect_orientation(axis, *edge1, *edge2, *edge3, oracle::orient2d(axis, e1, e2, e3));
        expect_orientation(axis, *triple1, *triple2, *triple3, oracle::orient2d(axis, t1, t2, t3));
        if (i % 2)
            expect_orientation(axis, p, *edge2, *triple3,
                               oracle::orient2d(axis, oracle::fraction(p), e2, t3));
        else
            expect_orientation(axis, *triple1, q, *edge3,
                               oracle::orient2d(axis, t1, oracle::fraction(q), e3));
    }
}

TEST(OrientInPlane, PointsOfOneLineAndTheirNeighboursAgreeWithTheOracle) {
    Generator random(76);
    int zeros = 0;
    for (int i = 0; i < 100'000 * tests::effort(); ++i) {
        const int axis = i % 3;
        const Spot spot = Spot::random(random);
        const Plane through = spot.plane(random), second = random.plane(), third = random.plane();
        const Plane shifted = spot.plane(random, 1);
        // Three points of the edge's line: a lattice point and two cuts; a shifted cut stays on the line too.
        const auto edge1 = intersect(spot.p, spot.q, through), edge2 = intersect(spot.p, spot.q, second),
                   edge3 = intersect(spot.p, spot.q, shifted);
        if (!edge1 || !edge2 || !edge3) continue;
        expect_orientation(axis, *edge1, *edge2, *edge3, Sign::zero);
        expect_orientation(axis, spot.p, *edge2, *edge1, Sign::zero);
        // Three points of a line of two planes.
        const Plane other = spot.plane(random);
        const Line line(through, other);
        const auto triple1 = intersect(line, second), triple2 = intersect(line, third),
                   triple3 = intersect(line, shifted);
        if (!triple1 || !triple2 || !triple3) continue;
        expect_orientation(axis, *triple1, *triple2, *triple3, Sign::zero);
        expect_orientation(axis, *triple1, *triple2, *edge1, Sign::zero);  // the spot is on the line as well
        ++zeros;
        // One unit beside: the edge leaves the line there.
        const Fraction t1 = oracle::meet(through, other, second), t2 = oracle::meet(through, other, third),
                       e3 = oracle::meet(spot.p, spot.q, shifted);
        expect_orientation(axis, *triple1, *triple2, *edge3, oracle::orient2d(axis, t1, t2, e3));
    }
    EXPECT_GT(zeros, 80'000);
}

TEST(OrientInPlane, IsSeenFromThePositiveSide) {
    Generator random(77);
    for (int i = 0; i < 100'000 * tests::effort(); ++i) {
        const Point p = random.point(), q = random.point(), r = random.point();
        const Plane plane = Plane::through(p, q, r);
        if (plane.degenerate()) continue;
        ASSERT_EQ(orient_in_plane(plane, p, q, r), Sign::positive);
        ASSERT_EQ(orient_in_plane(plane, q, p, r), Sign::negative);
        ASSERT_EQ(orient_in_plane(plane.reversed(), p, q, r), Sign::negative);
    }
}

}  // namespace
}  // namespace octavo::exact
