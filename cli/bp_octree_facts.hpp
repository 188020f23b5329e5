// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include <octavo/bp_octree/bp_octree.hpp>

#include "session.hpp"

// What `build` and `stats` tell about a BP-octree: the same keys, the same table.

namespace octavo::cli {

/// format ("bpo"), depth, levels with their planes, volumes and bytes, leaves, planes, triangles, volume, bytes and closed.
/// `bytes_to_level` as in bpo_format.hpp, empty when there is no file.
Json json_of(const bp_octree::BpOctree& tree, std::span<const std::uint64_t> bytes_to_level,
             std::uint64_t file_bytes);

/// The same for people, with a line for each level.
std::string text_of(const bp_octree::BpOctree& tree, std::span<const std::uint64_t> bytes_to_level,
                    std::uint64_t file_bytes);

}  // namespace octavo::cli
