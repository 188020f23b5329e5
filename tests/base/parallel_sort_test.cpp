// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <octavo/base/parallel_sort.hpp>

namespace octavo {
namespace {

TEST(ParallelSort, IsWhatOneThreadSorts) {
    std::mt19937 random(1);
    for (const std::size_t count : {0U, 1U, 5U, 8192U, 8193U, 40000U, 131072U, 131073U, 300001U})
        for (const std::uint32_t values : {1U, 3U, 1000U, ~0U})
            for (const int threads : {0, 1, 2, 3}) {
                std::vector<std::pair<std::uint32_t, std::uint32_t>> list(count);
                for (auto& [first, second] : list)
                    first = static_cast<std::uint32_t>(random()) % values, second = random() % 4;
                auto expected = list;
                std::sort(expected.begin(), expected.end());
                Context context;
                context.threads = threads;
                parallel_sort(context, list);
                ASSERT_EQ(list, expected) << count << " of " << values << ", threads " << threads;
            }
}

TEST(ParallelSort, SortsByTheOrderAskedFor) {
    std::mt19937 random(2);
    std::vector<std::uint32_t> list(100000);
    for (std::uint32_t& value : list) value = static_cast<std::uint32_t>(random());
    parallel_sort({}, list, std::greater<>());
    EXPECT_TRUE(std::is_sorted(list.begin(), list.end(), std::greater<>()));
}

}  // namespace
}  // namespace octavo
