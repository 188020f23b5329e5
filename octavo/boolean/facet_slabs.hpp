// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/boolean/box_tree.hpp>

// A slab about the facets below each box of a tree: a direction of its own, and how far they reach along it.
//
// Problem: long facets that lie askew have boxes that all meet. Idea: neighbours in the tree are often neighbours in a
// fan or a wall, nearly in one plane, so that a slab along their mean normal is thin; what lies on one side of it is
// apart from all of them.
// On the lowest level that is each facet's own plane.
//
// Exactness: directions are integers of up to 2^20, so that places along them are exact doubles; a slab holds its
// facets whatever its direction.
// Cost: about 0.1 µs a facet to build; 60 instructions for eight slabs.

namespace octavo::boolean {

class FacetSlabs {
  public:
    FacetSlabs() = default;
    /// Of the facets of `tree`, which are facets of `soup`.
    FacetSlabs(const Soup& soup, const BoxTree& tree);

    /// Those of the slabs `candidates` of a node (bit k is lane k) that facet `lane` of `block` meets, or comes nearer to
    /// than `reach`.
    unsigned meeting(std::uint32_t level, std::uint32_t number, const FacetBlock& block, int lane,
                     unsigned candidates, double reach) const;

  private:
    static constexpr int width = BoxNode::width;
    struct alignas(32) Node {
        double direction[3][width];
        double low[width], high[width];
        double length[width];  ///< sum of the direction's magnitudes: no less than its length
    };

    std::vector<std::vector<Node>> levels_;
};

}  // namespace octavo::boolean
