// SPDX-License-Identifier: Apache-2.0
#include <random>

#include <gtest/gtest.h>

#include <octavo/bp_octree/triangle_cell.hpp>

#include "bp_octree/rational.hpp"

namespace octavo::bp_octree {
namespace {

using exact::Point;

void expect_same_as_rational(Point p, Point q, Point r, const CellBox& box, int& met) {
    const bool truth = !tests::clipped(p, q, r, box).empty();
    met += truth;
    EXPECT_EQ(TriangleInCells(p, q, r).meets(box), truth)
        << p.x << ' ' << p.y << ' ' << p.z << ", " << q.x << ' ' << q.y << ' ' << q.z << ", " << r.x << ' '
        << r.y << ' ' << r.z << " and " << box.low[0] << ' ' << box.low[1] << ' ' << box.low[2] << " to "
        << box.high[0];
}

TEST(TriangleInCells, AgreesWithRationalClippingOnSmallNumbersFullOfContacts) {
    std::mt19937 random(1);
    int met = 0;
    for (int i = 0; i < 6000; ++i) {
        const auto point = [&] {
            return Point{static_cast<int>(random() % 8), static_cast<int>(random() % 8),
                         static_cast<int>(random() % 8)};
        };
        const Point p = point(), q = i % 7 == 0 ? p : point(), r = i % 11 == 0 ? q : point();
        CellBox box;
        for (int axis = 0; axis < 3; ++axis) {
            // Even box planes too: contacts at vertices, along edges and in faces.
            box.low[axis] = static_cast<int>(random() % 14);
            box.high[axis] = box.low[axis] + 1 + static_cast<int>(random() % 6);
        }
        expect_same_as_rational(p, q, r, box, met);
    }
    EXPECT_GT(met, 500);
    EXPECT_LT(met, 5500);
}

TEST(TriangleInCells, AgreesWithRationalClippingAcrossTheWholeUniverse) {
    std::mt19937 random(2);
    int met = 0;
    for (int i = 0; i < 2000; ++i) {
        const auto coordinate = [&] { return static_cast<int>(random() % exact::universe_side); };
        const Point p{coordinate(), coordinate(), coordinate()}, q{coordinate(), coordinate(), coordinate()};
        const Point r{coordinate(), coordinate(), coordinate()};
        // A tiny box beside a point of the triangle, so that the answer hangs on the last bits.
        const double s = static_cast<double>(random() % 1000) / 1000,
                     t = static_cast<double>(random() % 1000) / 1000;
        CellBox box;
        for (int axis = 0; axis < 3; ++axis) {
            const double x = p[axis] + s * ((q[axis] - p[axis]) + t * (r[axis] - q[axis]));
            box.low[axis] = static_cast<int>(2 * x) / 2 * 2 - 3 + 2 * static_cast<int>(random() % 3);
            box.high[axis] = box.low[axis] + 2;
        }
        expect_same_as_rational(p, q, r, box, met);
    }
    EXPECT_GT(met, 100);
    EXPECT_LT(met, 1900);
}

}  // namespace
}  // namespace octavo::bp_octree
