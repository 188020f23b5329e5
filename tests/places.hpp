// SPDX-License-Identifier: Apache-2.0
#pragma once

// Where this build lies. The two paths are defined in one small generated source rather than on every
// compiler's command line, so that two checkouts share what a compiler cache holds of the tests.

namespace octavo::tests {

/// The root of the checkout that the tests were built from.
extern const char* const source_folder;

/// The command line tool of the same build.
extern const char* const program;

}  // namespace octavo::tests
