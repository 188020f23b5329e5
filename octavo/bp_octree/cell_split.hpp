// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <octavo/bp_octree/frame.hpp>
#include <octavo/mesh/mesh.hpp>

// Restricting a mesh to the octants of a cell: which triangles each one meets, and the winding numbers at the 27
// points where corners of octants lie.

namespace octavo::bp_octree {

/// Winding numbers at the corners of the octants of a cell, moved as in crossing.hpp; [x + 3 y + 9 z], each
/// position 0, 1 or 2 = low, middle, high.
using WindingGrid = std::array<std::int32_t, 27>;

/// `triangles` are all that meet the closed cell of the corners `low` and `high` (doubled); `at_low` is the winding
/// number at its low corner. The mesh must be closed.
WindingGrid wind(const mesh::LatticeMesh& mesh, std::span<const mesh::FaceIndex> triangles,
                 const CellBox& cell, std::int32_t at_low);

/// The winding number at corner `corner` of octant `octant`, corners and octants numbered alike.
inline std::int32_t winding_at_corner(const WindingGrid& grid, int octant, int corner) {
    const auto at = [&](int axis) { return (octant >> axis & 1) + (corner >> axis & 1); };
    return grid[static_cast<std::size_t>(at(0) + 3 * at(1) + 9 * at(2))];
}

/// Bit i is set when corner i of the octant is inside the solid.
inline std::uint8_t inside_corners(const WindingGrid& grid, int octant) {
    unsigned inside = 0;
    for (int corner = 0; corner < 8; ++corner)
        if (winding_at_corner(grid, octant, corner) > 0) inside |= 1U << corner;
    return static_cast<std::uint8_t>(inside);
}

/// Appends to octants[i] the triangles that meet octant i, in the order given.
void distribute(const mesh::LatticeMesh& mesh, std::span<const mesh::FaceIndex> triangles,
                const CellBox& cell, std::array<std::vector<mesh::FaceIndex>, 8>& octants);

}  // namespace octavo::bp_octree
