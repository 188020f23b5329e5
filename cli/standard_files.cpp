// SPDX-License-Identifier: Apache-2.0
#include "standard_files.hpp"

#include <cerrno>
#include <cstdio>

#include <fcntl.h>
#include <unistd.h>

#include "interruption.hpp"

namespace octavo::cli {

bool to_stdout(std::string_view text) {
    while (!text.empty()) {
        const ssize_t written = ::write(STDOUT_FILENO, text.data(), text.size());
        if (written < 0 && (errno != EINTR || interruption())) return false;
        if (written > 0) text.remove_prefix(static_cast<std::size_t>(written));
    }
    return true;
}

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
