// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>
#include <vector>

// Lists of numbers in option values.

namespace octavo::cli {

/// "1,2.5,-3": finite numbers with commas between them, nothing else; none when that is not what it is.
std::optional<std::vector<double>> parse_numbers(std::string_view text);

}  // namespace octavo::cli
