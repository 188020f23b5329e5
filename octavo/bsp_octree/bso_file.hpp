// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>
#include <octavo/bsp_octree/bsp_octree.hpp>
#include <octavo/io/write.hpp>

// `.bso` files.

namespace octavo::bsp_octree {

/// Reads the file `path`, or standard input when it is "-". Errors: io, and those of decoding.
Result<BspOctree> read_bso(const std::string& path, const Context& context = {});

/// Writes under a temporary name and renames; "-" is standard output. Error: io, cancelled.
Result<io::WriteReport> write_bso(const std::string& path, const BspOctree& octree,
                                  const Context& context = {});

}  // namespace octavo::bsp_octree
