// SPDX-License-Identifier: Apache-2.0
#include <atomic>
#include <vector>

#include <gtest/gtest.h>

#include <octavo/base/parallel.hpp>

namespace octavo {
namespace {

TEST(ParallelChunks, VisitsEveryIndexOnceForAnyNumberOfThreads) {
    for (const int threads : {0, 1, 2, 5}) {
        Context context;
        context.threads = threads;
        std::vector<std::atomic<int>> visits(1003);
        parallel_chunks(context, visits.size(), 10, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) ++visits[i];
        });
        for (const std::atomic<int>& count : visits) ASSERT_EQ(count.load(), 1);
    }
}

TEST(ParallelChunks, SkipsTheRestOnceCancelled) {
    std::atomic<bool> cancel{false};
    Context context;
    context.threads = 1;
    context.cancel = &cancel;
    int chunks = 0;
    parallel_chunks(context, 100, 10, [&](std::size_t, std::size_t) {
        if (++chunks == 3) cancel = true;
    });
    EXPECT_EQ(chunks, 3);
}

}  // namespace
}  // namespace octavo
