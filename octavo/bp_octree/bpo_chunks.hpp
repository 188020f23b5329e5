// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <octavo/bp_octree/bpo_layout.hpp>
#include <octavo/bp_octree/geometry_codec.hpp>

// The chunks of a .bpo file, each decoded on its own; docs/formats/bpo.md draws their bits.

namespace octavo::bp_octree {

/// The sentence after "the .bpo file is damaged: ".
Error damaged_bpo(std::string sentence, std::uint64_t byte);

/// Consecutive nodes of one level.
struct EnvelopeChunk {
    std::vector<octree::Node> nodes;
    std::vector<std::uint32_t> plane_begin{0};  ///< per node, and one past the last
    std::vector<BoundingPlane> planes;
    std::vector<std::int32_t> windings;  ///< per gray node; 0 for surfaces that are not closed
};

/// `bytes` are the chunk's, whose checksum is tested. Errors: bad_input.
Result<EnvelopeChunk> decode_envelope_chunk(const ChunkEntry& entry, std::span<const std::uint8_t> bytes,
                                            bool is_solid);

/// All triangles that meet some consecutive leaves.
struct TriangleChunk {
    DecodedGeometry geometry;
    std::vector<bool> is_new;  ///< per triangle: not in an earlier chunk
};

Result<TriangleChunk> decode_triangle_chunk(const ChunkEntry& entry, std::span<const std::uint8_t> bytes);

}  // namespace octavo::bp_octree
