// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>

#include <octavo/octree/morton.hpp>

// The leaf that contains a lattice point, by bisection: for a few questions about leaves that nothing else has a tree
// of.

namespace octavo::hexmesh {

/// Its index; none outside the universe. `leaves` fill the universe and are sorted.
inline std::optional<std::size_t> find_leaf(std::span<const octree::CellKey> leaves, exact::Point p) {
    for (int axis = 0; axis < 3; ++axis)
        if (p[axis] < 0 || p[axis] >= exact::universe_side) return std::nullopt;
    const octree::CellKey key = octree::CellKey::at(p, octree::max_level);
    const auto leaf = std::partition_point(
        leaves.begin(), leaves.end(), [&](octree::CellKey cell) { return cell.last_descendant() < key; });
    return static_cast<std::size_t>(leaf - leaves.begin());
}

}  // namespace octavo::hexmesh
