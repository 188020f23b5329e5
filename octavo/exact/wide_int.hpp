// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <type_traits>
#include <utility>
#ifdef __x86_64__
#include <x86intrin.h>
#endif

#include <octavo/exact/int128.hpp>
#include <octavo/exact/sign.hpp>

// Signed integers of a fixed number of 64-bit limbs.
//
// Problem: predicates on constructed points need 165 to 550 bits; arbitrary-precision numbers allocate and
// branch. Idea: bit_budget.hpp proves the width of every result, so that two's complement arithmetic modulo
// 2^(64 Limbs) is exact although intermediate carries fall off the top. A signed product is the unsigned one
// with two masked subtractions, so nothing is ever sign-extended and multiplied.
//
// Invariant: the caller chooses the width of a result by the budget; nothing here checks for overflow.
// Cost: a product of N and M limbs is at most N M multiplications; no memory, no branches on data.

namespace octavo::exact {

namespace detail {

/// Calls body(0), body(1), … body(Count - 1) with constants. GCC 12 unrolls loops only after it has decided what
/// lives in registers; written as loops, limbs travel through memory and three planes take twice as long to meet.
template <int Count, class Body>
constexpr void unrolled(const Body& body) {
    [&]<int... Index>(std::integer_sequence<int, Index...>) {
        (body(std::integral_constant<int, Index>{}), ...);
    }
    (std::make_integer_sequence<int, Count>{});
}

/// a * b + c + d, which cannot overflow 128 bits; the high half is left in `carry`.
constexpr std::uint64_t multiply_add(std::uint64_t a, std::uint64_t b, std::uint64_t c,
                                     std::uint64_t& carry) {
    const uint128 sum = uint128{a} * b + c + carry;
    carry = static_cast<std::uint64_t>(sum >> 64);
    return static_cast<std::uint64_t>(sum);
}

// GCC 12 keeps a carry in the flags only through the processor's own intrinsics.
constexpr std::uint64_t add(std::uint64_t a, std::uint64_t b, unsigned char& carry) {
#ifdef __x86_64__
    if (!std::is_constant_evaluated()) {
        unsigned long long sum;
        carry = _addcarry_u64(carry, a, b, &sum);
        return sum;
    }
#endif
    const uint128 sum = uint128{a} + b + carry;
    carry = static_cast<unsigned char>(sum >> 64);
    return static_cast<std::uint64_t>(sum);
}

constexpr std::uint64_t subtract(std::uint64_t a, std::uint64_t b, unsigned char& borrow) {
#ifdef __x86_64__
    if (!std::is_constant_evaluated()) {
        unsigned long long difference;
        borrow = _subborrow_u64(borrow, a, b, &difference);
        return difference;
    }
#endif
    const uint128 difference = uint128{a} - b - borrow;
    borrow = static_cast<unsigned char>(difference >> 64) & 1;
    return static_cast<std::uint64_t>(difference);
}

constexpr std::uint64_t mask(bool ones) { return -static_cast<std::uint64_t>(ones); }

}  // namespace detail

template <int Limbs>
struct WideInt {
    static_assert(Limbs >= 1);
    static constexpr int bits = 64 * Limbs;

    std::array<std::uint64_t, Limbs> limb{};  ///< two's complement, least significant first

    constexpr WideInt() = default;
    constexpr WideInt(int number) : WideInt(std::int64_t{number}) {}
    constexpr WideInt(std::int64_t number) {
        limb[0] = static_cast<std::uint64_t>(number);
        fill_from<1>(number < 0);
    }
    constexpr WideInt(int128 number) requires(Limbs >= 2) {
        limb[0] = static_cast<std::uint64_t>(number);
        limb[1] = static_cast<std::uint64_t>(number >> 64);
        fill_from<2>(number < 0);
    }
    template <int Fewer>
    requires(Fewer < Limbs) constexpr WideInt(const WideInt<Fewer>& number) {
        detail::unrolled<Fewer>([&](auto i) { limb[i] = number.limb[i]; });
        fill_from<Fewer>(number.negative());
    }

    constexpr bool negative() const { return limb[Limbs - 1] >> 63; }

    constexpr Sign sign() const {
        if (negative()) return Sign::negative;
        std::uint64_t any = 0;
        detail::unrolled<Limbs>([&](auto i) { any |= limb[i]; });
        return any ? Sign::positive : Sign::zero;
    }

    constexpr WideInt& operator+=(const WideInt& other) {
        unsigned char carry = 0;
        detail::unrolled<Limbs>([&](auto i) { limb[i] = detail::add(limb[i], other.limb[i], carry); });
        return *this;
    }

    constexpr WideInt& operator-=(const WideInt& other) {
        unsigned char borrow = 0;
        detail::unrolled<Limbs>([&](auto i) { limb[i] = detail::subtract(limb[i], other.limb[i], borrow); });
        return *this;
    }

