// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

// The compilers' 128-bit integers under one name; they are no part of C++20, so strict builds need the word
// __extension__. A signed product of two 64-bit numbers is one instruction: widen one factor with `wide`.

namespace octavo::exact {

__extension__ typedef __int128 int128;
__extension__ typedef unsigned __int128 uint128;

constexpr int128 wide(std::int64_t number) { return number; }

}  // namespace octavo::exact
