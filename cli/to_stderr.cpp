// SPDX-License-Identifier: Apache-2.0
#include "to_stderr.hpp"

#include <cstdio>

#include <fcntl.h>
#include <unistd.h>

namespace octavo::cli {

void to_stderr(std::string_view text) { std::fwrite(text.data(), 1, text.size(), stderr); }

void hold_standard_files() {
    // Opened the wrong way round, so that using one still fails as it would have.
    const auto hold = [](int file, int direction) {
        return fcntl(file, F_GETFD) != -1 || open("/dev/null", direction) != -1;
    };
    // In this order, as each takes the lowest number that is free.
    (void)(hold(STDIN_FILENO, O_WRONLY) && hold(STDOUT_FILENO, O_RDONLY) && hold(STDERR_FILENO, O_RDONLY));
}

}  // namespace octavo::cli
