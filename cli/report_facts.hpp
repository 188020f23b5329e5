// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/mesh/report.hpp>

#include "session.hpp"

// A validity report in the words of `--json`.

namespace octavo::cli {

/// valid, problems[{kind, error, count, faces, sentence}], closed, oriented, manifold, components, shells, cavities …
Json json_of(const mesh::Report& report);

}  // namespace octavo::cli
