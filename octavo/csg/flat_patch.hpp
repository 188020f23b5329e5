// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include <octavo/csg/lattice_plane.hpp>
#include <octavo/csg/lattice_polyhedron.hpp>

// What a closed mesh is in a cell in which all its triangles lie in one plane.
//
// Because the mesh is closed, its triangles cover every point of the plane inside the cell equally often, counted
// with their sides: a border of the covering would be an open edge. So the cell's two parts have one winding
// number each, and the mesh is a half space there, or, when both numbers say the same, constant: a wall that the
// mesh has with itself. That count is taken at one point of one triangle, well away from all edges.

namespace octavo::csg {

struct FlatPatch {
    enum class Kind : std::uint8_t { other, plane, constant } kind = Kind::other;
    LatticePlane plane;   ///< the mesh is where it is positive
    bool inside = false;  ///< of a constant
};

/// `triangles` are those that meet the cell's interior, `winding` is the number at its reference point.
FlatPatch flat_patch(const LatticePolyhedron& polyhedron, const octree::Cell& cell, std::int32_t winding,
                     std::span<const std::uint32_t> triangles);

}  // namespace octavo::csg
