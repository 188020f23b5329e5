// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <mutex>
#include <string_view>

#include <octavo/base/context.hpp>

// How far a loop is whose steps end on several threads: each end is reported, from one thread at a time, as a Context
// wants it.

namespace octavo {

class SharedProgress {
  public:
    /// The loop leads from `begin` to `end` of the phase.
    SharedProgress(const Context& context, std::string_view phase, std::size_t steps, double begin = 0,
                   double end = 1)
        : context_(context), phase_(phase), steps_(steps), begin_(begin), end_(end) {}

    void step() {
        if (!context_.on_progress) return;
        const std::scoped_lock lock(mutex_);
        const double share = static_cast<double>(++done_) / static_cast<double>(steps_);
        context_.report(phase_, begin_ + (end_ - begin_) * share);
    }

  private:
    const Context& context_;
    std::string_view phase_;
    std::size_t steps_, done_ = 0;
    double begin_, end_;
    std::mutex mutex_;
};

/// The context of a part of the work, whose phases, from 0 to 1, are shown as one phase from `begin` to `end`. It must
/// not outlive `whole`.
inline Context part_of(const Context& whole, std::string_view phase, double begin, double end) {
    Context part = whole;
    if (whole.on_progress)
        part.on_progress = [&whole, phase, begin, end](std::string_view, double done) {
            whole.report(phase, begin + (end - begin) * done);
        };
    return part;
}

}  // namespace octavo
