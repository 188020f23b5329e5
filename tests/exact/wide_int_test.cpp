// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <octavo/exact/wide_int.hpp>

#include "effort.hpp"
#include "exact/generator.hpp"
#include "exact/oracle.hpp"

namespace octavo::exact {
namespace {

using oracle::Integer;
using tests::Generator;

/// Any length in bits, with runs of ones and zeros, so that carries and borrows travel.
template <int Limbs>
WideInt<Limbs> wide_int(Generator& random) {
    WideInt<Limbs> number;
    for (std::uint64_t& limb : number.limb) {
        const std::uint64_t kind = random.word() % 4;
        limb = kind == 0   ? 0
               : kind == 1 ? ~std::uint64_t{0}
               : kind == 2 ? random.word()
                           : std::uint64_t{1} << random.word() % 64;
    }
    return number;
}

/// What two's complement of this width makes of a number.
template <int Limbs>
Integer wrapped(const Integer& number) {
    const Integer modulus = Integer(1) << (64 * Limbs);
    Integer rest = number % modulus;
    if (rest < 0) rest += modulus;
    return rest >= modulus / 2 ? Integer(rest - modulus) : rest;
}

template <int Limbs>
void expect_ring_operations_agree(std::uint64_t seed) {
    Generator random(seed);
    for (int i = 0; i < 100'000 * tests::effort(); ++i) {
        const auto p = wide_int<Limbs>(random), q = i % 16 ? wide_int<Limbs>(random) : p;
        const Integer a = oracle::integer(p), b = oracle::integer(q);
        ASSERT_EQ(oracle::integer(p + q), wrapped<Limbs>(a + b));
        ASSERT_EQ(oracle::integer(p - q), wrapped<Limbs>(a - b));
        ASSERT_EQ(oracle::integer(-p), wrapped<Limbs>(-a));
        ASSERT_EQ(oracle::integer(negate_if(true, p)), wrapped<Limbs>(-a));
        ASSERT_EQ(negate_if(false, p), p);
        ASSERT_EQ(p.sign(), oracle::sign(a));
        ASSERT_EQ(p < q, a < b);
        ASSERT_EQ(p == q, a == b);
        const int count = static_cast<int>(random.between(0, 64 * Limbs - 1));
        ASSERT_EQ(oracle::integer(p << count), wrapped<Limbs>(a * (Integer(1) << count)));
    }
}

TEST(WideInt, RingOperationsAgreeWithTheOracleModuloTheirWidth) {
    expect_ring_operations_agree<1>(21);
    expect_ring_operations_agree<2>(22);
    expect_ring_operations_agree<3>(23);
    expect_ring_operations_agree<4>(24);
    expect_ring_operations_agree<9>(25);
}

template <int Limbs, int N, int M>
void expect_products_agree(std::uint64_t seed) {
    Generator random(seed);
    for (int i = 0; i < 100'000 * tests::effort(); ++i) {
        const auto p = wide_int<N>(random);
        const auto q = wide_int<M>(random);
        ASSERT_EQ(oracle::integer(multiply<Limbs>(p, q)),
                  wrapped<Limbs>(oracle::integer(p) * oracle::integer(q)));
    }
}

TEST(WideInt, ProductsOfAllWidthsInUseAgreeWithTheOracle) {
    expect_products_agree<2, 1, 1>(31);
    expect_products_agree<3, 2, 1>(32);
    expect_products_agree<3, 1, 2>(33);
    expect_products_agree<3, 2, 2>(34);
    expect_products_agree<3, 3, 1>(35);
    expect_products_agree<4, 3, 1>(36);
    expect_products_agree<4, 3, 2>(37);
    expect_products_agree<6, 3, 3>(38);
    expect_products_agree<9, 6, 3>(39);
    expect_products_agree<6, 1, 2>(40);  // wider than the whole product: its sign is extended
}

TEST(WideInt, WideningKeepsTheValue) {
    Generator random(41);
    for (int i = 0; i < 100'000; ++i) {
        const auto number = wide_int<2>(random);
        ASSERT_EQ(oracle::integer(WideInt<5>(number)), oracle::integer(number));
        const auto small = static_cast<std::int64_t>(random.word());
        ASSERT_EQ(oracle::integer(WideInt<3>(small)), Integer(small));
        const int128 middle = static_cast<int128>(uint128{random.word()} << 64 | random.word());
        ASSERT_EQ(oracle::integer(WideInt<4>(middle)), oracle::integer(middle));
    }
}

/// The nearest double, ties to even, by looking at both neighbours of a truncated quotient.
double nearest_double(const Integer& number) {
    Integer magnitude = abs(number);
    if (magnitude == 0) return 0;
    const int length = static_cast<int>(magnitude.bits());
    int exponent = 0;
    if (length > 53) {
        exponent = length - 53;
        const Integer rest = magnitude % (Integer(1) << static_cast<unsigned>(exponent)),
                      half = Integer(1) << static_cast<unsigned>(exponent - 1);
        magnitude >>= static_cast<unsigned>(exponent);
        if (rest > half || (rest == half && magnitude % 2 == 1)) magnitude += 1;
    }
    const double result = std::ldexp(static_cast<double>(magnitude), exponent);
    return number < 0 ? -result : result;
}

template <int Limbs>
void expect_nearest_doubles(std::uint64_t seed) {
    Generator random(seed);
    for (int i = 0; i < 100'000 * tests::effort(); ++i) {
        auto number = wide_int<Limbs>(random);
        if (i % 4 == 0) {
            // Next to a tie: 53 bits, a half, and perhaps one unit.
            number = WideInt<Limbs>(random.between(std::int64_t{1} << 53, (std::int64_t{1} << 54) - 1));
            const int shift = static_cast<int>(random.between(0, 64 * Limbs - 56));
            number <<= shift;
            number += WideInt<Limbs>(random.between(-1, 1));
        }
        ASSERT_EQ(to_double(number), nearest_double(oracle::integer(number)));
    }
}

TEST(WideInt, ConversionToDoubleRoundsToNearestTiesToEven) {
    expect_nearest_doubles<1>(51);
    expect_nearest_doubles<2>(52);
    expect_nearest_doubles<3>(53);
    expect_nearest_doubles<9>(54);
}

TEST(WideInt, IsConstexpr) {
    constexpr Int256 product = Int192(-7) * WideInt<1>(6);
    static_assert(product == Int256(-42));
    static_assert((product << 3).sign() == Sign::negative);
    static_assert(to_double(product) == -42.0);
    static_assert(Int192(3) < Int192(4) && Int192(-3) > Int192(-4));
}

}  // namespace
}  // namespace octavo::exact
