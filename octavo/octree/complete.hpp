// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <octavo/octree/morton.hpp>

// Fills the gaps between cells: the coarsest octree among whose leaves they are. Linear in the leaves.

namespace octavo::octree {

/// `cells` are sorted and disjoint; so are the leaves returned, and they fill the universe.
std::vector<CellKey> complete(std::span<const CellKey> cells);

}  // namespace octavo::octree
