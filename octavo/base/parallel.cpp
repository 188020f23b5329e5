// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#if defined(__SANITIZE_THREAD__)
#include <atomic>
#include <thread>
#else
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#endif

#include <octavo/base/parallel.hpp>

namespace octavo {

#if defined(__SANITIZE_THREAD__)

void within_threads(const Context&, FunctionRef<void()> body) { body(); }

void run_tasks(std::size_t count, FunctionRef<void(std::size_t)> body) {
    std::atomic<std::size_t> next{0};
    const auto work = [&] {
        for (std::size_t task = next++; task < count; task = next++) body(task);
    };
    std::thread helper(work);
    work();
    helper.join();
}

#else

void within_threads(const Context& context, FunctionRef<void()> body) {
    // More threads than the machine runs at a time are slower, and oneTBB warns of them on standard error. As many as
    // it runs are there anyhow: an arena of their own would begin asleep. A loop within another one has its threads.
    if (context.threads == 0 || context.threads >= tbb::this_task_arena::max_concurrency()) return body();
    tbb::task_arena arena(context.threads);
    arena.execute(body);
}

void run_tasks(std::size_t count, FunctionRef<void(std::size_t)> body) {
    tbb::parallel_for(std::size_t{0}, count, body);
}

#endif

void parallel_chunks(const Context& context, std::size_t count, std::size_t grain,
                     FunctionRef<void(std::size_t, std::size_t)> body) {
    const std::size_t chunks = (count + grain - 1) / grain;
    const auto run = [&](std::size_t chunk) {
        if (context.cancelled()) return;
        const std::size_t begin = chunk * grain;
        body(begin, std::min(begin + grain, count));
    };
    if (context.threads == 1 || chunks <= 1) {
        for (std::size_t chunk = 0; chunk < chunks; ++chunk) run(chunk);
        return;
    }
    within_threads(context, [&] { run_tasks(chunks, run); });
}

}  // namespace octavo
