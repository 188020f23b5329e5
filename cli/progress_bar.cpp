// SPDX-License-Identifier: Apache-2.0
#include "progress_bar.hpp"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>

#include "standard_files.hpp"

namespace octavo::cli {
namespace {

using namespace std::chrono_literals;
constexpr auto patience = 200ms;  // quicker work needs no bar: it would only flicker
constexpr auto between_draws = 50ms;
constexpr int bar_width = 32;

}  // namespace

void ProgressBar::show(std::string_view phase, double done) {
    if (style_ == ProgressStyle::none) return;
    const std::lock_guard lock(mutex_);
    const Clock::time_point now = Clock::now();
    if (now - start_ < patience) return;
    const bool new_phase = phase != phase_;
    if (style_ == ProgressStyle::plain) {
        if (new_phase) to_stderr(fmt::format("octavo: {} …\n", phase));
    } else if (new_phase || now - drawn_ >= between_draws || done >= 1) {
        draw(phase, std::clamp(done, 0.0, 1.0), now);
    }
    if (new_phase) phase_ = phase;
}

void ProgressBar::draw(std::string_view phase, double done, Clock::time_point now) {
    const int filled = static_cast<int>(done * bar_width);
    std::string bar;
    for (int i = 0; i < bar_width; ++i) bar += i < filled ? "█" : "░";
    const double elapsed = std::chrono::duration<double>(now - start_).count();
    to_stderr(fmt::format("\r\x1b[K{}{:<22.22}{} {} {:3.0f} %  {:.1f} s", colored_ ? "\x1b[36m" : "", phase,
                          colored_ ? "\x1b[0m" : "", bar, done * 100, elapsed));
    std::fflush(stderr);
    visible_ = true;
    drawn_ = now;
}

void ProgressBar::clear() {
    const std::lock_guard lock(mutex_);
    if (visible_) to_stderr("\r\x1b[K");
    visible_ = false;
}

}  // namespace octavo::cli
