// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>

#include <octavo/base/bytes.hpp>
#include <octavo/base/checksum.hpp>
#include <octavo/bp_octree/bit_stream.hpp>
#include <octavo/bp_octree/bpo_chunks.hpp>

namespace octavo::bp_octree {

using octree::Node;

Error damaged_bpo(std::string sentence, std::uint64_t byte) {
    Error error{ErrorCode::bad_input, "the .bpo file is damaged: " + std::move(sentence), {}};
    error.place.byte = byte;
    return error;
}

Result<EnvelopeChunk> decode_envelope_chunk(const ChunkEntry& entry, std::span<const std::uint8_t> bytes,
                                            bool is_solid) {
    if (crc32_of(bytes) != entry.checksum)
        return damaged_bpo("the checksum of a chunk is wrong", entry.offset);
    const std::uint64_t nodes = entry.level == 0 ? 1 : std::uint64_t{8} * entry.count;
    if ((entry.level > 0 && entry.count == 0) || bytes.size() * 4 < nodes)
        return damaged_bpo("a chunk of envelopes is too short", entry.offset);
    EnvelopeChunk chunk;
    BitReader bits(bytes);
    chunk.nodes.reserve(nodes);
    for (std::uint64_t i = 0; i < nodes; ++i) chunk.nodes.push_back(static_cast<Node>(bits.get(2)));
    bool is_sound = true;
    for (const Node node : chunk.nodes) {
        if (node == Node::split || node == Node::gray) {
            std::uint32_t planes = bits.get(4);
            if (planes == 15) planes += bits.get(16);
            for (std::uint32_t i = 0; i < planes && !bits.overrun(); ++i) {
                BoundingPlane plane;
                plane.direction = static_cast<DirectionCode>(bits.get(16));
                plane.offset = static_cast<std::uint16_t>(bits.get(12));
                is_sound &= plane.direction < direction_codes && plane.offset <= largest_offset;
                chunk.planes.push_back(plane);
            }
        }
        if (node == Node::gray) chunk.windings.push_back(is_solid ? unzigzag(bits.get_rice(1)) : 0);
        chunk.plane_begin.push_back(static_cast<std::uint32_t>(chunk.planes.size()));
    }
    if (!bits.finished() || !is_sound) return damaged_bpo("a chunk of envelopes is wrong", entry.offset);
    return chunk;
}

Result<TriangleChunk> decode_triangle_chunk(const ChunkEntry& entry, std::span<const std::uint8_t> bytes) {
    if (crc32_of(bytes) != entry.checksum)
        return damaged_bpo("the checksum of a chunk is wrong", entry.offset);
    if (bytes.size() < 8) return damaged_bpo("a chunk of triangles is too short", entry.offset);
    const auto* data = reinterpret_cast<const std::byte*>(bytes.data());
    const auto total = octavo::load<std::uint32_t>(data), size = octavo::load<std::uint32_t>(data + 4);
    if (size > bytes.size() - 8 || entry.count > total)
        return damaged_bpo("a chunk of triangles is wrong", entry.offset);
    auto geometry = decode_geometry(bytes.subspan(8, size), total);
    if (!geometry) return damaged_bpo(geometry.error().sentence, entry.offset);
    BitReader flags(bytes.subspan(8 + size));
    std::vector<bool> is_new(total);
    for (std::uint32_t i = 0; i < total; ++i) is_new[i] = flags.get(1) == 1;
    const auto fresh = static_cast<std::size_t>(std::count(is_new.begin(), is_new.end(), true));
    for (std::size_t i = fresh; i < total; ++i)
        if (flags.get(std::bit_width(entry.first)) >= entry.first)
            return damaged_bpo("a repeated triangle has no number", entry.offset);
    if (!flags.finished() || fresh != entry.count)
        return damaged_bpo("a chunk of triangles has the wrong number", entry.offset);
    return TriangleChunk{std::move(*geometry), std::move(is_new)};
}

}  // namespace octavo::bp_octree
