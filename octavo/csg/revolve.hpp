// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/base/result.hpp>
#include <octavo/csg/expression.hpp>
#include <octavo/csg/region.hpp>

// A flat region turned about the z axis, with truly round surfaces.
//
// The region is cut into trapezoids by the heights of its corners; turned, a trapezoid is a truncated cone without
// a smaller one. The planes between neighbouring slabs are equal integers on the lattice, so the walls that the
// cutting makes vanish in the octree (local_arrangement.hpp).

namespace octavo::csg {

/// x becomes the radius, y the height. `angle` in degrees, counter-clockwise from +x; 360 or more is a full turn.
/// Errors: bad_input when the region lies on both sides of x = 0.
Result<Expr> revolve(const Region& region, double angle = 360);

}  // namespace octavo::csg
