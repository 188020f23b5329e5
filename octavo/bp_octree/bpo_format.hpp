// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/bp_octree/bp_octree.hpp>

// The bytes of a .bpo file: one static file that is read from the front, in parts, or whole.
//
// Stored are the tree (two bits a node), the planes (28 bits each), a winding number a leaf, and the triangles,
// coded losslessly on the lattice (geometry_codec.hpp). Not stored is what follows exactly from them: which triangles
// meet which leaf, and the triangles' share of the points. The format is described in docs/formats/bpo.md.
//
// Triangles are numbered anew, in the order of the file; a tree read back is the tree written but for that, for the
// numbers of points, and for which corner of a triangle comes first.

namespace octavo::bp_octree {

/// The file of a tree. The same tree always gives the same bytes.
std::vector<std::uint8_t> encode(const BpOctree& tree);

struct DecodeOptions {
    /// Read levels 0 to this one only. Without the deepest level there are no triangles, and split nodes of the last
    /// level read become gray leaves without triangles.
    int levels = max_depth;
};

/// Errors: bad_input with the byte where that makes sense, unsupported for another version, cancelled. A file that
/// ends early is an error here; see `decode_beginning`.
Result<BpOctree> decode(std::span<const std::uint8_t> bytes, const DecodeOptions& options = {},
                        const Context& context = {});

/// The levels that a file's first bytes hold completely; as much of a download as can be shown. Errors: as `decode`,
/// and bad_input when not even level 0 is there.
Result<BpOctree> decode_beginning(std::span<const std::uint8_t> bytes, const DecodeOptions& options = {});

/// True when the bytes begin like a .bpo file.
bool looks_like_bpo(std::span<const std::uint8_t> bytes);

/// Bytes of the file up to and with each level; the last one is everything before the triangles. Errors: as `decode`.
Result<std::vector<std::uint64_t>> bytes_to_level(std::span<const std::uint8_t> bytes);

/// How long the whole file is, of which these bytes are the beginning. Errors: as `decode`.
Result<std::uint64_t> size_in_head(std::span<const std::uint8_t> bytes);

}  // namespace octavo::bp_octree
