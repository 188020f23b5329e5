// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>

#include "exit_code.hpp"

// How whoever started the program stops it: Ctrl-C, SIGTERM (kill, the shutdown of a machine) and SIGHUP (a terminal
// that was closed) ask the work to stop, which then leaves no file half written. A second one ends the program at once.
//
// Calls that wait, for a pipe or a terminal, are interrupted rather than started again, and whoever called them asks
// the flag. A signal that comes between asking and waiting would be lost; so an alarm follows it every second.

namespace octavo::cli {

/// From here on the three signals are heard. One that is ignored stays ignored (nohup), but for Ctrl-C, which shells
/// turn off for what runs in the background of a script.
void heed_signals();

/// Set once one of them came.
const std::atomic<bool>& interruption();

/// What the program then returns: 128 and the number of the signal, as shells have it.
ExitCode exit_code_of_interruption();

}  // namespace octavo::cli
