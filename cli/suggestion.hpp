// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

// "Did you mean …?"

namespace octavo::cli {

/// The one of `known` that is most like `word`; empty when none is near.
std::string nearest_word(const std::string& word, std::span<const std::string> known);

}  // namespace octavo::cli
