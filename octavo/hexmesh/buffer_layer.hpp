// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/mesh/hex_mesh.hpp>

// A layer of hexahedra between the boundary of a mesh of cubes and the surface that it is to be drawn to.
//
// Problem: steps of cubes cannot lie on a smooth surface as they are. A cube at the edge of a step has two sides there
// that should become one plane, which leaves a corner of 180 degrees and a Jacobian of 0; so nodes must stay behind.
// Idea: shrink the mesh a little and fill the gap with one hexahedron for each side of the boundary. Now no cell has
// more than one side on the surface, and its corners can be right. Each node n of the boundary gets a twin inside; the
// cells take the twin, n belongs to the new cells alone. Hanging nodes have hanging twins. Where a large side of the
// boundary meets two smaller ones along an edge, their new cells meet at half sides: the middles of both edges hang,
// and the field is still continuous. Source: the layer is R. Schneiders' (A grid-based algorithm for the generation of
// hexahedral element meshes, 1996).

namespace octavo::hexmesh {

/// Puts the layer on the whole boundary. New cells follow the others, belong to the solids of the cell that they cover,
/// and are no octants: `cells`, `nodes` and `fractions` become empty, `positions` hold all nodes. False, and the mesh
/// as it was, when the boundary touches itself or folds, when smaller cells cover a part of a larger boundary side, or
/// when some cell would not be positive everywhere; Keep::manifold with `layers` avoids these on most parts.
bool insert_buffer_layer(mesh::HexMesh& mesh);

}  // namespace octavo::hexmesh
