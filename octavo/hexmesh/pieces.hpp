// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <octavo/mesh/hex_mesh.hpp>

// Into how many pieces a mesh falls. Cells too large for a thin part break it up, and a solver then sees loose bodies;
// a count beside the solids' own tells.

namespace octavo::hexmesh {

/// Pieces that share no node; a hanging node holds to its masters. Near linear in the cells.
std::uint64_t count_pieces(const mesh::HexMesh& mesh);

}  // namespace octavo::hexmesh
