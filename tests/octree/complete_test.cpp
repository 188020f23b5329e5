// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <octavo/octree/complete.hpp>

namespace octavo::octree {
namespace {

TEST(Complete, FillsGapsWithTheLargestCells) {
    std::mt19937 random(7);
    for (int round = 0; round < 200; ++round) {
        // Some cells of a random tree.
        std::vector<CellKey> cells, open{CellKey::root()};
        while (!open.empty()) {
            const CellKey key = open.back();
            open.pop_back();
            if (key.level() < 5 && random() % 10 < 6)
                for (int i = 0; i < 8; ++i) open.push_back(key.child(i));
            else if (random() % 3 == 0)
                cells.push_back(key);
        }
        std::sort(cells.begin(), cells.end());
        const std::vector<CellKey> leaves = complete(cells);
        EXPECT_TRUE(std::is_sorted(leaves.begin(), leaves.end()));
        EXPECT_TRUE(std::includes(leaves.begin(), leaves.end(), cells.begin(), cells.end()));
        std::uint64_t covered = 0;
        for (std::size_t i = 0; i < leaves.size(); ++i) {
            covered += std::uint64_t{1} << 3 * (5 - leaves[i].level());
            if (i > 0) {
                ASSERT_LT(leaves[i - 1].last_descendant(), leaves[i].first_descendant());
            }
            // No larger leaf would do: the parent of one that is no cell has a cell in it.
            const bool is_cell = std::binary_search(cells.begin(), cells.end(), leaves[i]);
            if (is_cell || leaves[i].level() == 0) continue;
            const CellKey parent = leaves[i].parent();
            ASSERT_TRUE(
                std::any_of(cells.begin(), cells.end(), [&](CellKey c) { return parent.contains(c); }));
        }
        EXPECT_EQ(covered, std::uint64_t{1} << 15) << "they fill the universe";
    }
    EXPECT_EQ(complete({}), std::vector<CellKey>{CellKey::root()});
}

}  // namespace
}  // namespace octavo::octree
