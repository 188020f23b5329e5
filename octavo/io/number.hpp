// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>

// Decimal text to the nearest double and back. Every number of every text format goes through here, because
// exactness begins here: a coordinate is rounded once, to the double nearest to its decimals, and written as
// the shortest decimals that give the same double again.
//
// Idea: up to 19 digits are gathered in an integer. When it fits 53 bits and the power of ten is at most 22,
// both are exact doubles and one multiplication or division rounds correctly (Clinger, "How to Read Floating
// Point Numbers Accurately", 1990); that covers what exporters of floats write. Everything else goes to
// std::from_chars, which is exact too (Eisel and Lemire, 2021). No locale is ever asked.
// Cost: about 1 ns a character.

namespace octavo::io {

/// What parse_number found at the start of a text.
struct ParsedNumber {
    double value = 0;
    const char* end = nullptr;  ///< one past the number; nullptr when the text does not begin with one
};

namespace detail {
ParsedNumber parse_number_exactly(const char* first, const char* last);

inline constexpr std::array<double, 23> powers_of_ten{1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                      1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                                      1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
}  // namespace detail

/// Reads the number at `first`: an optional sign, digits with an optional point, an optional exponent; also
/// `inf` and `nan` in any case. Too large becomes infinite and too small zero, as rounding to nearest says.
/// No space is skipped.
inline ParsedNumber parse_number(const char* first, const char* last) {
    const auto digit = [](char c) { return static_cast<unsigned>(c) - unsigned{'0'}; };
    const char* p = first;
    const bool negative = p != last && *p == '-';
    if (p != last && (*p == '-' || *p == '+')) ++p;

    std::uint64_t mantissa = 0;
    const char* const digits_begin = p;
    while (p != last && digit(*p) <= 9) mantissa = mantissa * 10 + digit(*p++);
    auto digits = p - digits_begin;
    int exponent = 0;
    if (p != last && *p == '.') {
        const char* const fraction = ++p;
        while (p != last && digit(*p) <= 9) mantissa = mantissa * 10 + digit(*p++);
        exponent = static_cast<int>(fraction - p);
        digits += p - fraction;
    }
    if (digits == 0 || digits > 19) return detail::parse_number_exactly(first, last);

    if (p != last && (*p == 'e' || *p == 'E')) {
        const char* q = p + 1;
        const bool down = q != last && *q == '-';
        if (q != last && (*q == '-' || *q == '+')) ++q;
        const char* const power_begin = q;
        int power = 0;
        while (q != last && digit(*q) <= 9 && power < 10000)
            power = power * 10 + static_cast<int>(digit(*q++));
        if (q != power_begin) {
            if (power >= 10000) return detail::parse_number_exactly(first, last);
            exponent += down ? -power : power;
            p = q;
        }
    }
    if (mantissa >> 53 != 0 || exponent < -22 || exponent > 22)
        return detail::parse_number_exactly(first, last);
    double value = static_cast<double>(mantissa);
    if (exponent < 0) {
        value /= detail::powers_of_ten[static_cast<std::size_t>(-exponent)];
    } else {
        value *= detail::powers_of_ten[static_cast<std::size_t>(exponent)];
    }
    return {negative ? -value : value, p};
}

/// Space that write_number needs.
inline constexpr int longest_number = 32;

/// Writes the shortest decimals that read back as `value`; returns one past the last character.
char* write_number(char* first, double value);
char* write_number(char* first, std::uint64_t value);

/// The same as a string, for messages.
std::string number_text(double value);

}  // namespace octavo::io
