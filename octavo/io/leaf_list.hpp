// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>
#include <octavo/io/write.hpp>
#include <octavo/mesh/hex_mesh.hpp>

// The cells of an octree mesh as lines of text: for codes that rebuild the tree themselves (deal.II, libMesh, p4est)
// and refine level by level.
//
//     # octavo leaf list 1
//     # origin X Y Z
//     # side S
//     x,y,z,level,set
//     12,0,7,5,1
//
// x, y, z count cells of that level from the origin: the cell's low corner lies at origin + (x, y, z) · S / 2^level.
// `set` numbers the sets of solids; lines "# set N inside A B boundary C" name them.

namespace octavo::io {

/// Writes to the file `path`, or to standard output when it is "-". Errors: io, cancelled.
Result<WriteReport> write_leaf_list(const std::string& path, const mesh::HexMesh& mesh,
                                    const Context& context = {});

}  // namespace octavo::io
