// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>
#include <octavo/hexmesh/build.hpp>

// A conforming mesh of hexahedra for codes that know no hanging nodes.
//
// Idea: halving cannot be made to conform with hexahedra alone, for a square with five nodes on its rim has no division
// into squares; cutting in three can. So the mesh is a grid of cells of side `precision`, cut in 27 where smaller
// sizes are asked for (boxes, solids, curvature, proximity), as often as it takes; cells beside smaller ones are
// divided by templates (cell_template.hpp). A cell that has no template for what its neighbours do is cut in 27 itself,
// and smaller cells keep a ring of whole cells of their own size around them, so that templates never meet templates of
// another level. One sweep from the smallest cells to the largest sees to both.
// The price: there are no templates where smaller cells lie on two sides of an edge of a larger one, so regions of
// small cells grow until they bulge everywhere, and the inside of a solid is not coarser than its surface. Octree
// meshes with hanging nodes are; this one is for codes that cannot tie them.
//
// Sides are `precision` times or over powers of three, on multiples of themselves in the world.
// A cell belongs to the solids that contain its centre, exactly (query/inside.hpp): cells have no fractions.
// Guaranteed: every inner face has two cells, every cell is positive everywhere, scaled Jacobian at least 0.13 (1
// where nothing smaller is near); the same bytes for any number of threads.

namespace octavo::hexmesh {

/// Meshes the solids. `balance` and `keep` of the options mean nothing here; the mesh is no octree, so that
/// `cells`, `nodes` and `fractions` are empty. Of the report's volumes only `exact_volume` and `inside_volume`, that of
/// the cells, are given.
/// Errors: those of `build`; limit when the grid has more than 2^20 cells along an axis, or a size is more than 3^11
/// times smaller than `precision`. `max_cells` limits the octree and the hexahedra of the grid, those outside included.
Result<Built> build_conforming(std::span<const mesh::Mesh> solids, const Options& options = {},
                               const Context& context = {});

}  // namespace octavo::hexmesh
