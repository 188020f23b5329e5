// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "verb.hpp"

// Checks of option values that say in words what is wanted and what was given.

namespace octavo::cli {

/// A positive, finite number; not-a-number is neither.
std::string check_positive(const std::string& text);

/// A number greater than 0, at most 1.
std::string check_part(const std::string& text);

/// A whole number from `least` to `most`.
OptionCheck whole_number(std::int64_t least, std::int64_t most);

/// A number from `least` to `most`.
OptionCheck number_between(double least, double most);

/// A count such as 300, 2K, 50M or 1.5G (thousands, millions, milliards), at least 1; nothing when it is not one.
std::optional<std::uint64_t> parse_count(const std::string& text);
std::string check_count(const std::string& text);

/// The option takes one of these words; help and shell completion show them.
Option* take_one_of(Option* option, const std::vector<std::string>& words);

}  // namespace octavo::cli
