// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <octavo/exact/lattice.hpp>

#include "exact/generator.hpp"
#include "unlimited.hpp"

namespace octavo::exact {
namespace {

using octavo::tests::Rational;
using tests::Generator;

/// A world coordinate in units of the lattice, relative to its origin; exact.
Rational local(const Lattice& lattice, int axis, double world) {
    return Rational(world) / Rational(lattice.unit()) - Rational(lattice.origin()[axis]);
}

Box3 box(Vec3 low, Vec3 high) {
    Box3 result;
    result.add(low);
    result.add(high);
    return result;
}

/// Content of any size, place and shape; its corners are not round numbers.
Box3 random_content(Generator& random) {
    const int size = static_cast<int>(random.between(-900, 900));
    const int place = std::min(940, size + static_cast<int>(random.between(-40, 80)));
    Box3 content;
    for (int corner = 0; corner < 2; ++corner) {
        Vec3 p;
        for (int axis = 0; axis < 3; ++axis) {
            const double offset = std::ldexp(static_cast<double>(axis - 1) * 0.7, place);
            p[axis] = offset + std::ldexp(static_cast<double>(random.signed_bits(53)), size - 53);
        }
        content.add(p);
    }
    return content;
}

void expect_free_unit_around(const Lattice& lattice, const Box3& content) {
    const Point low = lattice.snap(content.low), high = lattice.snap(content.high);
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_GE(low[axis], 1);
        EXPECT_LE(high[axis], universe_side - 2);
        EXPECT_GE(local(lattice, axis, content.low[axis]), 0);
        EXPECT_LT(local(lattice, axis, content.high[axis]), universe_side);
    }
}

double longest_side(const Lattice& lattice, const Box3& content) {
    const Vec3 extents = content.extents();
    return std::max({extents.x, extents.y, extents.z}) / lattice.unit();
}

TEST(Lattice, FitContainsTheContentWithAFreeUnitAround) {
    Generator random(101);
    for (int i = 0; i < 5'000; ++i) {
        const Box3 content = random_content(random);
        const auto lattice = Lattice::fit(content);
        ASSERT_TRUE(lattice);
        expect_free_unit_around(*lattice, content);
    }
}

TEST(Lattice, FitUsesAtLeastHalfOfTheUniverseUnlessDoublesAreCoarserThere) {
    Generator random(102);
    int coarse = 0;
    for (int i = 0; i < 5'000; ++i) {
        const Box3 content = random_content(random);
        const auto lattice = Lattice::fit(content);
        ASSERT_TRUE(lattice);
        double farthest = 0;
        for (int axis = 0; axis < 3; ++axis)
            farthest = std::max({farthest, std::fabs(content.low[axis]), std::fabs(content.high[axis])});
        const double spacing = std::nextafter(farthest, Box3::infinity) - farthest;
        if (lattice->unit() == spacing)
            ++coarse;
        else
            EXPECT_GE(longest_side(*lattice, content), (universe_side >> 1) - 3);
    }
    EXPECT_GT(coarse, 100);
    EXPECT_LT(coarse, 4'900);
}

TEST(Lattice, SnapTakesTheNearestPointAndTiesToEven) {
    const auto lattice = Lattice::from_parts(-3, {-4, 0, 5});
    const auto x = [&](double units) { return lattice->snap({units / 8, 1, 5}).x + lattice->origin()[0]; };
    EXPECT_EQ(x(0.5), 0);
    EXPECT_EQ(x(1.5), 2);
    EXPECT_EQ(x(2.5), 2);
    EXPECT_EQ(x(-0.5), 0);
    EXPECT_EQ(x(-1.5), -2);
    EXPECT_EQ(x(std::nextafter(0.5, 1.0)), 1);
    EXPECT_EQ(x(std::nextafter(1.5, 1.0)), 1);
    EXPECT_EQ(x(-0.0), 0);
}

TEST(Lattice, SnapMovesAPointByAtMostHalfAUnitAndLatticePointsNotAtAll) {
    Generator random(103);
    for (int i = 0; i < 3'000; ++i) {
        const Box3 content = random_content(random);
        const auto lattice = Lattice::fit(content);
        ASSERT_TRUE(lattice);
        Vec3 p;
        for (int axis = 0; axis < 3; ++axis) {
            const double t = static_cast<double>(random.between(0, 1 << 30)) / (1 << 30);
            p[axis] = std::min(content.high[axis],
                               content.low[axis] + t * (content.high[axis] - content.low[axis]));
        }
        const Point snapped = lattice->snap(p);
        for (int axis = 0; axis < 3; ++axis) {
            const Rational moved = local(*lattice, axis, p[axis]) - snapped[axis];
            ASSERT_LE(abs(moved), Rational(1, 2));
        }
        const Vec3 world = lattice->to_world(snapped);
        ASSERT_EQ(lattice->snap(world), snapped);
        for (int axis = 0; axis < 3; ++axis) ASSERT_EQ(local(*lattice, axis, world[axis]), snapped[axis]);
    }
}

TEST(Lattice, CoordinatesThatLieOnTheLatticeComeBackBitForBit) {
    // A box of short decimals: all are multiples of 1/1024.
    const Box3 content = box({-10.25, 3.5, 0}, {100.0009765625, 4, 7.75});
    const auto lattice = Lattice::fit(content);
    ASSERT_TRUE(lattice);
    EXPECT_EQ(lattice->to_world(lattice->snap(content.low)), content.low);
    EXPECT_EQ(lattice->to_world(lattice->snap(content.high)), content.high);
}

TEST(Lattice, ContentOfAPowerOfTwoUsesHalfTheUniverse) {
    for (const int exponent : {-900, -1, 0, 1, 25, 26, 27, 900}) {
        const double side = std::ldexp(1.0, exponent);
        const Box3 content = box({0, 0, 0}, {side, side, side});
        const auto lattice = Lattice::fit(content);
        ASSERT_TRUE(lattice);
        // 2^26 units would leave no free unit, so it takes 2^25.
        EXPECT_EQ(longest_side(*lattice, content), universe_side >> 1);
        expect_free_unit_around(*lattice, content);
    }
}

TEST(Lattice, ContentThatJustFitsUsesTheWholeUniverse) {
    for (int missing = 0; missing < 8; ++missing) {
        const double side = universe_side - missing;
        const Box3 content = box({0, 0, 0}, {side, 1, 1});
        const auto lattice = Lattice::fit(content);
        ASSERT_TRUE(lattice);
        EXPECT_EQ(lattice->unit(), missing >= 3 ? 1 : 2) << missing;
        expect_free_unit_around(*lattice, content);
    }
}

TEST(Lattice, ASinglePointIsRepresentedExactly) {
    Generator random(104);
    for (int i = 0; i < 2'000; ++i) {
        const Vec3 p{std::ldexp(static_cast<double>(random.signed_bits(53)),
                                static_cast<int>(random.between(-900, 800))),
                     0, 0};
        const auto lattice = Lattice::fit(box(p, p));
        ASSERT_TRUE(lattice);
        EXPECT_EQ(lattice->to_world(lattice->snap(p)), p);
    }
    const auto origin = Lattice::fit(box({}, {}));
    ASSERT_TRUE(origin);
    EXPECT_EQ(origin->to_world(origin->snap({})), Vec3{});
}

TEST(Lattice, AFlatOrLinearContentIsNoTrouble) {
    const Box3 sheet = box({1, 2, 3}, {5, 9, 3});
    const auto lattice = Lattice::fit(sheet);
    ASSERT_TRUE(lattice);
    EXPECT_EQ(lattice->snap(sheet.low).z, lattice->snap(sheet.high).z);
    expect_free_unit_around(*lattice, sheet);
}

TEST(Lattice, FarFromTheOriginTheUnitIsTheSpacingOfDoublesAndNoVertexMoves) {
    // A millimetre at a distance of a light second: finer than 2^53 units away from the origin.
    const double far = 299792458.0;
    const double step = std::nextafter(far, Box3::infinity) - far;
    const Box3 content = box({far, -far, 1}, {far + 20'000 * step, -far + 5 * step, 1 + 1e-6});
    const auto lattice = Lattice::fit(content);
    ASSERT_TRUE(lattice);
    EXPECT_LE(lattice->unit(), step);
    for (int k = 0; k <= 20'000; k += 37) {
        const Vec3 p{far + k * step, -far, 1};
        const Vec3 snapped = lattice->to_world(lattice->snap(p));
        ASSERT_EQ(snapped.x, p.x);
        ASSERT_EQ(snapped.y, p.y);
    }
    const double next = std::nextafter(1e300, Box3::infinity);
    const auto farther = Lattice::fit(box({1e300, 1e300, 1e300}, {next, 1e300, 1e300}));
    ASSERT_FALSE(farther);  // the spacing there is 2^944, beyond the greatest unit
    EXPECT_EQ(farther.error().code, ErrorCode::limit);
}

TEST(Lattice, ContentTooGreatOrTooSmallIsALimitNotASilentCollapse) {
    EXPECT_EQ(Lattice::fit(box({-1e308, 0, 0}, {1e308, 0, 0})).error().code, ErrorCode::limit);
    EXPECT_EQ(Lattice::fit(box({0, 0, 0}, {1e290, 0, 0})).error().code, ErrorCode::limit);
    EXPECT_EQ(Lattice::fit(box({0, 0, 0}, {1e-310, 0, 0})).error().code, ErrorCode::limit);
    EXPECT_EQ(Lattice::fit(box({0, 0, 0}, {0x1p-976, 0, 0})).error().code, ErrorCode::limit);
    EXPECT_TRUE(Lattice::fit(box({0, 0, 0}, {0x1p-975, 0, 0})));
    EXPECT_TRUE(Lattice::fit(box({0, 0, 0}, {1e278, 0, 0})));
}

TEST(Lattice, BoundsThatAreEmptyOrNotFiniteAreBadInput) {
    EXPECT_EQ(Lattice::fit(Box3{}).error().code, ErrorCode::bad_input);
    Box3 content = box({0, 0, 0}, {1, 1, 1});
    content.high.y = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(Lattice::fit(content).error().code, ErrorCode::bad_input);
    content.high.y = Box3::infinity;
    EXPECT_EQ(Lattice::fit(content).error().code, ErrorCode::bad_input);
}

TEST(Lattice, PartsOutOfRangeAreBadInput) {
    const std::int64_t least = -(std::int64_t{1} << 53), greatest = -least - universe_side + 1;
    const auto lattice = Lattice::from_parts(900, {greatest, least, 0});
    ASSERT_TRUE(lattice);
    EXPECT_EQ(lattice->to_world({universe_side - 1, 0, 0}), (Vec3{0x1p953, -0x1p953, 0}));
    EXPECT_FALSE(Lattice::from_parts(901, {0, 0, 0}));
    EXPECT_FALSE(Lattice::from_parts(-1001, {0, 0, 0}));
    EXPECT_FALSE(Lattice::from_parts(0, {0, greatest + 1, 0}));
    EXPECT_FALSE(Lattice::from_parts(0, {0, 0, least - 1}));
    EXPECT_FALSE(Lattice::from_parts(0, {std::numeric_limits<std::int64_t>::min(), 0, 0}));
}

TEST(LatticeDeathTest, SnappingAPointOutsideTheUniverseIsACallersBug) {
    const auto lattice = Lattice::from_parts(0, {0, 0, 0});
    EXPECT_DEATH(static_cast<void>(lattice->snap({-1, 0, 0})), "outside");
    EXPECT_DEATH(static_cast<void>(lattice->snap({0, 0, double{universe_side}})), "outside");
    EXPECT_DEATH(static_cast<void>(lattice->snap({0, std::nan(""), 0})), "outside");
}

TEST(Lattice, CellAtIsTheExactFloor) {
    Generator random(105);
    int found = 0;
    for (int i = 0; i < 20'000; ++i) {
        const auto origin = [&] { return random.between(-(std::int64_t{1} << 52), std::int64_t{1} << 52); };
        const auto lattice =
            Lattice::from_parts(static_cast<int>(random.between(-900, 900)), {origin(), origin(), origin()});
        ASSERT_TRUE(lattice);
        Vec3 p = lattice->to_world(random.point());
        const int axis = static_cast<int>(random.between(0, 2));
        if (random.coin())
            p[axis] = std::nextafter(p[axis], random.coin() ? Box3::infinity : -Box3::infinity);
        if (random.coin()) p[axis] += lattice->unit() * static_cast<double>(random.between(-5, 5)) / 3;
        const auto cell = lattice->cell_at(p);
        bool inside = true;
        for (int k = 0; k < 3; ++k) {
            const Rational q = local(*lattice, k, p[k]);
            inside = inside && q >= 0 && q < universe_side;
            if (cell) {
                ASSERT_LE(Rational((*cell)[k]), q);
                ASSERT_LT(q, Rational((*cell)[k] + 1));
            }
        }
        ASSERT_EQ(cell.has_value(), inside);
        found += inside;
    }
    EXPECT_GT(found, 10'000);
}

TEST(Lattice, CellAtSurvivesUnderflowAndOverflow) {
    const double tiny = 0x1p-1074, huge = std::numeric_limits<double>::max();
    const auto coarse = Lattice::from_parts(900, {-5, -5, -5});
    EXPECT_EQ(coarse->cell_at({-tiny, tiny, -0.0}), (Point{4, 5, 5}));
    const auto fine = Lattice::from_parts(-1000, {-5, -5, -5});
    EXPECT_EQ(fine->cell_at({huge, 0, 0}), std::nullopt);
    EXPECT_EQ(fine->cell_at({-huge, 0, 0}), std::nullopt);
    EXPECT_EQ(fine->cell_at({0, std::nan(""), 0}), std::nullopt);
    EXPECT_EQ(fine->cell_at({0, 0, Box3::infinity}), std::nullopt);
    EXPECT_EQ(fine->cell_at({-tiny, tiny, 0}), (Point{4, 5, 5}));
}

}  // namespace
}  // namespace octavo::exact
