// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <compare>
#include <concepts>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <ostream>
#include <utility>

#include <gmpxx.h>

#include <octavo/exact/int128.hpp>

// Integers and rationals without limit, GMP's, for oracles: every operation is exact.
//
// GMP's own classes for C++ give expressions that refer to their operands, which `auto`, lambdas and conditional
// operators keep too long; here each operation gives a number. Boost.Multiprecision's numbers took four seconds a file
// to compile.

namespace octavo::tests {

/// Memory for GMP's limbs, kept for the next number: half of the time went into asking for it anew.
class Limbs {
  public:
    static bool serve() {
        mp_set_memory_functions(allocate, reallocate, release);
        return true;
    }

  private:
    static constexpr std::size_t block = 256;

    static void* allocate(std::size_t bytes) {
        if (bytes > block) return std::malloc(bytes);
        if (first_free == nullptr) return std::malloc(block);
        return std::exchange(first_free, *static_cast<void**>(first_free));
    }
    static void* reallocate(void* old, std::size_t bytes, std::size_t wanted) {
        if (bytes <= block && wanted <= block) return old;
        if (bytes > block && wanted > block) return std::realloc(old, wanted);
        void* const moved = allocate(wanted);
        std::memcpy(moved, old, std::min(bytes, wanted));
        release(old, bytes);
        return moved;
    }
    static void release(void* memory, std::size_t bytes) {
        if (bytes > block) return std::free(memory);
        *static_cast<void**>(memory) = std::exchange(first_free, memory);
    }
    inline static thread_local void* first_free = nullptr;  ///< each holds the address of the next
};
inline const bool limbs_are_kept = Limbs::serve();

class Integer {
  public:
    Integer() = default;
    template <std::signed_integral Number>
    Integer(Number number) : value_(static_cast<long>(number)) {}
    template <std::unsigned_integral Number>
    Integer(Number number) : value_(static_cast<unsigned long>(number)) {}
    Integer(exact::int128 number) : Integer(static_cast<std::int64_t>(number >> 64)) {
        *this <<= 64;
        *this += static_cast<std::uint64_t>(number);
    }
    explicit Integer(mpz_class value) : value_(std::move(value)) {}

    const mpz_class& value() const { return value_; }
    int sign() const { return sgn(value_); }
    /// Of the magnitude; 1 for zero.
    std::size_t bits() const { return mpz_sizeinbase(value_.get_mpz_t(), 2); }
    explicit operator double() const { return value_.get_d(); }

    Integer operator-() const { return Integer(mpz_class(-value_)); }
    Integer& operator+=(const Integer& other) { return value_ += other.value_, *this; }
    Integer& operator-=(const Integer& other) { return value_ -= other.value_, *this; }
    Integer& operator*=(const Integer& other) { return value_ *= other.value_, *this; }
    Integer&& add_product(const Integer& a, const Integer& b) && {
        mpz_addmul(value_.get_mpz_t(), a.value_.get_mpz_t(), b.value_.get_mpz_t());
        return std::move(*this);
    }
    Integer&& subtract_product(const Integer& a, const Integer& b) && {
        mpz_submul(value_.get_mpz_t(), a.value_.get_mpz_t(), b.value_.get_mpz_t());
        return std::move(*this);
    }
    /// Towards zero; the remainder has the dividend's sign.
    Integer& operator/=(const Integer& other) { return value_ /= other.value_, *this; }
    Integer& operator%=(const Integer& other) { return value_ %= other.value_, *this; }
    Integer& operator<<=(unsigned bits) { return value_ <<= bits, *this; }
    Integer& operator>>=(unsigned bits) { return value_ >>= bits, *this; }

    // Sums in place where they can: memory for each is what numbers of this size cost most.
    friend Integer operator+(const Integer& a, const Integer& b) {
        return Integer(mpz_class(a.value_ + b.value_));
    }
    friend Integer operator+(Integer&& a, const Integer& b) { return std::move(a += b); }
    friend Integer operator-(const Integer& a, const Integer& b) {
        return Integer(mpz_class(a.value_ - b.value_));
    }
    friend Integer operator-(Integer&& a, const Integer& b) { return std::move(a -= b); }
    friend Integer operator*(const Integer& a, const Integer& b) {
        return Integer(mpz_class(a.value_ * b.value_));
    }
    friend Integer operator/(const Integer& a, const Integer& b) {
        return Integer(mpz_class(a.value_ / b.value_));
    }
    friend Integer operator%(const Integer& a, const Integer& b) {
        return Integer(mpz_class(a.value_ % b.value_));
    }
    friend Integer operator<<(Integer a, unsigned bits) { return a <<= bits; }
    friend Integer operator>>(Integer a, unsigned bits) { return a >>= bits; }
    friend bool operator==(const Integer& a, const Integer& b) { return a.value_ == b.value_; }
    friend std::strong_ordering operator<=>(const Integer& a, const Integer& b) {
        return cmp(a.value_, b.value_) <=> 0;
    }
    friend Integer abs(const Integer& a) { return a.sign() < 0 ? -a : a; }
    friend Integer gcd(const Integer& a, const Integer& b) { return Integer(::gcd(a.value_, b.value_)); }
    friend std::ostream& operator<<(std::ostream& out, const Integer& a) { return out << a.value_.get_str(); }

  private:
    mpz_class value_;
};

class Rational {
  public:
    Rational() = default;
    Rational(const Integer& number) : value_(number.value()) {}
    template <std::integral Number>
    Rational(Number number) : Rational(Integer(number)) {}
    template <std::floating_point Number>
    explicit Rational(Number number) : value_(static_cast<double>(number)) {}
    Rational(const Integer& numerator, const Integer& denominator)
        : value_(numerator.value(), denominator.value()) {
        value_.canonicalize();
    }
    explicit Rational(mpq_class value) : value_(std::move(value)) {}

    Integer numerator() const { return Integer(value_.get_num()); }
    Integer denominator() const { return Integer(value_.get_den()); }
    int sign() const { return sgn(value_); }
    /// Towards zero.
    explicit operator double() const { return value_.get_d(); }

    Rational operator-() const { return Rational(mpq_class(-value_)); }
    Rational& operator+=(const Rational& other) { return value_ += other.value_, *this; }
    Rational& operator-=(const Rational& other) { return value_ -= other.value_, *this; }
    Rational& operator*=(const Rational& other) { return value_ *= other.value_, *this; }
    Rational& operator/=(const Rational& other) { return value_ /= other.value_, *this; }

    friend Rational operator+(const Rational& a, const Rational& b) {
        return Rational(mpq_class(a.value_ + b.value_));
    }
    friend Rational operator-(const Rational& a, const Rational& b) {
        return Rational(mpq_class(a.value_ - b.value_));
    }
    friend Rational operator*(const Rational& a, const Rational& b) {
        return Rational(mpq_class(a.value_ * b.value_));
    }
    friend Rational operator/(const Rational& a, const Rational& b) {
        return Rational(mpq_class(a.value_ / b.value_));
    }
    friend bool operator==(const Rational& a, const Rational& b) { return a.value_ == b.value_; }
    friend std::strong_ordering operator<=>(const Rational& a, const Rational& b) {
        return cmp(a.value_, b.value_) <=> 0;
    }
    friend Rational abs(const Rational& a) { return a.sign() < 0 ? -a : a; }
    friend std::ostream& operator<<(std::ostream& out, const Rational& a) {
        return out << a.value_.get_str();
    }

  private:
    mpq_class value_;
};

}  // namespace octavo::tests
