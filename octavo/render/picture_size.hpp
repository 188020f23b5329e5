// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <octavo/base/result.hpp>

namespace octavo::render {

/// Pixels of a picture's side at most.
constexpr int largest_picture = 16384;

/// Error: bad_input for a picture that no engine draws.
inline Status check_size(int width, int height) {
    if (width >= 1 && height >= 1 && width <= largest_picture && height <= largest_picture) return Done{};
    return Error{ErrorCode::bad_input,
                 "a picture must be 1 to " + std::to_string(largest_picture) + " pixels wide and high, not " +
                     std::to_string(width) + " by " + std::to_string(height),
                 {}};
}

}  // namespace octavo::render
