// SPDX-License-Identifier: Apache-2.0
#include <bit>
#include <cmath>

#include <gtest/gtest.h>

#include <octavo/exact/linear_form.hpp>
#include <octavo/exact/side.hpp>

#include "effort.hpp"
#include "exact/generator.hpp"
#include "exact/oracle.hpp"

namespace octavo::exact {
namespace {

using oracle::Integer;
using tests::Generator;

// All finite doubles are multiples of 2^-1074, so that one scale makes the whole form an integer.

Integer scaled(std::int64_t number, int exponent) {
    return Integer(number) << static_cast<unsigned>(exponent + 1074);
}
Integer scaled(double number) {
    int exponent = 0;
    const auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(number, &exponent), 53));
    if (exponent - 53 >= -1074) return scaled(mantissa, exponent - 53);
    return Integer(mantissa /
                   (std::int64_t{1} << (-1074 - exponent + 53)));  // subnormal: the low bits are zero
}

struct Form {
    std::int64_t a, b, c;
    int128 d;
    int exponent = 0;
};

Sign oracle_sign(const Form& form, Vec3 p) {
    const Integer sum = form.a * scaled(p.x) + form.b * scaled(p.y) + form.c * scaled(p.z) +
                        (Integer(form.d) << static_cast<unsigned>(form.exponent + 1074));
    return static_cast<Sign>(sum.sign());
}

void expect_sign(const Form& form, Vec3 p) {
    const LinearForm linear(form.a, form.b, form.c, form.d, form.exponent);
    const Sign expected = oracle_sign(form, p);
    ASSERT_EQ(linear.at(p), expected);
    ASSERT_EQ(linear.exact_at(p), expected);
}

/// Any finite double: all exponents, subnormal numbers and zeros included.
double any_double(Generator& random) {
    if (random.word() % 16 == 0) return 0;
    if (random.word() % 16 == 0) return std::ldexp(static_cast<double>(random.between(-9, 9)), -1074);
    for (;;) {
        const double number = std::bit_cast<double>(random.word());
        if (std::isfinite(number)) return number;
    }
}

int128 wide_offset(Generator& random, int bits) {
    const auto value = static_cast<int128>((uint128{random.word()} << 64 | random.word()) >> (128 - bits));
    return random.coin() ? value : -value;
}

