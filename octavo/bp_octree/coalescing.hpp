// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/bp_octree/frame.hpp>
#include <octavo/mesh/mesh.hpp>
#include <octavo/octree/morton.hpp>

// Where a BP-octree stops, by the three criteria of the thesis (its section 3.3, tables 3.1 and 3.2). There, all cells of
// the deepest level that the surface meets are made first, and siblings that are all leaves are then joined from below:
//
//     count   while the new leaf has at most so many triangles
//     mean    until siblings have so many triangles on average
//     none    never
//
// By count the same leaves follow from above, since a cell meets no fewer triangles than its octants do. A mean says
// nothing of the cells below, so these are looked at first: `split_by_mean`.
//
// Source: F. J. Melero, BP-Octree, doctoral thesis, Granada 2008. The algorithm printed there (4) never joins anything: a
// flag that says that all octants are leaves is only set by octants that are none.

namespace octavo::bp_octree {

enum class Coalescing : std::uint8_t { count, mean, none };

/// The cells that stay split, ascending: those below `depth` with an octant that stays split, or whose octants that meet
/// triangles meet `least_mean` or more on average. Errors: cancelled.
Result<std::vector<octree::CellKey>> split_by_mean(const mesh::LatticeMesh& mesh, const Frame& frame,
                                                   int depth, double least_mean, const Context& context = {});

}  // namespace octavo::bp_octree
