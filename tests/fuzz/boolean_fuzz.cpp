// SPDX-License-Identifier: Apache-2.0
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "boolean/laws.hpp"

// Set operations on operands made of any bytes; the laws that must hold are in the header.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 26) return 0;  // too little for two operands
    const std::string broken = octavo::tests::broken_law({data, size});
    if (broken.empty()) return 0;
    std::fprintf(stderr, "%s\n", broken.c_str());
    std::abort();
}
