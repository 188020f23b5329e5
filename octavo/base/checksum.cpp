// SPDX-License-Identifier: Apache-2.0
#include <array>

#include <zlib.h>

#include <octavo/base/check.hpp>
#include <octavo/base/checksum.hpp>

namespace octavo {
namespace {

uLong append(uLong crc, std::span<const std::uint8_t> bytes) {
    // A null pointer would start anew.
    return bytes.empty() ? crc : crc32_z(crc, bytes.data(), bytes.size());
}

}  // namespace

std::uint32_t crc32_of(std::span<const std::uint8_t> bytes) {
    return static_cast<std::uint32_t>(append(0, bytes));
}

std::uint32_t crc32_around(std::span<const std::uint8_t> bytes, std::size_t own) {
    constexpr std::array<std::uint8_t, 4> zeros{};
    OCTAVO_CHECK(own + zeros.size() <= bytes.size(), "the checksum's place lies within the bytes");
    const uLong crc = append(append(0, bytes.first(own)), zeros);
    return static_cast<std::uint32_t>(append(crc, bytes.subspan(own + zeros.size())));
}

}  // namespace octavo
