// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/base/result.hpp>

// What the program returns to the shell. Scripts rely on these numbers.

namespace octavo::cli {

enum class ExitCode : int {
    ok = 0,
    no = 1,         ///< the answer is "no": not a solid, does not collide …
    usage = 2,      ///< the command line is wrong
    bad_input = 3,  ///< an input file is
    limit = 4,      ///< a size, depth or memory limit was reached
    internal = 5,   ///< a defect of Octavo
    // 128 and the number of the signal that ended the work.
    hung_up = 129,      ///< SIGHUP
    interrupted = 130,  ///< Ctrl-C
    terminated = 143,   ///< SIGTERM
};

inline ExitCode exit_code_of(ErrorCode code) {
    switch (code) {
        case ErrorCode::bad_input:
        case ErrorCode::not_a_solid:
        case ErrorCode::unsupported:
        case ErrorCode::io:
            return ExitCode::bad_input;
        case ErrorCode::limit:
            return ExitCode::limit;
        case ErrorCode::cancelled:
            return ExitCode::interrupted;
        case ErrorCode::internal:
            break;
    }
    return ExitCode::internal;
}

/// The word for an error in `--json`.
inline const char* name_of(ErrorCode code) {
    switch (code) {
        case ErrorCode::bad_input:
            return "bad_input";
        case ErrorCode::not_a_solid:
            return "not_a_solid";
        case ErrorCode::unsupported:
            return "unsupported";
        case ErrorCode::io:
            return "io";
        case ErrorCode::limit:
            return "limit";
        case ErrorCode::cancelled:
            return "cancelled";
        case ErrorCode::internal:
            break;
    }
    return "internal";
}

}  // namespace octavo::cli
