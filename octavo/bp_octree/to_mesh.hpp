// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/base/context.hpp>
#include <octavo/bp_octree/bp_octree.hpp>

// A level of a BP-octree as triangles: one closed convex shell per envelope and black cell.

namespace octavo::bp_octree {

struct ToMeshOptions {
    /// Level to draw, 0 to deepest(); deeper ones are taken as the deepest.
    int level = 0;
    /// With the faces that lie in sides of cells every shell is closed. Without them (the thesis calls them
    /// fictitious) what bounding planes made remains, and black cells vanish: less to draw, and open where cells meet.
    bool cell_faces = true;
};

/// Vertices are rounded to doubles; `sources` tell the node of each triangle (operand 0, face = number of the node).
mesh::Mesh to_mesh(const BpOctree& tree, const ToMeshOptions& options = {}, const Context& context = {});

/// The triangles themselves. Lattice points are exact doubles, so nothing is rounded.
mesh::Mesh exact_mesh(const BpOctree& tree);

}  // namespace octavo::bp_octree
