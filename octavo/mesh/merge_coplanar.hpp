// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/mesh/mesh.hpp>

// From triangles back to the faces that they were cut from: neighbours in one plane, exactly, become one face with
// any number of holes.
//
// Facets are neighbours across an edge that has two of them, running along it opposite ways. A face grows from a facet
// over neighbours whose corners lie in its plane and which look the same way; one without area goes with whichever
// face reaches it first. The sides that lead out of the face are then strung together, turning at each vertex through
// the face, so that contours touch in vertices at most. Where that gives anything but one outer contour and holes
// (a slit, where a wall stands on the face), the triangles stay as they are.
//
// Every edge of a contour is an edge of the mesh, used in the same direction: what was closed stays closed.
// Corners keep their indices; vertices inside faces are corners of none. Facets that name a vertex twice are dropped.
// Not guaranteed: a surface that winds round a point twice in one plane gives a contour that does. No solid has that.
// Exact on the lattice: what lies in one plane there may be off it by half a unit in the file that it came from.
// Cost: an edge table, and one orientation test a pair of neighbours; 0.3 µs a triangle.

namespace octavo::mesh {

/// Faces in the order of their first triangles. Precondition: corners name points.
PolygonMesh merge_coplanar(const LatticeMesh& mesh);

}  // namespace octavo::mesh
