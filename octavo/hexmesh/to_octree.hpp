// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/mesh/hex_mesh.hpp>
#include <octavo/octree/octree.hpp>

// The octree whose leaves are the cells of a mesh: black where a cell lies inside a solid, gray where a surface passes
// through it, white where there is no cell. Cells stay as they are, also eight siblings of one colour. For pictures,
// for HyperTreeGrid files and for everything else that works on classic octrees.

namespace octavo::hexmesh {

/// The mesh must be one of octants (`is_octree`).
octree::Octree to_octree(const mesh::HexMesh& mesh);

}  // namespace octavo::hexmesh
