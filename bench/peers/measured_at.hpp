// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>

// The head of a table of results: what was measured, when, and how busy the machine was.

namespace octavo::bench {

/// The first line that a command prints.
inline std::string line_of(const std::string& command) {
    std::array<char, 256> line{};
    if (std::FILE* pipe = popen(command.c_str(), "r")) {
        if (!std::fgets(line.data(), line.size(), pipe)) line[0] = 0;
        pclose(pipe);
    }
    std::string text = line.data();
    return text.substr(0, text.find('\n'));
}

/// The commit of the sources, with "-dirty" when they were changed.
inline std::string commit_of(const std::string& sources) {
    return line_of("git -C '" + sources + "' describe --always --dirty --abbrev=8 2>/dev/null");
}

/// "commit 1234abcd, 2026-11-22, g++ 12.2.0, load 0.9".
inline std::string measured_at(const std::string& sources) {
    std::array<char, 32> date{};
    const std::time_t now = std::time(nullptr);
    std::strftime(date.data(), date.size(), "%Y-%m-%d", std::gmtime(&now));
    std::array<double, 1> load{};
    std::array<char, 32> busy{};
    if (getloadavg(load.data(), 1) == 1) std::snprintf(busy.data(), busy.size(), ", load %.1f", load[0]);
    return "commit " + commit_of(sources) + ", " + date.data() + ", compiler " + __VERSION__ + busy.data();
}

}  // namespace octavo::bench
