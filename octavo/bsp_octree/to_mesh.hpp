// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>
#include <octavo/bsp_octree/bsp_octree.hpp>
#include <octavo/mesh/mesh.hpp>
#include <octavo/mesh/moments.hpp>

// From a BSP-octree back to a boundary.
//
// Problem: the leaves hold fragments, cut by walls and by planes of trees, differently on either side of a cut. The
// mesh should have the solid's faces, each whole, and every edge with one facet on either side. Idea: forget the
// fragments and keep the sum of their borders. Borders are segments of lines; on each line, the segments of one plane
// that run both ways cancel, wherever they were cut. What is left is the border of that plane's part of the boundary.
// On one line the borders of all planes are cut at the same points, where something changes, and nowhere else: so
// faces share edges by construction, and walls leave no trace. Each plane's border is then triangulated exactly, and
// the result assembled to a manifold as boolean/ does it (edges and vertices where the solid touches itself are
// doubled; one rounding to doubles).
//
// Guaranteed: every facet lies in a plane of the input; coplanar neighbours are one polygon; closed, manifold; a mesh
// that was only stored comes back as it was, but for its coplanar facets and the vertices that only they needed.
// Cost: about 5 µs a fragment, most of it on all threads.

namespace octavo::bsp_octree {

struct MeshReport {
    std::size_t fragments = 0;
    std::size_t segments = 0;             ///< of borders
    double largest_rounding = 0;          ///< of an exact vertex, in world units
    std::size_t inverted_facets = 0;      ///< turned over or made flat by rounding
    std::size_t duplicated_vertices = 0;  ///< where the solid touches itself
};

struct ToMesh {
    mesh::Mesh mesh;
    MeshReport report;
};

/// Errors: not_a_solid when the solid is unbounded (a complement), or its faces do not close, as those of a file may
/// that was made to lie; cancelled.
Result<ToMesh> to_mesh(const BspOctree& octree, const Context& context = {});

/// Volume, area, centroid and inertia straight from the leaves, without a mesh. The solid must be bounded. Cancelled, a
/// part is missing. Phase "faces".
mesh::Moments measure(const BspOctree& octree, const Context& context = {});

}  // namespace octavo::bsp_octree
