// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include <octavo/mesh/hex_mesh.hpp>
#include <octavo/mesh/polyhedral_mesh.hpp>

// A mesh of hexahedra as polyhedra, for finite-volume codes: a cell with smaller neighbours simply has more faces, and
// a face has a corner wherever a node lies on one of its edges. So faces share whole edges and nothing hangs.
//
// Inner faces are in upper-triangular order (by owner, then by neighbour), boundary faces by patch: one a solid, named
// after it; a cell of several solids gives its faces to the first. Zones: one for each set of solids that cells belong
// to, "a" or "a+b", inside or not.
//
// No coordinate is looked at (mesh/hex_sides.hpp), so the mesh may be fitted, have a layer or be conforming.
//
// Cost: sorts of the sides and look-ups of nodes in the middles of edges: about 2 µs a cell.

namespace octavo::hexmesh {

/// `names` are those of the solids; those that are missing are called solid_0, solid_1, … Cells outside all solids
/// are zone and patch "outside". Names are words,
/// and no two zones have the same, nor have two patches (mesh/material_names.hpp).
mesh::PolyhedralMesh to_polyhedra(const mesh::HexMesh& mesh, std::span<const std::string> names = {});

}  // namespace octavo::hexmesh
