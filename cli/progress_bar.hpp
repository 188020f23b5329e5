// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <mutex>
#include <string>
#include <string_view>

// Shows on stderr what a long computation is doing: a bar on a terminal, a line a phase elsewhere. Nothing appears
// for work that ends within a fifth of a second.

namespace octavo::cli {

enum class ProgressStyle { none, bar, plain };

class ProgressBar {
  public:
    /// `colored` allows escape sequences beyond those that redraw the line.
    ProgressBar(ProgressStyle style, bool colored) : style_(style), colored_(colored) {}
    ~ProgressBar() { clear(); }
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    /// Called from any thread with `done` in [0, 1].
    void show(std::string_view phase, double done);

    /// Removes the bar, so that other text can be printed.
    void clear();

  private:
    using Clock = std::chrono::steady_clock;

    void draw(std::string_view phase, double done, Clock::time_point now);

    ProgressStyle style_;
    bool colored_;
    std::mutex mutex_;
    std::string phase_;
    bool visible_ = false;
    Clock::time_point start_ = Clock::now(), drawn_{};
};

}  // namespace octavo::cli
