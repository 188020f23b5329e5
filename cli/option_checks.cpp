// SPDX-License-Identifier: Apache-2.0
#include "option_checks.hpp"

#include <charconv>
#include <cmath>

namespace octavo::cli {

std::string check_positive(const std::string& text) {
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool is_number = error == std::errc() && end == text.data() + text.size();
    return is_number && std::isfinite(number) && number > 0 ? "" : text + " is no positive, finite number";
}

}  // namespace octavo::cli
