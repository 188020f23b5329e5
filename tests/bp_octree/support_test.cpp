// SPDX-License-Identifier: Apache-2.0
#include <random>

#include <gtest/gtest.h>

#include <octavo/bp_octree/plane.hpp>
#include <octavo/bp_octree/support.hpp>

#include "bp_octree/rational.hpp"

namespace octavo::bp_octree {
namespace {

using exact::Point;
using tests::Rational;

TEST(Direction, CodesOfAllDirectionsComeBack) {
    int directions = 0;
    for (int code = 0; code < direction_codes; ++code) {
        const Direction d = direction_of(static_cast<DirectionCode>(code));
        ASSERT_EQ(magnitude(d.a) + magnitude(d.b) + magnitude(d.c), direction_length);
        // Codes on the outer border name the directions with c < 0 twice; decoding is what must agree.
        ASSERT_EQ(direction_of(code_of(d)), d);
        directions += code_of(d) == code;
    }
    EXPECT_EQ(directions, 4 * 127 * 127 + 2);
}

TEST(Direction, TheNearestDirectionIsWithinOneDegree) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    for (int i = 0; i < 20000; ++i) {
        const Vec3 v{normal(random), normal(random), i % 5 ? normal(random) : 0};
        const Direction d = nearest_direction(v.x, v.y, v.z);
        ASSERT_EQ(magnitude(d.a) + magnitude(d.b) + magnitude(d.c), direction_length);
        const Vec3 u{static_cast<double>(d.a), static_cast<double>(d.b), static_cast<double>(d.c)};
        EXPECT_GT(dot(u, v) / length(u) / length(v), std::cos(3.14159265 / 180));
    }
}

TEST(BoundingPlane, IsTheLeastThatReachesFarEnough) {
    std::mt19937 random(4);
    for (int i = 0; i < 20000; ++i) {
        const Direction u = direction_of(static_cast<DirectionCode>(random() % direction_codes));
        const int back = 65536 * (direction_length - positive_part(u));
        const int reach = static_cast<int>(random() % (127u * 65536u)) - back;
        const BoundingPlane plane = BoundingPlane::at(u, reach);
        EXPECT_GE(plane.reach(), reach);
        EXPECT_LT(plane.reach() - offset_step, reach);
    }
}

/// The largest u · x of the clipped triangle in the cell's coordinates, exactly.
Rational true_support(Point p, Point q, Point r, const CellBox& box, Direction u) {
    Rational most = -Rational(1 << 30);
    for (const tests::RationalPoint& x : tests::clipped(p, q, r, box)) {
        Rational value = 0;
        for (int axis = 0; axis < 3; ++axis)
            value += u[axis] * (x[static_cast<std::size_t>(axis)] - box.low[axis]) * 65536 / box.side(axis);
        most = std::max(most, value);
    }
    return most;
}

TEST(CellContent, SupportIsNeverLessThanTheTruthAndAtMostTwoUnitsAStepMore) {
    std::mt19937 random(5);
    int tested = 0;
    for (int i = 0; i < 3000; ++i) {
        // From cells as large as the universe to cells of 2^8 units with triangles 2^18 times as large.
        const int level = i % 19;
        const std::int32_t step = std::int32_t{2} << 18;
        CellBox root;
        for (int axis = 0; axis < 3; ++axis) {
            root.low[axis] = -1;
            root.high[axis] = -1 + step * (axis == i % 3 ? 256 : 1 + static_cast<int>(random() % 256));
        }
        CellBox box;
        std::array<int, 3> inside{};
        for (int axis = 0; axis < 3; ++axis) {
            const std::int32_t side = root.side(axis) >> level;
            box.low[axis] = root.low[axis] + side * static_cast<int>(random() % (1U << level));
            box.high[axis] = box.low[axis] + side;
            inside[static_cast<std::size_t>(axis)] =
                (box.low[axis] + 1) / 2 + static_cast<int>(random() % (side / 2));
        }
        const auto far = [&] {
            return Point{static_cast<int>(random() % (root.side(0) / 2)),
                         static_cast<int>(random() % (root.side(1) / 2)),
                         static_cast<int>(random() % (root.side(2) / 2))};
        };
        const Point p = i % 3 == 0 ? Point{inside[0], inside[1], inside[2]} : far();
        const Point q = far(), r = i % 5 == 0 ? q : far();
        PointSet points;
        CellContent content(box, points);
        bool all_within = true;
        for (const Point& corner : {p, q, r}) {
            if (content.contains(corner))
                content.add_vertex(corner);
            else
                all_within = false;
        }
        if (!all_within) content.add_cuts(p, q, r);
        if (tests::clipped(p, q, r, box).empty()) continue;
        ++tested;
        ASSERT_FALSE(points.empty());
        for (int k = 0; k < 10; ++k) {
            const Direction u = direction_of(static_cast<DirectionCode>(random() % direction_codes));
            const Rational truth = true_support(p, q, r, box, u);
            EXPECT_GE(Rational(points.support(u)), truth);
            EXPECT_LE(Rational(points.support(u)), truth + 2 * direction_length);
        }
    }
    EXPECT_GT(tested, 800);
}

}  // namespace
}  // namespace octavo::bp_octree