    /// Bits shifted out at the top are lost. 0 <= count < bits.
    constexpr WideInt& operator<<=(int count) {
        const int whole = count / 64, part = count % 64;
        for (int i = Limbs - 1; i >= 0; --i) {
            const std::uint64_t high = i >= whole ? limb[i - whole] : 0;
            const std::uint64_t low = i > whole ? limb[i - whole - 1] : 0;
            limb[i] = part ? high << part | low >> (64 - part) : high;
        }
        return *this;
    }

    friend constexpr WideInt operator+(WideInt first, const WideInt& second) { return first += second; }
    friend constexpr WideInt operator-(WideInt first, const WideInt& second) { return first -= second; }
    friend constexpr WideInt operator<<(WideInt number, int count) { return number <<= count; }
    friend constexpr WideInt operator-(const WideInt& number) { return WideInt{} -= number; }
    friend constexpr bool operator==(const WideInt&, const WideInt&) = default;
    friend constexpr std::strong_ordering operator<=>(const WideInt& first, const WideInt& second) {
        if (first.negative() != second.negative())
            return first.negative() ? std::strong_ordering::less : std::strong_ordering::greater;
        for (int i = Limbs - 1; i >= 0; --i)
            if (first.limb[i] != second.limb[i]) return first.limb[i] <=> second.limb[i];
        return std::strong_ordering::equal;
    }

  private:
    template <int Begin>
    constexpr void fill_from(bool ones) {
        detail::unrolled<Limbs - Begin>([&](auto i) { limb[i + Begin] = detail::mask(ones); });
    }
};

using Int192 = WideInt<3>;
using Int256 = WideInt<4>;

/// Minus the number if asked, else the number; without a branch.
template <int Limbs>
constexpr WideInt<Limbs> negate_if(bool negative, WideInt<Limbs> number) {
    const std::uint64_t mask = detail::mask(negative);
    unsigned char carry = negative;
    detail::unrolled<Limbs>([&](auto i) { number.limb[i] = detail::add(number.limb[i] ^ mask, 0, carry); });
    return number;
}

/// first * second modulo 2^(64 Limbs): exact whenever the product fits Limbs limbs with its sign.
template <int Limbs, int N, int M>
constexpr WideInt<Limbs> multiply(const WideInt<N>& first, const WideInt<M>& second) {
    if constexpr (Limbs > N + M) {
        return multiply<N + M>(first, second);
    } else {
        WideInt<Limbs> product;
        detail::unrolled<N>([&](auto i) {
            std::uint64_t carry = 0;
            detail::unrolled<M>([&](auto j) {
                if constexpr (i + j < Limbs)
                    product.limb[i + j] =
                        detail::multiply_add(first.limb[i], second.limb[j], product.limb[i + j], carry);
            });
            if constexpr (i + M < Limbs) product.limb[i + M] = carry;
        });
        // As an unsigned number, a negative factor is too large by 2^(64 N): take the other one away again there.
        const std::uint64_t first_mask = detail::mask(first.negative());
        unsigned char borrow = 0;
        detail::unrolled<M>([&](auto i) {
            if constexpr (i + N < Limbs)
                product.limb[i + N] =
                    detail::subtract(product.limb[i + N], second.limb[i] & first_mask, borrow);
        });
        const std::uint64_t second_mask = detail::mask(second.negative());
        borrow = 0;
        detail::unrolled<N>([&](auto i) {
            if constexpr (i + M < Limbs)
                product.limb[i + M] =
                    detail::subtract(product.limb[i + M], first.limb[i] & second_mask, borrow);
        });
        return product;
    }
}

/// The whole product.
template <int N, int M>
constexpr WideInt<N + M> operator*(const WideInt<N>& first, const WideInt<M>& second) {
    return multiply<N + M>(first, second);
}

/// The nearest double, ties to even. At most 15 limbs, so that nothing overflows.
template <int Limbs>
constexpr double to_double(const WideInt<Limbs>& number) {
    static_assert(Limbs <= 15);
    const WideInt<Limbs> magnitude = negate_if(number.negative(), number);
    int top = Limbs - 1;
    while (top > 0 && magnitude.limb[top] == 0) --top;
    if (magnitude.limb[top] == 0) return 0;

    // The leading 64 bits; the last one also stands for all that lie below, which is all that rounding asks.
    const int zeros = std::countl_zero(magnitude.limb[top]);
    std::uint64_t leading = magnitude.limb[top] << zeros;
    std::uint64_t below = 0;
    if (top > 0) {
        if (zeros) leading |= magnitude.limb[top - 1] >> (64 - zeros);
        below = magnitude.limb[top - 1] << zeros;
    }
    for (int i = 0; i < top - 1; ++i) below |= magnitude.limb[i];
    // Halved, it is a signed number, which converts in one instruction.
    const std::uint64_t half = leading >> 1 | (leading & 1) | (below != 0 ? 1 : 0);
    const double mantissa = static_cast<double>(static_cast<std::int64_t>(half));
    const std::uint64_t exponent = static_cast<std::uint64_t>(1023 + 64 * top - zeros + 1);
    const double scaled = mantissa * std::bit_cast<double>(exponent << 52);
    return number.negative() ? -scaled : scaled;
}

}  // namespace octavo::exact
