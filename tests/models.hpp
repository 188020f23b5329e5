// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>
#include <places.hpp>

// Real models for tests. They are not part of the project: $OCTAVO_MODELS names their folder, else
// ../shared/models beside the checkout is tried; a test that needs one skips, with a message, when it is not
// there.

namespace octavo::tests {

inline std::filesystem::path models_folder() {
    if (const char* folder = std::getenv("OCTAVO_MODELS")) return folder;
    return std::filesystem::path(source_folder) / ".." / "shared" / "models";
}

}  // namespace octavo::tests

/// Skips the test unless the real model `name` (for example "classic/homer.off") is there.
#define OCTAVO_NEEDS_MODEL(name)                                           \
    if (!std::filesystem::exists(octavo::tests::models_folder() / (name))) \
    GTEST_SKIP() << "the model " << (name) << " is not on this machine (set OCTAVO_MODELS)"
