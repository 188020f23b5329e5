// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>
#include <octavo/mesh/mesh.hpp>

// Surfaces whose facets have nothing but outside before them and inside behind them.
//
// That is what a BSP tree of faces takes for granted. A closed surface that crosses, covers or nests itself has
// facets between winding numbers 1 and 2, or 0 and −1, and must be resolved first: replaced by the boundary of where
// its winding number is positive. The new vertices are rounded to the lattice, which may make facets cross again where
// they come closer than a unit; resolving is repeated until they do not.
//
// Where facets have nothing in common but corners and edges, shells tell. Where they touch, surfaces may cross along an
// edge of one in a facet of the other; then the Boolean tells: it drops facets, or leaves the surface as it is.

namespace octavo::bsp_octree {

/// Whether a closed surface separates winding numbers 0 and 1 wherever it is. Errors: those of Booleans.
Result<bool> separates(const mesh::LatticeMesh& mesh, const Context& context);

/// The boundary of where a closed surface winds about, on the same lattice; none when it is that already.
/// Errors: those of Booleans; limit when rounding keeps making facets cross.
Result<std::optional<mesh::LatticeMesh>> resolve(const mesh::LatticeMesh& mesh, const Context& context);

}  // namespace octavo::bsp_octree
