// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/bp_octree/bp_octree.hpp>

namespace octavo::bp_octree {

/// Counts nodes and planes and measures volumes anew from nodes and planes alone. What `build` reports and files hold
/// is the same up to the rounding of sums (1e-9). A cancelled one has no volumes.
std::vector<LevelFigures> measure_levels(const BpOctree& tree, const Context& context = {});

}  // namespace octavo::bp_octree
