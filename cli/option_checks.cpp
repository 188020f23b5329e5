// SPDX-License-Identifier: Apache-2.0
#include "option_checks.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include <fmt/format.h>

namespace octavo::cli {
namespace {

template <class Number>
std::optional<Number> parsed(const std::string& text) {
    Number number{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return number;
}

}  // namespace

std::string check_positive(const std::string& text) {
    const std::optional<double> number = parsed<double>(text);
    return number && std::isfinite(*number) && *number > 0
               ? ""
               : fmt::format("must be a positive, finite number, not {}", text);
}

std::string check_part(const std::string& text) {
    const std::optional<double> number = parsed<double>(text);
    return number && *number > 0 && *number <= 1
               ? ""
               : fmt::format("must be a part: more than 0 and at most 1, not {}", text);
}

OptionCheck whole_number(std::int64_t least, std::int64_t most) {
    return [=](const std::string& text) -> std::string {
        const std::optional<std::int64_t> number = parsed<std::int64_t>(text);
        if (number && *number >= least && *number <= most) return "";
        return fmt::format("must be a whole number from {} to {}, not {}", least, most, text);
    };
}

OptionCheck number_between(double least, double most) {
    return [=](const std::string& text) -> std::string {
        const std::optional<double> number = parsed<double>(text);
        if (number && *number >= least && *number <= most) return "";
        return fmt::format("must be a number from {} to {}, not {}", least, most, text);
    };
}

std::optional<std::uint64_t> parse_count(const std::string& text) {
    const std::size_t letter = text.empty() ? 0 : std::string_view("KMG").find(text.back());
    double unit = 1;
    std::string digits = text;
    if (!text.empty() && letter != std::string_view::npos) {
        unit = std::pow(1000.0, static_cast<double>(letter) + 1);
        digits.pop_back();
    }
    const std::optional<double> number = parsed<double>(digits);
    constexpr double most = 1e18;
    if (!number || !(*number * unit >= 1 && *number * unit <= most)) return std::nullopt;
    return static_cast<std::uint64_t>(*number * unit);
}

std::string check_count(const std::string& text) {
    return parse_count(text) ? "" : fmt::format("must be a count such as 500K, 20M or 1.5G, not {}", text);
}

Option* take_one_of(Option* option, const std::vector<std::string>& words) {
    std::string choices, sentence;
    for (std::size_t i = 0; i < words.size(); ++i) {
        choices += (i ? "|" : "") + words[i];
        sentence += (i == 0 ? "" : i + 1 == words.size() ? " or " : ", ") + words[i];
    }
    const OptionCheck check = [words, sentence](const std::string& text) -> std::string {
        if (std::find(words.begin(), words.end(), text) != words.end()) return "";
        return fmt::format("must be {}, not {}", sentence, text);
    };
    return option->check(check)->type_name(choices)->capture_default_str();
}

}  // namespace octavo::cli
