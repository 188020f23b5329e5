// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

// Integers in bytes as Octavo's own files have them: little-endian, at any alignment, on any machine.

namespace octavo {

template <class Integer>
void put(std::uint8_t* at, Integer value) {
    for (std::size_t i = 0; i < sizeof(Integer); ++i)
        at[i] = static_cast<std::uint8_t>(static_cast<std::uint64_t>(value) >> (8 * i));
}

template <class Integer>
Integer get(const std::uint8_t* at) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < sizeof(Integer); ++i) value |= static_cast<std::uint64_t>(at[i]) << (8 * i);
    return static_cast<Integer>(value);
}

}  // namespace octavo
