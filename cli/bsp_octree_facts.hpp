// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <octavo/bsp_octree/bsp_octree.hpp>

#include "session.hpp"

// What `bsp` and `stats` say about a BSP-octree.

namespace octavo::cli {

/// `bytes` are those of the file.
void tell(Session& session, const bsp_octree::BspOctree& octree, std::uint64_t bytes);

}  // namespace octavo::cli
