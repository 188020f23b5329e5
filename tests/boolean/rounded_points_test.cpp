// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <octavo/boolean/rounded_points.hpp>
#include <octavo/exact/intersect.hpp>

#include "unlimited.hpp"

namespace octavo::boolean {
namespace {

using exact::Point;
using octavo::tests::Integer;
using octavo::tests::Rational;

template <int Limbs>
Integer number(const exact::WideInt<Limbs>& wide) {
    const bool negative = wide.negative();
    const exact::WideInt<Limbs> magnitude = exact::negate_if(negative, wide);
    Integer result = 0;
    for (int i = Limbs; i-- > 0;) result = (result << 64) + magnitude.limb[static_cast<std::size_t>(i)];
    return negative ? Integer(-result) : result;
}

/// A coordinate in lattice units from the world's origin.
template <class P>
Rational place(const P& point, int axis, std::int64_t origin) {
    return Rational(number(point.numerator(axis)), number(point.weight())) + origin;
}

/// The distance of the two numbers about a number, but no less than the finest that points are rounded to.
Rational spacing(const Rational& at, Numbers numbers) {
    const double near = std::fabs(static_cast<double>(at));
    const auto from = static_cast<float>(near);
    const double distance = numbers == Numbers::doubles
                                ? std::nextafter(near, 2 * near + 1) - near
                                : double{std::nextafter(from, 2 * from + 1)} - double{from};
    return Rational(std::max(distance, numbers == Numbers::floats ? 0x1p-24 : 0x1p-36));
}

Point random_point(std::mt19937& random, std::int32_t side) {
    std::uniform_int_distribution<std::int32_t> at(0, side);
    return {at(random), at(random), at(random)};
}

void expect_nearest(Numbers numbers) {
    std::mt19937 random(7);
    std::size_t moved = 0;
    for (const std::int64_t origin :
         {std::int64_t{0}, -(std::int64_t{1} << 25), -(std::int64_t{1} << 26), std::int64_t{1} << 33,
          -(std::int64_t{1} << 40), std::int64_t{1} << 52}) {
        Soup soup;
        soup.lattice = *exact::Lattice::from_parts(-4, {origin, origin, origin});
        if (!hold_shapes(soup.lattice, numbers)) continue;
        for (int run = 0; run < 3000; ++run) {
            const std::int32_t side = run % 2 ? 7 : exact::universe_side - 1;
            Point p[9];
            for (Point& point : p) {
                point = random_point(random, side);
                // About the world's origin, where doubles are finest.
                if (run % 2 && origin < 0 && origin >= -exact::universe_side / 2)
                    for (std::int32_t* const x : {&point.x, &point.y, &point.z})
                        *x += static_cast<std::int32_t>(-origin) - 3;
            }
            const exact::Plane planes[3] = {exact::Plane::through(p[0], p[1], p[2]),
                                            exact::Plane::through(p[3], p[4], p[5]),
                                            exact::Plane::through(p[6], p[7], p[8])};
            const auto check = [&](const auto& point) {
                for (int axis = 0; axis < 3; ++axis)
                    if (point.approximation(axis) < 0 || point.approximation(axis) > exact::universe_side - 1)
                        return;
                PointTable points(soup);
                const PointId id = points.add(point);
                const RoundedPoints rounded(soup, points, numbers);
                const Vec3 world = rounded.world(id);
                bool any_moved = false;
                for (int axis = 0; axis < 3; ++axis) {
                    const Rational exact_place = place(point, axis, origin);
                    const Rational found = Rational(world[axis]) * 16;
                    const Rational off = abs(Rational(found - exact_place));
                    EXPECT_LE(off, spacing(exact_place, numbers) * Rational(1001, 2000))
                        << "origin " << origin;
                    EXPECT_LE(off, Rational(rounded.largest_rounding()) * 16);
                    EXPECT_EQ(found, Rational(rounded[id][static_cast<std::size_t>(axis)]) /
                                             (std::int64_t{1} << RoundedPoints::fraction_bits) +
                                         origin);
                    any_moved = any_moved || off != 0;
                }
                EXPECT_EQ(rounded.is_moved(id), any_moved);
                moved += any_moved;
            };
            const auto first = planes[0].value_at(p[3]), second = planes[0].value_at(p[4]);
            if ((first < 0 && second > 0) || (first > 0 && second < 0))
                check(exact::intersect_edge(p[3], p[4], first, second));
            if (const auto point = exact::intersect(planes[0], planes[1], planes[2])) check(*point);
        }
    }
    EXPECT_GT(moved, 1000U);
}

TEST(RoundedPoints, AreTheNearestDoubles) { expect_nearest(Numbers::doubles); }
TEST(RoundedPoints, AreTheNearestFloats) { expect_nearest(Numbers::floats); }

TEST(RoundedPoints, MoveVerticesThatAreNoFloats) {
    std::mt19937 random(11);
    for (const std::int64_t origin : {std::int64_t{0}, -(std::int64_t{1} << 25), std::int64_t{1} << 33}) {
        Soup soup;
        soup.lattice = *exact::Lattice::from_parts(-4, {origin, origin, origin});
        for (int i = 0; i < 1000; ++i) soup.points.push_back(random_point(random, exact::universe_side - 1));
        const PointTable points(soup);
        const RoundedPoints rounded(soup, points, Numbers::floats);
        EXPECT_TRUE(rounded.moves_vertices());
        EXPECT_FALSE(RoundedPoints(soup, points).moves_vertices());
        for (PointId id = 0; id < soup.points.size(); ++id) {
            const Vec3 before = soup.lattice.to_world(soup.points[id]), after = rounded.world(id);
            EXPECT_EQ(rounded.is_moved(id), before != after);
            for (int axis = 0; axis < 3; ++axis) {
                const double nearest = static_cast<float>(before[axis]);
                EXPECT_EQ(after[axis], static_cast<float>(after[axis]));
                EXPECT_EQ(std::fabs(after[axis] - before[axis]), std::fabs(nearest - before[axis]));
                EXPECT_LE(std::fabs(after[axis] - before[axis]), rounded.largest_rounding());
            }
        }
    }
    // What floats were read from stays.
    Soup soup;
    EXPECT_TRUE(
        hold_shapes(*exact::Lattice::from_parts(0, {0, -(std::int64_t{1} << 35), 0}), Numbers::floats));
    EXPECT_FALSE(hold_shapes(*exact::Lattice::from_parts(0, {0, std::int64_t{1} << 36, 0}), Numbers::floats));
    soup.lattice = *exact::Lattice::from_parts(0, {0, 0, 0});
    soup.points = {{0, 1, (1 << 24) - 1}, {1 << 24, (1 << 25) + 4, (1 << 26) - 4}};
    EXPECT_FALSE(RoundedPoints(soup, PointTable(soup), Numbers::floats).moves_vertices());
}

TEST(RoundedPoints, HaveExactPredicates) {
    std::mt19937_64 random(3);
    for (int run = 0; run < 20000; ++run) {
        RoundedPoints::Point p[4];
        const int bits = run % 3 == 0 ? 2 : 62;
        for (auto& point : p)
            for (auto& x : point) x = static_cast<std::int64_t>(random() >> (64 - bits));
        // Often nearly in one plane.
        if (run % 3 == 1)
            for (std::size_t k = 0; k < 3; ++k)
                p[3][k] = p[0][k] / 2 + p[1][k] / 2 + static_cast<int>(random() % 2);
        Integer u[3], v[3], w[3];
        for (std::size_t k = 0; k < 3; ++k)
            u[k] = Integer(p[1][k]) - p[0][k], v[k] = Integer(p[2][k]) - p[0][k],
            w[k] = Integer(p[3][k]) - p[0][k];
        const Integer normal[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                                   u[0] * v[1] - u[1] * v[0]};
        const Integer volume = normal[0] * w[0] + normal[1] * w[1] + normal[2] * w[2];
        EXPECT_EQ(static_cast<int>(orient3d(p[0], p[1], p[2], p[3])), volume.sign());
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_EQ(static_cast<int>(orient2d(axis, p[0], p[1], p[2])), normal[axis].sign());
    }
}

}  // namespace
}  // namespace octavo::boolean
