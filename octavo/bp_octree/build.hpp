// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/base/context.hpp>
#include <octavo/bp_octree/bp_octree.hpp>
#include <octavo/bp_octree/coalescing.hpp>
#include <octavo/bp_octree/k_medoids.hpp>

// Builds a BP-octree level by level.
//
// A node's triangles are those of its parent that meet its closed cell (exact). The winding number at one corner
// of each cell is carried along: the signed crossings of the lines between the corners of its octants give it at
// the others, so white and black cells, and the corners inside the solid, are exact too. Inside means winding
// number > 0. Then the node's content is bounded (support.hpp) and planes are chosen (select_planes.hpp).
//
// Cost: time is proportional to nodes × candidates for the planes and to references × levels for the rest; memory
// is the tree and two levels of triangle lists.

namespace octavo::bp_octree {

enum class Quality : std::uint8_t {
    fast,    ///< planes among fixed directions and mean normals
    normal,  ///< and improved by a search round each
};

enum class PlaneChoice : std::uint8_t {
    greedy,     ///< select_planes.hpp
    k_medoids,  ///< the thesis's way, for comparison; k_medoids.hpp
};

struct BuildOptions {
    /// What makes a cell a leaf above `depth`.
    Coalescing coalescing = Coalescing::count;
    /// For Coalescing::count: a cell with at most this many triangles is a leaf. For sum: the most that siblings have.
    std::size_t leaf_triangles = 50;
    /// For Coalescing::mean.
    double least_mean = 20;
    /// Cells of this level are leaves in any case; at most max_depth.
    int depth = 9;
    PlaneChoice planes = PlaneChoice::greedy;
    Quality quality = Quality::normal;
    /// Planes must cut more than this part of their cell's volume from level 4 down; on coarser levels much less,
    /// because there are few nodes and everything lies within their planes.
    double least_gain = 1e-3;
    /// For PlaneChoice::k_medoids.
    KMedoidsOptions k_medoids;
};

/// Errors: bad_input when the mesh has no triangle; limit when the tree would need more than 2^32 − 1 nodes or
/// references, or its volumes more than a double; cancelled. Precondition: corners are indices of points, options are
/// in range.
Result<BpOctree> build(const mesh::LatticeMesh& mesh, const BuildOptions& options = {},
                       const Context& context = {});

}  // namespace octavo::bp_octree
