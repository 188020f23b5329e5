// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

// How a cube some of whose edges are cut in three is divided into hexahedra, so that neighbours fit.
//
// Idea: one axis after the other. Where all four edges along an axis are cut the cube falls into three slabs; where
// two on one side are, a square template of four is drawn out along the third axis; where only one is, five hexahedra
// do:
//
//       two edges, seen along the third axis             one edge
//       ┌───┬───┬───┐   cut                              the piece in the middle of the edge, one on either
//       │   ├───┤   │                                    side of it, and one behind each of its two inner
//       │  ╱     ╲  │                                    sides
//       └───────────┘   whole
//
// A face all of whose edges are cut is cut in nine. What happens on a face depends on the cut edges of that face alone,
// so two cells agree on their common face without looking at each other. In each pass the pattern on each piece must be
// one of these; where it is not (three edges, or two that are opposite) there is no template, and the whole cell is
// to be cut in 27.
//
// Source: the templates are R. Schneiders' (Refining quadrilateral and hexahedral element meshes, 1996); the passes by
// axis are those of M. Parrish, M. Borden, M. Staten, S. Benzley (A selective approach to conformal refinement of
// unstructured hexahedral finite element meshes, 2007), here on cells of a grid, where edges have axes.
// Invariant: coordinates are exact integers: a pass divides by 12 at most (thirds, and halves for the depth of the
// template in two directions), so 12³ parts a side suffice for three passes.

namespace octavo::hexmesh {

inline constexpr std::int64_t template_side = 12 * 12 * 12;

using TemplatePoint = std::array<std::int64_t, 3>;  ///< in [0, template_side]³
using TemplateHex = std::array<TemplatePoint, 8>;   ///< corners in the order of octants

/// Edges of a cube as bits: edge 4 * axis + b + 2 * c runs along `axis`; b and c tell the high side of the next two
/// axes in cyclic order.
using EdgeSet = std::uint16_t;

/// The hexahedra for a set of cut edges; none when it has no template.
std::vector<TemplateHex> cut_cell(EdgeSet cut);

}  // namespace octavo::hexmesh
