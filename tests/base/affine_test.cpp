// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <octavo/base/any_scale.hpp>

#include "unlimited.hpp"

namespace octavo {
namespace {

Affine diagonal(double x, double y, double z) { return {{{{x, 0, 0, 7}, {0, y, 0, 7}, {0, 0, z, 7}}}}; }

TEST(Affine, MirrorsWhateverItsScaleIs) {
    for (const double size : {1.0, 1e-120, 1e-300, 1e120, 1e300}) {
        EXPECT_FALSE(diagonal(size, size, size).mirrors()) << size;
        EXPECT_TRUE(diagonal(-size, size, size).mirrors()) << size;
        EXPECT_FALSE(diagonal(-size, -size, size).mirrors()) << size;
        EXPECT_TRUE(diagonal(-size, 1, 1 / size).mirrors()) << size;
    }
    EXPECT_FALSE(diagonal(0, -1, 1).mirrors()) << "a flat map has no side";
    EXPECT_EQ(determinant_sign(diagonal(0, -1, 1)), 0);
    EXPECT_EQ(determinant_sign(diagonal(1e-300, 1e300, 1e-300)), 1);
    EXPECT_EQ((determinant_sign({{{{1e-200, 1, 0, 0}, {1e-200, 2, 0, 0}, {0, 0, 1e200, 0}}}})), 1);
    EXPECT_TRUE((Affine{{{{0, 1, 0, 0}, {1, 0, 0, 0}, {0, 0, 1, 0}}}}.mirrors()));
}

int exact_determinant_sign(const Affine& map) {
    const auto a = [&](std::size_t row, std::size_t column) {
        return octavo::tests::Rational(map.m[row][column]);
    };
    const octavo::tests::Rational exact = a(0, 0) * (a(1, 1) * a(2, 2) - a(1, 2) * a(2, 1)) -
                                          a(0, 1) * (a(1, 0) * a(2, 2) - a(1, 2) * a(2, 0)) +
                                          a(0, 2) * (a(1, 0) * a(2, 1) - a(1, 1) * a(2, 0));
    return exact.sign();
}

TEST(Affine, TheSignOfTheDeterminantIsThatOfRationals) {
    std::mt19937_64 random(3);
    const auto below = [&](int n) { return static_cast<int>(random() % static_cast<std::uint64_t>(n)); };
    int flat = 0;
    for (int round = 0; round < 1500; ++round) {
        // Few digits, so that many are singular or nearly so; each row and column at a scale of its own.
        Affine map;
        std::array<int, 3> row_scale{}, column_scale{};
        for (std::size_t i = 0; i < 3; ++i) {
            row_scale[i] = below(2) ? 0 : below(600) - 300;
            column_scale[i] = below(2) ? 0 : below(600) - 300;
        }
        for (std::size_t r = 0; r < 3; ++r)
            for (std::size_t c = 0; c < 3; ++c) {
                const double digits = below(5) - 2 + (below(4) ? 0 : std::ldexp(below(3) - 1, -50));
                map.m[r][c] = std::ldexp(digits, row_scale[r] + column_scale[c]);
            }
        const int expected = exact_determinant_sign(map);
        ASSERT_EQ(determinant_sign(map), expected) << round;
        flat += expected == 0;
    }
    EXPECT_GT(flat, 80);
}

TEST(Affine, TheSignOfTheDeterminantIsThatOfRationalsWhateverEntriesVanishBesideOthers) {
    std::mt19937_64 random(4);
    const auto below = [&](int n) { return static_cast<int>(random() % static_cast<std::uint64_t>(n)); };
    int flat = 0;
    for (int round = 0; round < 3000; ++round) {
        Affine map;
        for (std::size_t r = 0; r < 3; ++r)
            for (std::size_t c = 0; c < 3; ++c) {
                const int exponent = below(3) ? 0 : below(2090) - 1070;
                map.m[r][c] = std::ldexp(below(5) - 2, exponent);
            }
        const int expected = exact_determinant_sign(map);
        ASSERT_EQ(determinant_sign(map), expected) << round;
        flat += expected == 0;
    }
    EXPECT_GT(flat, 100);
}

TEST(Affine, CrossDirectionsOfNearlyParallelVectorsLoseNothing) {
    using octavo::tests::Rational;
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (int round = 0; round < 2000; ++round) {
        const double size = std::ldexp(1, round % 3 * 900 - 900), step = std::ldexp(1, -(round % 50));
        const Vec3 a{uniform(random), uniform(random), uniform(random)};
        const Vec3 b = a + step * Vec3{uniform(random), uniform(random), uniform(random)};
        const Vec3 normal = cross_direction(size * a, b);
        // Their ratio to the exact components is one for all, but for some units in the last place.
        std::array<Rational, 3> exact{};
        for (int axis = 0; axis < 3; ++axis) {
            const int i = (axis + 1) % 3, j = (axis + 2) % 3;
            exact[static_cast<std::size_t>(axis)] =
                Rational(a[i]) * Rational(b[j]) - Rational(a[j]) * Rational(b[i]);
        }
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::size_t next = (axis + 1) % 3;
            const Rational one = exact[axis] * Rational(normal[static_cast<int>(next)]),
                           other = exact[next] * Rational(normal[static_cast<int>(axis)]);
            EXPECT_LE(abs(one - other), abs(one) * Rational(0x1p-50)) << round;
        }
    }
}

TEST(Affine, MirrorsIsDecidedBeyondRounding) {
    // The upper left minor is -2^-60, which products rounded to doubles lose.
    const double step = 0x1p-30;
    Affine map{{{{1 + step, 1, 0, 0}, {1, 1 - step, 0, 0}, {0, 0, 1, 0}}}};
    EXPECT_TRUE(map.mirrors());
    std::swap(map.m[0], map.m[1]);
    EXPECT_FALSE(map.mirrors());
}

}  // namespace
}  // namespace octavo
