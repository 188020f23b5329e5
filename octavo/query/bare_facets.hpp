// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <octavo/classic/facet.hpp>
#include <octavo/mesh/mesh.hpp>

// Facets without area that are all there is of the surface where they lie.
//
// A facet without area bounds nothing and crosses nothing, but its points are points of the surface: they are on it, at
// distance 0. Nearly always it is a needle, and a neighbour with area has its long side too; but a body that is thinner
// than the lattice unit may collapse to a line, and then only such facets are left of it.

namespace octavo::query {

/// Facets without area of which no facet with area has the whole segment as an edge, or the point as a corner; each
/// segment once, ascending. `with_area` are the other facets of the mesh. Linear but for sorting what is found.
std::vector<classic::Facet> bare_facets(const mesh::LatticeMesh& mesh,
                                        std::span<const classic::Facet> with_area);

}  // namespace octavo::query
