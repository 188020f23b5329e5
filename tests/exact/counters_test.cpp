// SPDX-License-Identifier: Apache-2.0
#include <atomic>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include <octavo/exact/compare.hpp>
#include <octavo/exact/side.hpp>

namespace octavo::exact {
namespace {

TEST(Counters, TellTheFilterFromTheExactPath) {
    const Plane x = Plane::across_axis(0, 10), y = Plane::across_axis(1, 20), z = Plane::across_axis(2, 30);
    const TriplePoint point = *intersect(x, y, z);
    const PredicateCounts before = predicate_counts();
    EXPECT_EQ(side_of(x, point), Sign::zero);
    EXPECT_EQ(side_of(Plane::across_axis(0, 1000), point), Sign::negative);
    EXPECT_EQ(side_of(Plane::across_axis(0, 2000), point), Sign::negative);
    EXPECT_EQ(compare(point, Point{10, 20, 30}), Sign::zero);
    const PredicateCounts counts = predicate_counts() - before;
    EXPECT_EQ(counts.of(Predicate::side_of_plane).exact, 1u);
    EXPECT_EQ(counts.of(Predicate::side_of_plane).filtered, 2u);
    EXPECT_EQ(counts.of(Predicate::compare).exact, 3u);
    EXPECT_EQ(counts.exact(), 4u);
    EXPECT_EQ(counts.filtered(), 2u);
}

TEST(Counters, SumOverThreadsThatLiveAndThatEnded) {
    constexpr int threads = 4, calls = 10'000;
    const PredicateCounts before = predicate_counts();
    std::atomic<int> counted{0};
    std::atomic<bool> leave{false};
    std::vector<std::thread> workers;
    for (int i = 0; i < threads; ++i)
        workers.emplace_back([&] {
            for (int call = 0; call < calls; ++call) {
                count_filtered(Predicate::linear_form);
                if (call % 10 == 0) count_exact(Predicate::linear_form);
            }
            ++counted;
            while (!leave) std::this_thread::yield();
        });
    while (counted < threads) {
        const PredicateCounts during = predicate_counts() - before;  // must be legal while others count
        EXPECT_LE(during.filtered(), std::uint64_t{threads * calls});
    }
    const PredicateCounts living = predicate_counts() - before;
    EXPECT_EQ(living.of(Predicate::linear_form).filtered, std::uint64_t{threads * calls});
    leave = true;
    for (std::thread& worker : workers) worker.join();
    const PredicateCounts ended = predicate_counts() - before;
    EXPECT_EQ(ended.of(Predicate::linear_form).filtered, std::uint64_t{threads * calls});
    EXPECT_EQ(ended.of(Predicate::linear_form).exact, std::uint64_t{threads * calls / 10});
}

}  // namespace
}  // namespace octavo::exact
