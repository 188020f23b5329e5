// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdlib>

namespace octavo::tests {

/// How hard tests with random input try, as a multiple of what is usual: $OCTAVO_TEST_EFFORT, 1 by default. From 10 on,
/// tests that take minutes run too.
inline int effort() {
    const char* text = std::getenv("OCTAVO_TEST_EFFORT");
    return text ? std::max(1, std::atoi(text)) : 1;
}

}  // namespace octavo::tests