TEST(LinearForm, AnyDoublesAndExponentsAgreeWithTheOracle) {
    Generator random(91);
    for (int i = 0; i < 400'000 * tests::effort(); ++i)
        expect_sign({random.signed_bits(62), random.signed_bits(62), random.signed_bits(62),
                     wide_offset(random, static_cast<int>(random.between(1, 119))),
                     static_cast<int>(random.between(-1074, 900))},
                    {any_double(random), any_double(random), any_double(random)});
}

TEST(LinearForm, ExponentsCloseToOneAnotherAgreeWithTheOracle) {
    Generator random(92);
    for (int i = 0; i < 600'000 * tests::effort(); ++i) {
        const int exponent = static_cast<int>(random.between(-1000, 800));
        const auto number = [&] {
            return std::ldexp(static_cast<double>(random.signed_bits(53)),
                              exponent + static_cast<int>(random.between(-70, 70)));
        };
        expect_sign({random.signed_bits(54), random.signed_bits(54), random.signed_bits(54),
                     wide_offset(random, static_cast<int>(random.between(1, 119))),
                     exponent + static_cast<int>(random.between(-70, 70))},
                    {number(), number(), number()});
    }
}

TEST(LinearForm, ExactZerosAndTheirNeighboursAgreeWithTheOracle) {
    Generator random(93);
    int zeros = 0;
    for (int i = 0; i < 200'000 * tests::effort(); ++i) {
        // Integer multiples of one power of two, so that an offset exists that makes the form zero.
        const int bits = random.coin() ? 53 : 20;
        const int exponent = i % 3 == 0 ? -1074 : static_cast<int>(random.between(-1074, 900));
        const std::int64_t x = random.signed_bits(bits), y = random.signed_bits(bits),
                           z = random.signed_bits(bits);
        const std::int64_t a = random.signed_bits(54), b = random.signed_bits(54), c = random.signed_bits(54);
        const int128 d = -(wide(a) * x + wide(b) * y + wide(c) * z);
        const auto scaled = [&](std::int64_t number) {
            return std::ldexp(static_cast<double>(number), exponent);
        };
        Vec3 p{scaled(x), scaled(y), scaled(z)};
        const LinearForm form(a, b, c, d, exponent);
        ASSERT_EQ(form.at(p), Sign::zero);
        ASSERT_EQ(form.exact_at(p), Sign::zero);
        ++zeros;
        const auto shift = static_cast<int>(random.between(-1, 1));
        ASSERT_EQ(LinearForm(a, b, c, d + shift, exponent).at(p), static_cast<Sign>(shift));
        p[static_cast<int>(random.between(0, 2))] *= 1 + 0x1p-52;
        expect_sign({a, b, c, d, exponent}, p);
        p.x = std::nextafter(p.x, random.coin() ? Box3::infinity : -Box3::infinity);
        expect_sign({a, b, c, d, exponent}, p);
    }
    EXPECT_GE(zeros, 100'000);
}

TEST(LinearForm, GreatTermsThatCancelLeaveTheDecisionToSmallOnes) {
    Generator random(94);
    for (int i = 0; i < 100'000 * tests::effort(); ++i) {
        const std::int64_t a = random.signed_bits(50), b = random.signed_bits(50), c = random.signed_bits(54);
        const int high = static_cast<int>(random.between(0, 950)),
                  low = static_cast<int>(random.between(-1074, 0));
        // a (b 2^high) - b (a 2^high) + c z + d 2^low: products that overflow a double are among them.
        const double z = random.coin() ? any_double(random) : 0;
        const int128 d =
            random.coin() ? wide_offset(random, 100) : static_cast<int128>(random.between(-1, 1));
        expect_sign({a, -b, c, d, low},
                    {std::ldexp(static_cast<double>(b), high), std::ldexp(static_cast<double>(a), high), z});
    }
}

TEST(LinearForm, OverflowAndUnderflowDoNotDecide) {
    const double huge = 0x1.fffffffffffffp1023, tiny = 0x1p-1074;
    const std::int64_t n = std::int64_t{1} << 54;
    EXPECT_EQ(LinearForm(n, -n, 0, 1).at({huge, huge, 0}), Sign::positive);
    EXPECT_EQ(LinearForm(n, -n, 0, 0).at({huge, std::nextafter(huge, 0.0), 0}), Sign::positive);
    EXPECT_EQ(LinearForm(n, n, n, -1).at({huge, huge, huge}), Sign::positive);
    EXPECT_EQ(LinearForm(1, 0, 0, 0).at({tiny, huge, huge}), Sign::positive);
    EXPECT_EQ(LinearForm(1, -1, 0, 0).at({2 * tiny, tiny, 0}), Sign::positive);
    EXPECT_EQ(LinearForm(1, 0, 0, 1, -1074).at({-tiny, 0, 0}), Sign::zero);
    EXPECT_EQ(LinearForm(1, 0, 0, 1, 900).at({-tiny, 0, 0}), Sign::positive);
    EXPECT_EQ(LinearForm(0, 0, 0, 0).at({huge, huge, huge}), Sign::zero);
}

TEST(LinearForm, APlaneOfALatticeIsSeenAtTheSamePlaceFromTheWorld) {
    Generator random(95);
    int zeros = 0;
    for (int i = 0; i < 200'000 * tests::effort(); ++i) {
        const auto origin = [&] { return random.between(-(std::int64_t{1} << 52), std::int64_t{1} << 52); };
        const auto lattice =
            Lattice::from_parts(static_cast<int>(random.between(-900, 900)), {origin(), origin(), origin()});
        const Point p = random.point(), q = random.point(), r = random.point();
        const Plane plane = Plane::through(p, q, r);
        const LinearForm form = LinearForm::of(*lattice, plane);
        ASSERT_EQ(form.at(lattice->to_world(p)), Sign::zero);
        const Point s = random.coin() ? random.point() : random.near(q, 1);
        ASSERT_EQ(form.at(lattice->to_world(s)), side_of(plane, s));
        zeros += side_of(plane, s) == Sign::zero;
    }
    EXPECT_GT(zeros, 1'000);
}

TEST(LinearFormDeathTest, ExponentsOffsetsAndPointsOutOfRangeAreRefused) {
    EXPECT_DEATH(LinearForm(1, 0, 0, 0, 901), "exponent");
    EXPECT_DEATH(LinearForm(1, 0, 0, 0, -1075), "exponent");
    EXPECT_DEATH(LinearForm(1, 0, 0, int128{1} << 120), "offset");
    EXPECT_DEATH(static_cast<void>(LinearForm(1, 1, 1, 0).at({std::nan(""), 0, 0})), "not finite");
    EXPECT_DEATH(static_cast<void>(LinearForm(1, 1, 1, 0).at({Box3::infinity, 0, 0})), "not finite");
}

}  // namespace
}  // namespace octavo::exact
