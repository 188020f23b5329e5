// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <octavo/base/context.hpp>

// Parallel loops on oneTBB within the threads that a Context allows. The chunks depend on `count` and `grain`
// only, never on the number of threads, so that a loop that writes by chunk gives the same bytes for any
// number of them.

namespace octavo {

/// Calls `body()` so that oneTBB work started inside uses at most the threads of `context`.
template <class Body>
void within_threads(const Context& context, const Body& body) {
    if (context.threads == 0) {
        body();
    } else {
        tbb::task_arena arena(context.threads);
        arena.execute(body);
    }
}

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
    within_threads(context, [&] { tbb::parallel_for(std::size_t{0}, chunks, run); });
}

}  // namespace octavo
