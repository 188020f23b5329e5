// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <octavo/bsp/fragment.hpp>
#include <octavo/bsp/tree.hpp>

// The nodes of a tree, each with the polygon in which its plane meets its region.
//
// A node's plane is cut to the cell and to the sides of the nodes above it. Carrying convex polyhedra down the tree
// instead, as Nehring-Wirxel, Trettner and Kobbelt do, saves the cuts by the nodes above but has to copy and cut the
// polyhedra: 600 to 850 bytes a node.

namespace octavo::bsp {

/// Goes through one tree after the other and keeps its memory.
class NodePolygons {
  public:
    /// Calls `visit(index, polygon)` for the nodes, in preorder; the cell is that of the tree's root. The polygon has
    /// no corners where a plane passes by its region, as in trees of files that lie. `visit` may use the pool.
    template <class Visit>
    void for_each(FragmentPool& pool, const octree::Cell& cell, std::span<const Node> nodes,
                  const Visit& visit) {
        path_.clear();
        steps_.clear();
        steps_.push_back({0, 0, false});
        while (!steps_.empty()) {
            const Step step = steps_.back();
            steps_.pop_back();
            const Node& node = nodes[static_cast<std::size_t>(step.node)];
            path_.resize(step.depth);
            if (step.depth > 0) path_.back().is_front = step.is_front;
            visit(static_cast<std::size_t>(step.node), polygon(pool, cell, node.plane));

            path_.push_back({node.plane, false});
            const auto below = static_cast<std::uint32_t>(path_.size());
            if (!node.back.is_leaf()) steps_.push_back({node.back.value, below, false});
            if (!node.front.is_leaf()) steps_.push_back({node.front.value, below, true});
        }
    }

  private:
    struct Step {
        std::int32_t node;
        std::uint32_t depth;  ///< of the path above it
        bool is_front;        ///< of its parent
    };
    struct Side {
        PlaneId plane;
        bool is_front;
    };

    Fragment polygon(FragmentPool& pool, const octree::Cell& cell, PlaneId plane) const;

    std::vector<Step> steps_;
    std::vector<Side> path_;
};

}  // namespace octavo::bsp
