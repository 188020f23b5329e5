// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/csg/primitive.hpp>
#include <octavo/mesh/mesh.hpp>

// From a mesh to a polyhedron primitive: does it bound anything, and is it convex?

namespace octavo::csg {

/// Whether each edge, as a pair of positions, is run along equally often both ways. Then every point off the
/// surface has one winding number.
bool is_closed(const mesh::Mesh& mesh);

/// The mesh with vertices made one that fall into the same or neighbouring cells of a grid; facets that lose a corner
/// vanish. What OpenSCAD does with its grid of 2^-20 to polyhedra whose seams have rounding in them.
mesh::Mesh weld_near(const mesh::Mesh& mesh, double grid);

/// Six times the signed volume of a closed mesh, in doubles.
double six_volumes(const mesh::Mesh& mesh);

/// Its sign, whatever the scale: -1 for a mesh that is inside out.
int volume_sign(const mesh::Mesh& mesh);

/// A polyhedron, marked convex when all vertices lie below all facets within 2^-34 of its extent. Meshes with more
/// than 4 million pairs of vertex and facet are taken as not convex without looking. Vertices that no facet uses are
/// dropped.
Polyhedron as_polyhedron(mesh::Mesh mesh);

}  // namespace octavo::csg
