// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <octavo/base/context.hpp>
#include <octavo/io/write.hpp>
#include <octavo/mesh/hex_mesh.hpp>

// p4est's forest files (`.p8est`, format 0x3000009): what p8est_load reads, for codes that adapt and partition with
// p4est.
//
// The forest has one tree, the universe of the mesh as a cube with corners in world units. p4est knows complete trees
// only: where the mesh has no cells the file has the fewest leaves that keep the tree balanced, and each leaf carries a
// 32-bit integer that tells them apart, so that a code can drop them.
//
// Layout, little-endian, of docs/formats/hexmesh.md; found from files that p4est 2.2 wrote, and compared with them byte
// by byte in the tests. The file does not say how long p4est's root is, and that changed: 2^19 up to release 2.2
// (Debian 12), 2^30 later. A file for the other root length loads as an invalid forest, so the user has to say.

namespace octavo::io {

struct P8estOptions {
    int root_level =
        19;  ///< log2 of p4est's P8EST_ROOT_LEN: 19 or 30; leaves are at most one level less deep
};

/// Writes to the file `path`, or to standard output when it is "-". The data of a leaf (4 bytes, saved with it) is the
/// set of its cell, or −1 when the mesh has no such cell.
/// Errors: limit when a cell is too small for the root length; io; cancelled.
Result<WriteReport> write_p8est(const std::string& path, const mesh::HexMesh& mesh,
                                const P8estOptions& options = {}, const Context& context = {});

}  // namespace octavo::io
