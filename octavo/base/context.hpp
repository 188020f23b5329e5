// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <functional>
#include <string_view>

#include <octavo/base/result.hpp>

// How a long computation talks to whoever started it: how many threads it may use, where it reports progress
// and how it learns that it should stop. Passed as `const Context&`, last, with a default. Results never
// depend on it.

namespace octavo {

struct Context {
    /// Threads to use; 0 is all of the machine's. The result is the same for any number.
    int threads = 0;

    /// Called now and then from any one thread at a time, with the name of the phase and how much of it is
    /// done, in [0, 1]. Must be quick.
    std::function<void(std::string_view phase, double done)> on_progress;

    /// Set it to true from anywhere (a signal handler too) and the work returns ErrorCode::cancelled soon.
    const std::atomic<bool>* cancel = nullptr;

    bool cancelled() const { return cancel && cancel->load(std::memory_order_relaxed); }
    void report(std::string_view phase, double done) const {
        if (on_progress) on_progress(phase, done);
    }

    static Error cancelled_error() { return {ErrorCode::cancelled, "cancelled", {}}; }
};

}  // namespace octavo
