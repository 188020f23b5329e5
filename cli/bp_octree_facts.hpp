// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <octavo/bp_octree/bpo_reader.hpp>

#include "session.hpp"

// What `build` and `stats` tell about a BP-octree: the same keys, the same table.

namespace octavo::cli {

struct BpOctreeFacts {
    std::vector<bp_octree::LevelFigures> levels;
    std::vector<std::uint64_t> bytes_to_level;  ///< as in bpo_format.hpp
    std::uint64_t bytes = 0;                    ///< of the whole file
    bool is_solid = true;
    double solid_volume = 0;
    int depth = 0;
    std::uint64_t nodes = 0, planes = 0, triangles = 0, vertices = 0;
    std::optional<std::uint64_t> references;  ///< of leaves to triangles; files do not tell
};

/// Of a tree and the bytes that `encode` made of it.
BpOctreeFacts facts_of(const bp_octree::BpOctree& tree, std::span<const std::uint8_t> bytes);
/// Of a file, by its head and index.
BpOctreeFacts facts_of(const bp_octree::BpoReader& reader);

/// format ("bpo"), depth, levels with their planes, volumes and bytes, leaves, planes, triangles, volume, bytes and
/// closed.
Json json_of(const BpOctreeFacts& facts);

/// The same for people, with a line for each level.
std::string text_of(const BpOctreeFacts& facts);

}  // namespace octavo::cli
