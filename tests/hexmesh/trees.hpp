// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <random>
#include <vector>

#include <octavo/octree/balance.hpp>

// Octrees for tests of hexmesh/.

namespace octavo::hexmesh {

inline void grow(std::mt19937& random, std::vector<octree::CellKey>& leaves, octree::CellKey key, int depth,
                 unsigned split_of_ten) {
    if (key.level() == depth || random() % 10 >= split_of_ten) {
        leaves.push_back(key);
        return;
    }
    for (int i = 0; i < 8; ++i) grow(random, leaves, key.child(i), depth, split_of_ten);
}

/// A random tree, unbalanced.
inline std::vector<octree::CellKey> random_leaves(std::mt19937& random, int depth, unsigned split_of_ten) {
    std::vector<octree::CellKey> leaves;
    grow(random, leaves, octree::CellKey::root(), depth, split_of_ten);
    return leaves;
}

/// Refined around points.
inline std::vector<octree::CellKey> refined_at(const std::vector<exact::Point>& points, int depth) {
    std::vector<octree::CellKey> leaves, open{octree::CellKey::root()};
    while (!open.empty()) {
        const octree::CellKey key = open.back();
        open.pop_back();
        if (key.level() < depth &&
            std::any_of(points.begin(), points.end(), [&](exact::Point p) { return key.contains(p); }))
            for (int i = 7; i >= 0; --i) open.push_back(key.child(i));
        else
            leaves.push_back(key);
    }
    return leaves;
}

inline exact::Point random_point(std::mt19937& random) {
    std::uniform_int_distribution<std::int32_t> place(0, exact::universe_side - 1);
    return {place(random), place(random), place(random)};
}

}  // namespace octavo::hexmesh
