// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>
#include <octavo/mesh/mesh.hpp>

// Surfaces whose facets certainly have nothing but outside before them and inside behind them.
//
// That is what labels of a BSP tree of faces can be told from at once. A closed surface that crosses, covers or nests
// itself has facets between winding numbers 1 and 2, or 0 and −1, and its trees are labelled by winding numbers instead
// (bsp/winding_labels.hpp), which takes longer.
//
// Where facets have nothing in common but corners and edges, shells tell. Where they touch, surfaces may cross along an
// edge of one in a facet of the other, or not; nobody looks closer, since winding numbers will tell.

namespace octavo::bsp_octree {

/// Whether a closed surface may have other winding numbers beside its facets than 0 before and 1 behind them; when
/// false, it has none. Error: cancelled.
Result<bool> may_meet_itself(const mesh::LatticeMesh& mesh, const Context& context);

}  // namespace octavo::bsp_octree
