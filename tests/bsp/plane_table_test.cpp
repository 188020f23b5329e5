// SPDX-License-Identifier: Apache-2.0
#include <random>

#include <gtest/gtest.h>

#include <octavo/bsp/plane_table.hpp>
#include <octavo/exact/orient.hpp>
#include <octavo/exact/side.hpp>

namespace octavo::bsp {
namespace {

using exact::Point;

TEST(PlaneTable, GivesAPlaneOneNumberHoweverItIsSpanned) {
    std::mt19937 random(1);
    std::uniform_int_distribution<int> step(-9, 9), at(1 << 20, 1 << 24), scale(1, 50000);
    PlaneTable table;
    for (int run = 0; run < 2000; ++run) {
        // Points of one plane: p + i u + k v.
        const Point p{at(random), at(random), at(random)};
        const int u[3] = {step(random), step(random), step(random)},
                  v[3] = {step(random), step(random), step(random)};
        const auto point = [&](int i, int k) {
            return Point{p.x + i * u[0] + k * v[0], p.y + i * u[1] + k * v[1], p.z + i * u[2] + k * v[2]};
        };
        const int i = scale(random), k = scale(random);
        if (exact::collinear(p, point(i, 0), point(0, k))) continue;
        const Facing first = table.add(p, point(i, 0), point(0, k));
        EXPECT_EQ(table.add(point(1, 1), point(1 + k, 1), point(1, 1 + i)), first);
        EXPECT_EQ(table.add(point(0, k), point(i, 0), p), first.opposite());
        EXPECT_EQ(table.add(point(i, 0), point(0, k), p), first);
    }
}

TEST(PlaneTable, PlanesFaceAsTheirPointsRun) {
    PlaneTable table;
    for (const int sign : {1, -1}) {
        const Point p{100, 100, 100}, q{140, 90, 100}, r{100, 130, 100 + 7 * sign};
        const Facing facing = table.add(p, q, r);
        const exact::Plane plane = table[facing.plane()];
        const Point above{100, 100, 900};
        EXPECT_EQ(exact::side_of(plane, above) == exact::orient3d(p, q, r, above), !facing.reversed());
        const PlaneTable::Points& points = table.points(facing.plane());
        EXPECT_EQ(exact::side_of(plane, above), exact::orient3d(points[0], points[1], points[2], above));
    }
}

TEST(PlaneTable, KeepsDifferentPlanesApart) {
    PlaneTable table;
    for (int i = 0; i < 5000; ++i)
        table.add({1000, 1000, 1000 + i}, {2000, 1000, 1000 + i}, {1000, 3000, 1001 + i});
    EXPECT_EQ(table.size(), 5000U);
}

}  // namespace
}  // namespace octavo::bsp
