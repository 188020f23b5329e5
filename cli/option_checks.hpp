// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

// Checks of option values that say in words what is wanted and what was given; an empty string is approval, as CLI11
// has it.

namespace octavo::cli {

using OptionCheck = std::function<std::string(const std::string&)>;

/// A positive, finite number; not-a-number is neither.
std::string check_positive(const std::string& text);

/// A whole number from `least` to `most`.
OptionCheck whole_number(std::int64_t least, std::int64_t most);

/// A number from `least` to `most`.
OptionCheck number_between(double least, double most);

/// The option takes one of these words; help and shell completion show them.
CLI::Option* take_one_of(CLI::Option* option, const std::vector<std::string>& words);

}  // namespace octavo::cli
