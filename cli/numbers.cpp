// SPDX-License-Identifier: Apache-2.0
#include "numbers.hpp"

#include <charconv>
#include <cmath>

namespace octavo::cli {

std::optional<std::vector<double>> parse_numbers(std::string_view text) {
    std::vector<double> numbers;
    const char* at = text.data();
    const char* const end = at + text.size();
    while (true) {
        double number = 0;
        const auto [after, error] = std::from_chars(at, end, number);
        if (error != std::errc() || !std::isfinite(number)) return std::nullopt;
        numbers.push_back(number);
        if (after == end) return numbers;
        if (*after != ',') return std::nullopt;
        at = after + 1;
    }
}

}  // namespace octavo::cli
