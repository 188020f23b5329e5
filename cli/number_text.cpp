// SPDX-License-Identifier: Apache-2.0
#include "number_text.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace octavo::cli {
namespace {

constexpr int digits = 7;
// Beyond these, zeros would hide the number; 2^53 < 1e16.
constexpr double smallest_plain = 1e-4, largest_plain = 1e15;

/// The decimal exponent of a positive number once it is rounded to `digits`: 9.9999999 counts as 10.
int exponent_of(double magnitude) {
    const std::string text = fmt::format("{:.{}e}", magnitude, digits - 1);
    return std::stoi(text.substr(text.find('e') + 1));
}

std::string without_trailing_zeros(std::string text) {
    if (text.find('.') == std::string::npos) return text;
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text;
}

}  // namespace

std::string number_text(double value, double scale) {
    if (!std::isfinite(value)) return fmt::format("{}", value);
    if (!std::isfinite(scale)) scale = value;
    scale = std::max(std::fabs(scale), std::fabs(value));
    if (scale == 0) return "0";
    const int decimals = digits - 1 - exponent_of(scale);
    // Scientific where the number itself asks for it, still rounded where the scale says.
    const double magnitude = std::fabs(value);
    if (scale >= largest_plain || scale < smallest_plain) {
        const int kept = magnitude == 0 ? -1 : std::min(digits - 1, decimals + exponent_of(magnitude));
        if (kept < 0) return "0";
        const std::string text = fmt::format("{:.{}e}", value, kept);
        const std::size_t exponent = text.find('e');
        return without_trailing_zeros(text.substr(0, exponent)) + text.substr(exponent);
    }
    const std::string fixed =
        without_trailing_zeros(fmt::format("{:.{}f}", magnitude, std::max(decimals, 0)));
    if (fixed == "0") return fixed;
    const std::size_t point = std::min(fixed.find('.'), fixed.size());
    return (value < 0 ? "-" : "") + grouped(std::stoull(fixed.substr(0, point))) + fixed.substr(point);
}

std::string vector_text(Vec3 v, double scale) {
    return number_text(v.x, scale) + ", " + number_text(v.y, scale) + ", " + number_text(v.z, scale);
}

std::string vector_text(Vec3 v) {
    return vector_text(v, std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}));
}

}  // namespace octavo::cli
