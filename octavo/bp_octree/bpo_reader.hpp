// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/bp_octree/bpo_chunks.hpp>
#include <octavo/io/byte_source.hpp>

// A .bpo file that stays where it is, on disk, mapped, or behind a server: opening reads head and index, and a question
// reads the chunks that it needs, once, those that lie side by side together. So the first answer takes milliseconds
// however large the file is, and memory holds what was asked for.
//
// What is read is checked as it is decoded; what is not read is not. That planes contain the solid only `certify` can
// tell, and it needs the whole tree. Of a download that broke off all is there that arrived.

namespace octavo::bp_octree {

/// How much of a file is there.
struct BpoArrived {
    std::uint64_t bytes = 0;
    int levels = 0;                           ///< that are complete, from the root on
    std::uint64_t triangles = 0, leaves = 0;  ///< in complete chunks of triangles
};

class BpoReader {
  public:
    /// Errors: those of `decode` that head and index can show; io.
    static Result<BpoReader> open(std::unique_ptr<io::ByteSource> source);
    static Result<BpoReader> open(const std::string& path);

    const BpoHead& head() const { return head_; }
    const std::vector<LevelFigures>& levels() const { return levels_; }
    /// Bytes of the file up to and with each level; the last one is everything before the triangles.
    std::vector<std::uint64_t> bytes_to_level() const;
    BpoArrived arrived() const;
    bool is_partial() const { return source_->size() < head_.file_size; }
    /// So many bytes were asked of the source.
    std::uint64_t bytes_read() const { return bytes_read_; }

    /// Levels 0 to `last`, or as many as there are, without triangles, in one request. Errors: as decode_beginning.
    Result<BpOctree> read_levels(int last);
    /// Everything. Errors: as decode.
    Result<BpOctree> read_all(const Context& context = {});

    /// The octants of a split node as they are stored.
    struct Octants {
        const EnvelopeChunk* chunk;
        std::size_t first;  ///< of the eight nodes; of level 0 the only one
        /// Of each node of the chunk: which split node of the level it is, which gray one of the chunk.
        std::span<const std::uint32_t> split, gray;
    };
    /// The octants of these split nodes, ascending numbers on `level` − 1; the root for level 0 and {0}. Valid as long
    /// as the reader. Errors: bad_input, io.
    Result<std::vector<Octants>> octants(std::size_t level, std::span<const std::uint32_t> parents);

    /// The leaf that holds a place.
    struct Leaf {
        octree::Node node = octree::Node::white;  ///< white, black or gray
        octree::Cell cell;
        std::int32_t winding = 0;  ///< of a gray one, at its low corner
    };
    /// `doubled`: whole part of the place's coordinates in half lattice units. Outside of the root cell all is white.
    /// Errors: bad_input, io.
    Result<Leaf> leaf_at(const std::array<std::int64_t, 3>& doubled);

    /// The triangles of the chunk of a gray leaf: all that meet it, and others. Valid until the next call.
    Result<const DecodedGeometry*> triangles_near(const octree::Cell& leaf);

  private:
    explicit BpoReader(std::unique_ptr<io::ByteSource> source) : source_(std::move(source)) {}

    struct Envelopes {
        EnvelopeChunk chunk;
        std::vector<std::uint32_t> split, gray;  ///< as in Octants
    };
    Status read_head_and_index();
    Status find_levels();
    Result<io::ByteRange> read(std::uint64_t offset, std::uint64_t size);
    Status load(std::span<const std::size_t> entries);
    Status keep(std::size_t entry, std::span<const std::uint8_t> bytes);
    Result<std::size_t> entry_of(std::size_t level, std::uint32_t parent) const;

    std::unique_ptr<io::ByteSource> source_;
    std::uint64_t bytes_read_ = 0;
    BpoHead head_;
    std::vector<LevelFigures> levels_;
    std::vector<ChunkEntry> entries_;
    std::vector<std::size_t> level_begin_;  ///< first entry of each level, and the first of triangles
    std::map<std::size_t, Envelopes> envelopes_;
    std::size_t geometry_entry_ = 0;  ///< whose geometry is kept; 0 is never a chunk of triangles
    DecodedGeometry geometry_;
};

}  // namespace octavo::bp_octree
