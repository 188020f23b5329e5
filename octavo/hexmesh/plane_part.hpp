// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/classic/facet.hpp>
#include <octavo/octree/cell.hpp>

// How a plane divides a cell.
//
// With the cell scaled to [0, 1]³ and turned over where the normal is negative, the part behind the plane is below a
// height d − a x − b y along the axis of the largest component, 0 ≤ a ≤ b ≤ 1:
//
//     V = I(d) − I(d − 1),   I(c) = ∫∫ (c − a x − b y)₊ dx dy = mean of G over [c − a, c],   G(t) = ∫ (t − b y)₊ dy
//
// G is 0, t² / 2b, t − b/2, in three pieces; the mean of each piece is taken by itself and weighted by its share, so
// that nothing cancels however small a and b are. The closed formulas in use (R. Scardovelli, S. Zaleski, Analytical
// relations connecting linear interfaces and volume fractions in rectangular grids, 2000) divide by a · b. Offsets are
// exact integers rounded once; the result is off by a few units of 2^−53. Cost: a dozen multiplications and five
// divisions, no loop.

namespace octavo::hexmesh {

/// The part of the cell behind the facet's plane, on the side that its normal points away from.
double part_behind(const classic::Facet& facet, const octree::Cell& cell);

/// Whether the cell's low corner, displaced inwards by (ε₁, ε₂, ε₃), 1 ≫ ε₁ ≫ ε₂ ≫ ε₃ > 0, lies behind it.
bool is_low_corner_behind(const classic::Facet& facet, const octree::Cell& cell);

}  // namespace octavo::hexmesh
