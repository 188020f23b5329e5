// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <octavo/bp_octree/support.hpp>
#include <octavo/mesh/mesh.hpp>

// Everything of a solid that lies in one cell, as the points whose convex hull contains it. Buffers are kept from
// cell to cell; one object per thread.

namespace octavo::bp_octree {

class NodeContent {
  public:
    /// `triangles` are those that meet the closed cell, `inside` has bit i set when corner i is inside the solid.
    void gather(const mesh::LatticeMesh& mesh, const CellBox& box, std::span<const mesh::FaceIndex> triangles,
                std::uint8_t inside);

    const PointSet& points() const { return points_; }
    /// Of the triangles, in the coordinates of the cell, as long as their areas are large.
    std::span<const Vec3> normals() const { return normals_; }

  private:
    PointSet points_;
    std::vector<Vec3> normals_;
    std::vector<std::uint32_t> seen_by_;  ///< per mesh vertex: the last cell that took it
    std::uint32_t cell_ = 0;
};

}  // namespace octavo::bp_octree
