// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/base/context.hpp>
#include <octavo/classic/moments.hpp>
#include <octavo/mesh/mesh.hpp>

// The boundary of a classic octree as a triangle mesh.
//
// Faces between a leaf that counts and one that does not are squares of the finer one's size. Where squares of
// different sizes meet, the corners of the small ones lie on the sides of the large one; they are inserted there, and
// such a square is cut into a fan about its middle, so the mesh is conforming: every edge is met by two facets.
// Where cells touch along an edge or in a corner only, four facets or two fans would meet; there the vertices are
// doubled, so that each copy has one fan and the mesh is a manifold: facets are paired across an edge around the
// solid's side. Such an edge also gets a corner in its middle, which is doubled in any case: the fans at both of its
// ends may be one fan each, and then the two edges between them would have equal vertices. Coordinates are exact:
// corners of cells are lattice points.
// Cost: O(n log n) in the faces; all neighbours are found by one walk over pairs of cells that share a face.

namespace octavo::classic {

struct ToMeshOptions {
    CountedLeaves counted = CountedLeaves::black;
};

/// Closed, facets counter-clockwise outside; empty when no leaf counts. Errors: limit when the vertices outnumber
/// 32-bit indices; cancelled.
Result<mesh::Mesh> to_mesh(const octree::Octree& octree, const ToMeshOptions& options = {},
                           const Context& context = {});

}  // namespace octavo::classic
