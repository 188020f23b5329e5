// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include <octavo/base/context.hpp>
#include <octavo/base/function_ref.hpp>

// Parallel loops on oneTBB within the threads that a Context allows. The chunks depend on `count` and `grain`
// only, never on the number of threads, so that a loop that writes by chunk gives the same bytes for any
// number of them.
//
// oneTBB stays in the source file: its headers and templates took a third of the time to compile whatever has a loop.
// The price is an indirect call a task, so tasks do more than a few nanoseconds' work.
//
// Under ThreadSanitizer the loops run on std::thread instead: oneTBB's library is not instrumented, so every
// hand-over through it would be reported, and suppressing those would hide the races that matter.

namespace octavo {

/// Calls `body()` so that tasks started inside use at most the threads of `context`.
void within_threads(const Context& context, FunctionRef<void()> body);

/// Calls `body(task)` for the tasks 0 … count − 1, at the same time as far as the threads allow. For use inside
/// `within_threads`; may be nested.
void run_tasks(std::size_t count, FunctionRef<void(std::size_t)> body);

/// Calls `body(begin, end)` for the chunks [0, grain), [grain, 2 grain) … of [0, count), in any order. One
/// thread runs them in order, without oneTBB. Chunks not yet begun are skipped once the context is cancelled.
void parallel_chunks(const Context& context, std::size_t count, std::size_t grain,
                     FunctionRef<void(std::size_t, std::size_t)> body);

}  // namespace octavo
