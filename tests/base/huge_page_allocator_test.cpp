// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include <octavo/base/huge_page_allocator.hpp>

namespace octavo {
namespace {

struct alignas(64) Line {
    std::array<char, 64> bytes;
};

TEST(HugePageAllocator, AlignsWhatAsksForItInArraysOfAllSizes) {
    for (const std::size_t count : {1u, 2u, 3u, 5u, 100u, 1000u, 40'000u, 100'000u}) {
        const std::vector<Line, HugePageAllocator<Line>> lines(count);
        EXPECT_EQ(reinterpret_cast<std::uintptr_t>(lines.data()) % alignof(Line), 0u) << count;
    }
}

}  // namespace
}  // namespace octavo
