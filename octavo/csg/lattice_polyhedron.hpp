// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <octavo/base/result.hpp>
#include <octavo/exact/lattice.hpp>
#include <octavo/mesh/mesh.hpp>
#include <octavo/octree/cell.hpp>

// A closed mesh on the lattice, asked about the eight octants of a cell.
//
// Two exact questions decide an octant: which triangles meet its interior, and, when none does, how often the
// mesh winds about it. The first is the separating axis test in integers (T. Akenine-Möller, Fast 3D
// triangle-box overlap testing, 2001); a triangle that only touches the octant's sides does not count. For the
// second every cell has a reference point, near its middle at odd multiples of half a unit, with a known winding
// number; that of an octant follows by walking from the parent's reference along the axes and counting, with
// their signs, the triangles crossed. Those all meet the parent, so its list suffices.
// Ties: the walk may run through an edge, or a reference lie on a triangle. Points are therefore moved by the
// symbolic vector (e, e², e³), the same for all (H. Edelsbrunner and E. Mücke, Simulation of simplicity, 1990).
//
// Vertices may lie up to `reach` units outside the universe. Bits: doubled coordinates 30, differences 31, so
// cross products take 63 bits; plane values 95 of 128.

namespace octavo::csg {

struct LatticePolyhedron {
    /// Coordinates lie in [-reach, reach].
    static constexpr std::int32_t reach = std::int32_t{1} << 28;

    std::vector<std::array<std::int32_t, 3>> points;
    std::vector<mesh::Triangle> triangles;  ///< without those that became flat

    /// Octants of `parent` whose interior the triangle meets, one bit each.
    std::uint8_t octants_met(std::uint32_t triangle, const octree::Cell& parent) const;

    /// The winding number at the reference point of the universe: counts from far outside.
    std::int32_t winding_of_universe() const;

    /// The winding numbers at the reference points of the octants, from that of the parent; `triangles` are those
    /// that meet the parent.
    std::array<std::int32_t, 8> windings(const octree::Cell& parent, std::int32_t winding,
                                         const std::uint32_t* triangle_ids, std::size_t count) const;
};

/// The mesh under `place`, rounded to the lattice; a map that mirrors is made good by turning the facets.
/// Errors: limit when a vertex lies more than `reach` units away.
Result<LatticePolyhedron> snap_polyhedron(const mesh::Mesh& mesh, const Affine& place,
                                          const exact::Lattice& lattice);

}  // namespace octavo::csg
