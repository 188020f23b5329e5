// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <cstring>

// Peak memory from a moment on, on Linux: what loading took before does not count.

namespace octavo::bench {

/// Megabytes of a line of /proc/self/status.
inline double memory_megabytes(const char* name) {
    double kilobytes = 0;
    if (std::FILE* file = std::fopen("/proc/self/status", "r")) {
        char line[256];
        while (std::fgets(line, sizeof line, file))
            if (std::strncmp(line, name, std::strlen(name)) == 0)
                std::sscanf(line + std::strlen(name), ": %lf", &kilobytes);
        std::fclose(file);
    }
    return kilobytes / 1024;
}

class PeakMemory {
  public:
    /// The peak begins anew.
    PeakMemory() {
        if (std::FILE* file = std::fopen("/proc/self/clear_refs", "w")) {
            std::fputs("5", file);
            std::fclose(file);
        }
        before_ = memory_megabytes("VmRSS");
    }
    /// Beyond what was there before.
    double megabytes() const { return memory_megabytes("VmHWM") - before_; }

  private:
    double before_;
};

}  // namespace octavo::bench
