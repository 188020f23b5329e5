// SPDX-License-Identifier: Apache-2.0
#include <map>
#include <random>

#include <gtest/gtest.h>

#include <octavo/bsp/numbering.hpp>

namespace octavo::bsp {
namespace {

TEST(Numbering, CountsValuesInTheOrderOfTheirFirstUse) {
    Numbering numbering;
    std::mt19937 random(1);
    for (int round = 0; round < 200; ++round) {
        numbering.clear();
        std::map<std::uint32_t, std::uint32_t> expected;
        // Few values, often repeated, and now and then more than the table was made for.
        const auto most = static_cast<std::uint32_t>(round % 20 == 0 ? 5000 : 40);
        for (std::uint32_t i = 0; i < 3 * most; ++i) {
            const std::uint32_t drawn = random() % most;
            const std::uint32_t value = round % 2 ? drawn * 256 : ~drawn;  // as constructed vertices are
            const auto [at, is_new] = expected.emplace(value, static_cast<std::uint32_t>(expected.size()));
            ASSERT_EQ(numbering(value), at->second);
            ASSERT_EQ(numbering.values()[at->second], value);
        }
        ASSERT_EQ(numbering.values().size(), expected.size());
    }
}

}  // namespace
}  // namespace octavo::bsp
