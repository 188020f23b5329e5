// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <octavo/bp_octree/bpo_chunks.hpp>
#include <octavo/io/range_reader.hpp>

// A .bpo file that stays where it is: opening reads head and index, and a question about a place reads the chunks that
// lie on the way to its leaf, once. So the first answer takes milliseconds however large the file is, and memory
// holds what was asked for.
//
// What is read is checked as it is decoded; what is not read is not. That planes contain the solid only `certify` can
// tell, and it needs the whole tree.

namespace octavo::bp_octree {

class BpoReader {
  public:
    /// Errors: those of `decode` that head and index can show; io.
    static Result<BpoReader> open(const std::string& path);

    const BpoHead& head() const { return head_; }
    const std::vector<LevelFigures>& levels() const { return levels_; }

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
    explicit BpoReader(io::RangeReader file) : file_(std::move(file)) {}

    struct Envelopes {
        EnvelopeChunk chunk;
        std::vector<std::uint32_t>
            number;  ///< per node: of split nodes among theirs, of gray among theirs, in the chunk
    };
    Result<const Envelopes*> envelopes(std::size_t entry);
    Result<std::size_t> entry_of(std::size_t level, std::uint32_t parent) const;
    Result<std::vector<std::uint8_t>> bytes_of(const ChunkEntry& entry);

    io::RangeReader file_;
    BpoHead head_;
    std::vector<LevelFigures> levels_;
    std::vector<ChunkEntry> entries_;
    std::vector<std::size_t> level_begin_;  ///< first entry of each level, and the first of triangles
    std::map<std::size_t, Envelopes> envelopes_;
    std::size_t geometry_entry_ = 0;  ///< whose geometry is kept; 0 is never a chunk of triangles
    DecodedGeometry geometry_;
};

}  // namespace octavo::bp_octree
