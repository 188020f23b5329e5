// SPDX-License-Identifier: Apache-2.0
#include <vector>

#include <gtest/gtest.h>

#include <octavo/boolean/balanced_chunks.hpp>

namespace octavo::boolean {
namespace {

using Bounds = std::vector<std::size_t>;

TEST(BalancedChunks, EndWhereTheyHoldEnough) {
    const std::vector<std::size_t> weights{1, 1, 1, 1, 9, 1, 5, 4, 2};
    const auto weight = [&](std::size_t element) { return weights[element]; };
    EXPECT_EQ(balanced_chunks(9, 3, 8, weight), (Bounds{0, 3, 4, 5, 7, 9})) << "9 is too much, and alone";
    EXPECT_EQ(balanced_chunks(9, 100, 100, weight), (Bounds{0, 9}));
    EXPECT_EQ(balanced_chunks(3, 1, 100, weight), (Bounds{0, 1, 2, 3}));
    EXPECT_EQ(balanced_chunks(0, 3, 8, weight), Bounds{0});
}

}  // namespace
}  // namespace octavo::boolean
