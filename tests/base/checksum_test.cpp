// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include <octavo/base/bytes.hpp>
#include <octavo/base/checksum.hpp>

namespace octavo {
namespace {

std::vector<std::uint8_t> raw_bytes_of(std::string_view text) { return {text.begin(), text.end()}; }

TEST(Checksum, IsTheOneOfZlibAndPng) {
    EXPECT_EQ(crc32_of(raw_bytes_of("123456789")), 0xCBF43926U);
    EXPECT_EQ(crc32_of({}), 0U);
}

TEST(Checksum, TakesItsOwnPlaceAsZero) {
    const std::vector<std::uint8_t> bytes = raw_bytes_of("some twenty bytes...");
    for (std::size_t own = 0; own + 4 <= bytes.size(); ++own) {
        std::vector<std::uint8_t> zeroed = bytes;
        std::fill_n(zeroed.begin() + static_cast<std::ptrdiff_t>(own), 4, std::uint8_t{0});
        EXPECT_EQ(crc32_around(bytes, own), crc32_of(zeroed)) << own;
    }
}

TEST(Bytes, StoreTheLowByteFirstAndLoadItBack) {
    std::array<std::uint8_t, 8> bytes{};
    store(bytes.data(), std::int32_t{-2});
    EXPECT_EQ(bytes, (std::array<std::uint8_t, 8>{0xFE, 0xFF, 0xFF, 0xFF, 0, 0, 0, 0}));
    EXPECT_EQ(load<std::int32_t>(bytes.data()), -2);
    store(bytes.data(), std::uint64_t{0x0102030405060708});
    EXPECT_EQ(bytes[0], 0x08);
    EXPECT_EQ(load<std::uint64_t>(bytes.data()), 0x0102030405060708U);
    EXPECT_EQ(load<std::uint16_t>(&bytes[6]), 0x0102);
}

}  // namespace
}  // namespace octavo
