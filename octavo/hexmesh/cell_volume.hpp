// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include <octavo/classic/facet.hpp>
#include <octavo/octree/cell.hpp>

// How much of a cell lies in a solid, from the facets that touch the cell and one winding number.
//
// Idea: integrate the winding number w over the cell, along z, then x, then y, always upwards from the low sides. Going
// up from a low side, w changes where a facet is crossed, so with the cell scaled to [0, 1]³
//
//     ∫∫∫ w = w(low corner) + Σ over facets of
//               ± (1 − y)            where the facet meets the edge x = z = 0
//             + ± ∫ (1 − x) dy       along its section with the side z = 0
//             + ± ∫∫ (1 − z) dx dy   over its part inside the cell,
//
// which is local: a facet contributes by itself, whatever its neighbours do, and nothing is stitched together.
//
// Which of these a facet has is decided in integers, with the low sides displaced inwards by (ε₁, ε₂, ε₃), 1 ≫ ε₁ ≫ ε₂
// ≫ ε₃ > 0, as in classic/crossing.hpp: facets in walls, edges through corners need no care. Given that, each
// contribution depends continuously on coordinates, and these are rounded quotients of exact integers, so the result is
// off by a few units of 2^−53 times the number of facets and, where a facet is larger than the cell, the ratio of their
// sizes (at most 2^21). A facet that is alone in a cell has no edge there, for the surface is closed: it divides the
// cell as its plane does, which is simpler (plane_part.hpp). With cells smaller than facets that is the usual case.
// Cost: about 20 ns for a facet inside the cell, 100 ns for one that is clipped.

namespace octavo::hexmesh {

/// ∫ w over the cell, divided by the cell's volume: for a solid without overlaps, the part of the cell inside it.
/// `list` names the facets of a closed surface that meet the open cell, all of them and no others; `winding` is that of
/// the cell's low corner, displaced inwards.
double filled_part(std::span<const classic::Facet> facets, std::span<const std::uint32_t> list,
                   const octree::Cell& cell, int winding);

}  // namespace octavo::hexmesh
