// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/csg/lattice_plane.hpp>
#include <octavo/csg/lattice_torus.hpp>
#include <octavo/csg/octant_colors.hpp>
#include <octavo/csg/point_colors.hpp>
#include <octavo/csg/quadric.hpp>

// On which side of one surface the 35 points of a cell lie.
//
// Idea: in steps of half a cell from its low corner, a plane takes four numbers and a quadric ten, and the points fit
// five SIMD registers of single precision. The numbers are made exactly (planes) or in double precision (quadrics)
// for each cell, so what single precision loses is relative to the cell and not to the world. When a point is nearer
// to the surface than that, all are done again: planes in 64-bit integers, exactly; quadrics in double precision,
// beyond the error bound of quadric.hpp.
// Cost: about 20 nanoseconds a surface.

namespace octavo::csg {

PointColors sides_of(const LatticePlane& plane, const octree::Cell& cell);
/// Of the octants: white without a corner strictly inside, black without one strictly outside.
OctantColors octants_of(const LatticePlane& plane, const octree::Cell& cell);
PointColors sides_of(const LatticeTorus& torus, const octree::Cell& cell);

/// Of a quadric also the octants that it certainly misses, beyond those whose corners say so: there the tangent at
/// the middle, lowered by how far the quadric can bend below it, is positive in the whole octant.
struct QuadricSides {
    PointColors points;
    std::uint8_t missed = 0;
};
QuadricSides sides_of(const Quadric& quadric, const octree::Cell& cell);
/// Only the octants that it certainly misses or holds.
OctantColors octants_of(const Quadric& quadric, const octree::Cell& cell);

}  // namespace octavo::csg
