// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>
#include <octavo/io/write.hpp>
#include <octavo/octree/octree.hpp>

// .oct files: the bytes of octree/oct_format.hpp on disk.

namespace octavo::io {

/// Reads the file `path`, or standard input when it is "-". Fails with ErrorCode::bad_input when it is not
/// exactly what a writer makes, and io when the system refuses.
Result<octree::Octree> read_octree(const std::string& path, const Context& context = {});

/// Writes the file `path`, or standard output when it is "-"; the file appears whole or not at all.
Result<WriteReport> write_octree(const std::string& path, const octree::Octree& octree,
                                 const Context& context = {});

}  // namespace octavo::io
