// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <octavo/octree/octree.hpp>

#include "session.hpp"

// What `octree`, `stats` and `info` tell about a classic octree: the same keys, the same table.

namespace octavo::cli {

/// The form in which a tree lies on disk, and its size there.
struct TreeFile {
    std::string format;
    std::size_t bytes = 0;
};

/// format, depth, leaves, white, black, gray, nodes, volume_lower, volume_upper, cell_size, bytes and levels.
Json json_of(const octree::Octree& tree, const TreeFile& file);

/// The same for people, with a line for each level.
std::string text_of(const octree::Octree& tree, const TreeFile& file);

}  // namespace octavo::cli
