// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <octavo/csg/region.hpp>

// Triangles that cover a polygon with holes, for the caps of extrusions and the faces of polyhedra.
//
// Holes are joined to their outline by a cut to a vertex that they see, and ears are cut off the resulting ring
// (D. Eberly, Triangulation by ear clipping, 2002). Turns are signs of 128-bit integers: coordinates are first
// rounded to 40 bits, which only chooses between triangulations, never moves a vertex. Should the contours touch in
// a way that leaves no ear, the rest is a fan: its triangles overlap, but counted with their sides they still cover
// the polygon once, which is all that winding numbers ask for.
// Cost: quadratic in the corners of a polygon at worst; 10 000 corners take about a second.

namespace octavo::csg {

/// Corners are numbered through all contours in order. Counter-clockwise triangles for positive area.
std::vector<std::array<std::uint32_t, 3>> triangulate(const std::vector<Contour>& contours);

}  // namespace octavo::csg
