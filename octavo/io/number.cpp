// SPDX-License-Identifier: Apache-2.0
#include <charconv>
#include <limits>

#include <octavo/io/number.hpp>

namespace octavo::io {
namespace {

/// Whether the decimal number in [first, last), known to be out of the range of doubles, is a large one: the
/// sign of the power of ten of its first digit that is not zero.
bool is_large(const char* first, const char* last) {
    std::int64_t power = 0;
    bool seen_point = false;
    bool seen_digit = false;
    const char* p = first;
    for (; p != last && (*p == '.' || (*p >= '0' && *p <= '9')); ++p) {
        if (*p == '.') {
            seen_point = true;
        } else if (*p != '0' || seen_digit) {
            seen_digit = true;
            if (!seen_point) ++power;
        } else if (seen_point) {
            --power;
        }
    }
    std::int64_t exponent = 0;
    if (p != last && (*p == 'e' || *p == 'E')) {
        ++p;
        const bool down = p != last && *p == '-';
        if (p != last && (*p == '-' || *p == '+')) ++p;
        constexpr std::int64_t saturated = std::int64_t{1} << 60;
        for (; p != last && *p >= '0' && *p <= '9'; ++p)
            if (exponent < saturated / 16) exponent = exponent * 10 + (*p - '0');
        if (down) exponent = -exponent;
    }
    return power + exponent > 0;
}

}  // namespace

ParsedNumber detail::parse_number_exactly(const char* first, const char* last) {
    const char* p = first;
    const bool negative = p != last && *p == '-';
    if (p != last && (*p == '-' || *p == '+')) ++p;
    if (p == last || *p == '-' || *p == '+') return {};
    double value = 0;
    const std::from_chars_result result = std::from_chars(p, last, value, std::chars_format::general);
    if (result.ec == std::errc::invalid_argument) return {};
    if (result.ec == std::errc::result_out_of_range)
        value = is_large(p, result.ptr) ? std::numeric_limits<double>::infinity() : 0.0;
    return {negative ? -value : value, result.ptr};
}

char* write_number(char* first, double value) {
    return std::to_chars(first, first + longest_number, value).ptr;
}

char* write_number(char* first, std::uint64_t value) {
    return std::to_chars(first, first + longest_number, value).ptr;
}

std::string number_text(double value) {
    char text[longest_number];
    return {text, write_number(text, value)};
}

}  // namespace octavo::io
