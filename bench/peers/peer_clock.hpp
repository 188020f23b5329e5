// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <cstring>
#include <ctime>
#include <fstream>
#include <string>

// CPU time and peak memory of a stretch of a program (Linux): other programs on the machine do not count.

namespace octavo::bench {

struct Usage {
    double seconds = 0;    ///< CPU time of all threads of the process
    double megabytes = 0;  ///< the highest resident size reached, above that at the start
};

inline double cpu_seconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// A line such as "VmHWM:  1234 kB" of the process's status, in megabytes.
inline double status_megabytes(const char* key) {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.rfind(key, 0) == 0) return std::stod(line.substr(std::strlen(key) + 1)) / 1024;
    return 0;
}

class Stopwatch {
  public:
    Stopwatch() {
        std::ofstream("/proc/self/clear_refs") << 5;  // the high-water mark starts again from here
        resident_ = status_megabytes("VmRSS");
        start_ = cpu_seconds();
    }
    Usage stop() const {
        const double seconds = cpu_seconds() - start_;
        return {seconds, status_megabytes("VmHWM") - resident_};
    }

  private:
    double resident_ = 0, start_ = 0;
};

}  // namespace octavo::bench
