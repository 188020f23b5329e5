// SPDX-License-Identifier: Apache-2.0
#include "laws.hpp"

#include <gtest/gtest.h>

#include "effort.hpp"

namespace octavo::boolean {
namespace {

std::vector<std::uint8_t> random_bytes(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::vector<std::uint8_t> bytes(26 + random() % 120);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
    return bytes;
}

TEST(Laws, HoldForOperandsMadeOfAnyBytes) {
    for (std::uint64_t seed = 0; seed < 100 * static_cast<std::uint64_t>(tests::effort()); ++seed)
        EXPECT_EQ(tests::broken_law(random_bytes(seed)), "") << "seed " << seed;
}

/// A part closes only because a vertex lies on an edge of another facet, and the tolerance reaches for that vertex.
TEST(Laws, HoldWhereAToleranceIsNearAVertexThatASurfaceClosesBy) {
    EXPECT_EQ(tests::broken_law(random_bytes(4569)), "");
}

}  // namespace
}  // namespace octavo::boolean
