// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

// Stdin, stdout and stderr of the program.

namespace octavo::cli {

/// Writes `text` to stdout. False where it is not taken (closed, full), or where the work was asked to stop while
/// nobody took it.
bool to_stdout(std::string_view text);

/// Writes `text` to stderr. What stderr does not take (closed, full) is lost: there is nobody left to tell, and neither
/// the work nor the exit code depends on it.
void to_stderr(std::string_view text);

/// Opens stdin, stdout and stderr on nothing where the caller closed them: else the next file that is opened would get
/// their number, and a message would be written into a model.
void hold_standard_files();

}  // namespace octavo::cli
