// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <octavo/base/bytes.hpp>
#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>
#include <octavo/base/vec3.hpp>

// Reads lists of poses, as milling takes them: text, a pose a line. Three numbers are where the tool's origin goes;
// twelve are the first three rows of a 4 × 4 matrix, row-major. Numbers are separated by commas, semicolons, tabs or
// spaces; a first line of names and comments from # to the end of a line are skipped.

namespace octavo::io {

/// Reads the file `path`, or standard input when it is "-". Errors: io; bad_input with the line, when a line has
/// another count of numbers or a number is not finite, or when there is no pose at all.
Result<std::vector<Affine>> read_poses(const std::string& path, const Context& context = {});
Result<std::vector<Affine>> read_poses(Bytes bytes, const Context& context = {});

}  // namespace octavo::io
