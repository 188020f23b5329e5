// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/base/context.hpp>
#include <octavo/boolean/faces.hpp>
#include <octavo/boolean/surface.hpp>

// Coplanar leftovers become whole again: pieces of cut facets that lie side by side in one plane are merged and
// triangulated anew without the vertices that nothing needs any more.
//
// Pieces are joined across edges that have just these two facets, in one plane and turned alike; the sets are
// *regions*. A vertex goes when no whole input facet has it and either it lies inside a region, or all borders of
// regions at it run straight through: both rules look at all facets at the vertex, so that all regions agree and no
// T-junction appears. Then each region is triangulated from its border and from the points inside where others touch
// it. Whole facets are not touched. Everything is decided exactly, on points that are not rounded yet. Cost: linear but
// for the triangulation.

namespace octavo::boolean {

/// Cancellation leaves the result incomplete.
Surface merge_coplanar(Surface surface, const Soup& soup, const Faces& faces, const PointTable& points,
                       const Context& context);

}  // namespace octavo::boolean
