// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#if defined(__SANITIZE_THREAD__)
#include <atomic>
#include <thread>
#else
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#endif

#include <octavo/base/context.hpp>

// Parallel loops on oneTBB within the threads that a Context allows. The chunks depend on `count` and `grain`
// only, never on the number of threads, so that a loop that writes by chunk gives the same bytes for any
// number of them.
//
// Under ThreadSanitizer the loops run on std::thread instead: oneTBB's library is not instrumented, so every
// hand-over through it would be reported, and suppressing those would hide the races that matter.

namespace octavo {

#if defined(__SANITIZE_THREAD__)

template <class Body>
void within_threads(const Context&, const Body& body) {
    body();
}

template <class Body>
void run_tasks(std::size_t count, const Body& body) {
    std::atomic<std::size_t> next{0};
    const auto work = [&] {
        for (std::size_t task = next++; task < count; task = next++) body(task);
    };
    std::thread helper(work);
    work();
    helper.join();
}

#else

/// Calls `body()` so that tasks started inside use at most the threads of `context`.
template <class Body>
void within_threads(const Context& context, const Body& body) {
    if (context.threads == 0) {
        body();
    } else {
        tbb::task_arena arena(context.threads);
        arena.execute(body);
    }
}

/// Calls `body(task)` for the tasks 0 … count − 1, at the same time as far as the threads allow. For use inside
/// `within_threads`; may be nested.
template <class Body>
void run_tasks(std::size_t count, const Body& body) {
    tbb::parallel_for(std::size_t{0}, count, body);
}

#endif

/// Calls `body(begin, end)` for the chunks [0, grain), [grain, 2 grain) … of [0, count), in any order. One
/// thread runs them in order, without oneTBB. Chunks not yet begun are skipped once the context is cancelled.
template <class Body>
void parallel_chunks(const Context& context, std::size_t count, std::size_t grain, const Body& body) {
    const std::size_t chunks = (count + grain - 1) / grain;
    const auto run = [&](std::size_t chunk) {
        if (context.cancelled()) return;
        const std::size_t begin = chunk * grain;
        body(begin, begin + grain < count ? begin + grain : count);
    };
    if (context.threads == 1 || chunks <= 1) {
        for (std::size_t chunk = 0; chunk < chunks; ++chunk) run(chunk);
        return;
    }
    within_threads(context, [&] { run_tasks(chunks, run); });
}

}  // namespace octavo
