// SPDX-License-Identifier: Apache-2.0
#include "interruption.hpp"

#include <csignal>

#include <unistd.h>

namespace octavo::cli {
namespace {

std::atomic<bool> interrupted{false};
volatile std::sig_atomic_t first_signal = 0;
static_assert(std::atomic<bool>::is_always_lock_free, "else a signal handler may not set it");

constexpr int stopping[] = {SIGINT, SIGTERM, SIGHUP};

extern "C" void on_alarm(int) { alarm(1); }

extern "C" void on_stopping_signal(int signal) {
    if (first_signal == 0) first_signal = signal;
    interrupted.store(true, std::memory_order_relaxed);
    for (const int each : stopping) std::signal(each, SIG_DFL);
    alarm(1);
}

/// Without SA_RESTART: calls that wait end with EINTR.
void handle(int signal, void (*handler)(int)) {
    struct sigaction action {};
    action.sa_handler = handler;
    sigemptyset(&action.sa_mask);
    sigaction(signal, &action, nullptr);
}

bool is_ignored(int signal) {
    struct sigaction action {};
    return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

}  // namespace

void heed_signals() {
    if (interrupted) return;
    handle(SIGALRM, on_alarm);
    for (const int signal : stopping)
        if (signal == SIGINT || !is_ignored(signal)) handle(signal, on_stopping_signal);
}

const std::atomic<bool>& interruption() { return interrupted; }

ExitCode exit_code_of_interruption() {
    return first_signal == SIGTERM  ? ExitCode::terminated
           : first_signal == SIGHUP ? ExitCode::hung_up
                                    : ExitCode::interrupted;
}

}  // namespace octavo::cli
