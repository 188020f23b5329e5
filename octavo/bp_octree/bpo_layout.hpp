// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <octavo/base/result.hpp>
#include <octavo/bp_octree/bp_octree.hpp>

// The fixed parts of a .bpo file: head, table of levels, pages of the index. docs/formats/bpo.md draws every byte.
//
//     head (192) │ levels (48 each) │ index pages (4096 each) │ chunks …
//
// Chunks come level by level, Morton order within a level, then the triangles in Morton order of their leaves. So a
// download from the front shows coarse levels first, and whoever wants a part finds it by the index.

namespace octavo::bp_octree {

inline constexpr std::array<std::uint8_t, 8> bpo_magic{0x89, 'B', 'P', 'O', '\r', '\n', 0x1A, '\n'};
inline constexpr std::uint32_t bpo_version = 1;

struct BpoHead {
    bool is_solid = true;
    exact::Lattice lattice;
    Frame frame;
    std::uint32_t levels = 0;
    double solid_volume = 0;
    std::uint64_t nodes = 0, planes = 0, leaves = 0, triangles = 0, points = 0;
    std::uint64_t file_size = 0;
    std::uint32_t chunks = 0;

    static constexpr std::size_t size = 192;
    static constexpr std::size_t level_size = 48;
    std::uint64_t index_at() const { return size + level_size * levels; }
    /// Where the index ends and the first chunk begins.
    std::uint64_t chunks_at() const;
};

enum class ChunkKind : std::uint8_t { envelopes = 0, triangles = 1 };

struct ChunkEntry {
    std::uint64_t offset = 0;
    std::uint32_t size = 0;
    std::uint32_t checksum = 0;  ///< CRC-32 of the chunk
    ChunkKind kind = ChunkKind::envelopes;
    std::uint8_t level = 0;  ///< of the nodes in an envelope chunk
    /// Envelopes: number, among the split nodes of the level above, of the first parent whose octants are here.
    /// Triangles: number of the first triangle.
    std::uint32_t first = 0;
    std::uint32_t count = 0;  ///< parents, or triangles that are new here
    /// Envelopes: split nodes of this level before the chunk. Triangles: leaves before it, in Morton order.
    std::uint32_t splits_before = 0;
    /// Envelopes: gray nodes of this level before the chunk. Triangles: leaves of the chunk.
    std::uint32_t leaves_before = 0;
    /// Envelopes: name of the first parent. Triangles: of the first leaf. The root's chunk has the root.
    std::uint64_t first_key = 0;

    std::uint64_t end() const { return offset + size; }

    static constexpr std::size_t size_in_file = 48;
};

inline constexpr std::size_t page_size = 4096;
inline constexpr std::size_t page_head = 16;
inline constexpr std::size_t entries_a_page = (page_size - page_head) / ChunkEntry::size_in_file;
static_assert(page_head + entries_a_page * ChunkEntry::size_in_file == page_size);

inline std::uint64_t BpoHead::chunks_at() const {
    return index_at() + (std::uint64_t{chunks} + entries_a_page - 1) / entries_a_page * page_size;
}

void put_head(const BpoHead& head, std::span<const LevelFigures> levels, std::vector<std::uint8_t>& out);
void put_index(std::span<const ChunkEntry> entries, std::vector<std::uint8_t>& out);

/// The head and the figures of the levels. Errors: bad_input with the byte; unsupported for another version.
struct HeadAndLevels {
    BpoHead head;
    std::vector<LevelFigures> levels;
};
Result<HeadAndLevels> get_head(std::span<const std::uint8_t> bytes);

/// All entries of the index; `bytes` is the file from its beginning. Errors: bad_input with the byte, also when the
/// entries do not describe chunks that follow each other to the end of the file.
Result<std::vector<ChunkEntry>> get_index(const BpoHead& head, std::span<const std::uint8_t> bytes);

}  // namespace octavo::bp_octree
