// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

// Checks of option values that say in words what is wanted; an empty string is approval, as CLI11 has it.

namespace octavo::cli {

/// A positive, finite number; not-a-number is neither.
std::string check_positive(const std::string& text);

}  // namespace octavo::cli
