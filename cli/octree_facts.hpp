// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session.hpp"
#include <octavo/octree/octree.hpp>

// What `octree` and `stats` tell about a classic octree: the same keys, the same table.

namespace octavo::cli {

/// depth, leaves, white, black, gray, nodes, volume_lower, volume_upper, cell_size, bytes and levels.
Json json_of(const octree::Octree& tree, std::size_t file_bytes);

/// The same for people, with a line for each level.
std::string text_of(const octree::Octree& tree, std::size_t file_bytes);

}  // namespace octavo::cli
