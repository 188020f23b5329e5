// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include <octavo/mesh/mesh.hpp>

// The convex hull of points in space.
//
// Quickhull (C. Barber, D. Dobkin, H. Huhdanpaa, 1996): every point outside is kept with one facet that it sees; the
// farthest one of a facet is added, the facets that it sees are replaced by a cone to their horizon. Sides are signs
// of integers: points are rounded to a lattice of their own (26 bits) for the decisions, so the result is the exact
// hull of rounded points, whatever their position; its vertices are the given ones.

namespace octavo::csg {

/// A closed triangle mesh, counter-clockwise outside; nothing when the points lie in a plane as far as 2^-26 of
/// their extent tells. Points must be finite.
std::optional<mesh::Mesh> convex_hull(const std::vector<Vec3>& points);

}  // namespace octavo::csg
