// SPDX-License-Identifier: Apache-2.0
#pragma once

// The answer of every geometric predicate. Positive is: on the side that a plane's normal points to; counter-
// clockwise; greater.

namespace octavo::exact {

enum class Sign : int { negative = -1, zero = 0, positive = 1 };

constexpr Sign operator-(Sign sign) { return static_cast<Sign>(-static_cast<int>(sign)); }
constexpr Sign operator*(Sign first, Sign second) {
    return static_cast<Sign>(static_cast<int>(first) * static_cast<int>(second));
}

/// The sign of anything that compares with 0.
template <class Number>
constexpr Sign sign_of(const Number& number) {
    return static_cast<Sign>(static_cast<int>(number > 0) - static_cast<int>(number < 0));
}

}  // namespace octavo::exact
