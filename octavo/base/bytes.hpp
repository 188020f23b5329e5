// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <type_traits>

// Numbers in bytes of a stated order, at any alignment.

namespace octavo {

using Bytes = std::span<const std::byte>;

inline std::string_view text_of(Bytes bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}
inline Bytes bytes_of(std::string_view text) {
    return {reinterpret_cast<const std::byte*>(text.data()), text.size()};
}

namespace detail {
template <class T>
T byte_swapped(T value) {
    if constexpr (sizeof(T) == 1) {
        return value;
    } else if constexpr (sizeof(T) == 2) {
        return std::bit_cast<T>(__builtin_bswap16(std::bit_cast<std::uint16_t>(value)));
    } else if constexpr (sizeof(T) == 4) {
        return std::bit_cast<T>(__builtin_bswap32(std::bit_cast<std::uint32_t>(value)));
    } else {
        static_assert(sizeof(T) == 8);
        return std::bit_cast<T>(__builtin_bswap64(std::bit_cast<std::uint64_t>(value)));
    }
}
}  // namespace detail

/// From std::byte or std::uint8_t.
template <class T, std::endian order = std::endian::little, class Byte>
T load(const Byte* from) {
    static_assert(std::is_arithmetic_v<T> && sizeof(Byte) == 1);
    T value;
    std::memcpy(&value, from, sizeof value);
    return order == std::endian::native ? value : detail::byte_swapped(value);
}

template <class T, std::endian order = std::endian::little, class Byte>
void store(Byte* to, T value) {
    static_assert(std::is_arithmetic_v<T> && sizeof(Byte) == 1);
    if (order != std::endian::native) value = detail::byte_swapped(value);
    std::memcpy(to, &value, sizeof value);
}

}  // namespace octavo
