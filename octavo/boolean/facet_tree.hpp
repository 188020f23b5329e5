// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include <octavo/boolean/box_tree.hpp>
#include <octavo/boolean/long_facets.hpp>

// Finds the pairs of facets of a soup that may meet, and the facets on a ray.
//
// Facets of ordinary size are in one tree of boxes; all pairs of boxes that meet are found in one descent of the
// tree against itself. *Long* facets, those whose box is much larger than the facets of an even mesh would be, are in
// a tree of their own: among the others they would blow up the boxes of whole nodes, and with them the number
// of pairs. Each long facet descends both trees by itself (long_facets.hpp). Bundles of slivers do so in trees of their
// own of what is about them, in coordinates along and across the bundle (turned_frame.hpp). So a fan of slivers costs
// what the slivers come near, not the product of all that their boxes overlap.
//
// What is left of pairs whose boxes meet goes through facet_filter.hpp.

namespace octavo::boolean {

class FacetTree {
  public:
    FacetTree() = default;
    /// With a `reach`, pairs that come nearer to each other than that, in lattice units, are found as well. `spread`
    /// are the vertices of which that is known with the same reach (stars.hpp), which saves most of the search.
    explicit FacetTree(const Soup& soup, const Context& context = {}, double reach = 0,
                       std::span<const char> spread = {});

    /// A part of all pairs: either nodes `first` <= `second` of one level of the ordinary facets, or the long
    /// facets at the positions [first, second).
    struct Task {
        std::uint32_t level, first, second;
        std::uint32_t bundle = no_index;  ///< that long facets are of, if any
    };
    static constexpr std::uint32_t long_facets = no_index;  ///< as a task's level

    /// All pairs, as at least about `count` independent tasks where there are that many.
    std::vector<Task> pair_tasks(std::size_t count) const;

    /// Calls `visit(facet, facet)` for the pairs of the task that may have more in common than corners and edges
    /// that they share.
    template <class Visit>
    void for_each_pair(const Task& task, const Visit& visit) const {
        if (task.level != long_facets) {
            CurrentPlanes planes;
            pairs(task.level, task.first, task.second, planes, visit);
            return;
        }
        if (task.bundle == no_index) {
            LongFacets(long_, nullptr, reach_).for_each_pair(task.first, task.second, ordinary_, visit);
        } else {
            const BundleTrees& bundle = bundles_[task.bundle];
            LongFacets(bundle.own, &bundle.frame, reach_)
                .for_each_pair(task.first, task.second, bundle.others, visit);
        }
    }

    /// Gives back the memory that only pairs are found by.
    void forget_pairs() {
        ordinary_.forget_blocks();
        long_.forget_blocks();
        bundles_ = {};
    }

    /// Calls `visit(facet)` for each facet whose box meets a ray that starts in the box from `low` to `high` and runs
    /// along `axis`, in the direction of `sign`.
    template <class Visit>
    void for_each_on_ray(exact::Point low, exact::Point high, int axis, int sign, const Visit& visit) const {
        for (const BoxTree* tree : {&ordinary_, &long_, &bundled_})
            if (!tree->empty()) ray(*tree, tree->top(), 0, {low, high}, axis, sign, visit);
    }

  private:
    static constexpr int width = BoxTree::width;

    /// In the bundle's frame: its facets, and all others in its box but those in bundles before it.
    struct BundleTrees {
        TurnedFrame frame;
        BoxTree own, others;
    };

    /// `is_left` tells of the facets that are in no bundle yet.
    void add_bundle(const Soup& soup, const Bundle& bundle, std::vector<char>& is_left,
                    const Context& context, std::span<const char> spread);

    /// The planes of the block that was compared last: blocks come with several partners in a row.
    struct CurrentPlanes {
        std::uint32_t block = no_index;
        FacetPlanes planes;
    };

    template <class Visit>
    void pairs(std::uint32_t level, std::uint32_t first, std::uint32_t second, CurrentPlanes& current,
               const Visit& visit) const {
        const BoxNode& node = ordinary_.node(level, first);
        const BoxNode& other = ordinary_.node(level, second);
        unsigned lanes = (1u << width) - 1;
        if (first != second)  // those that meet the box about the other node: of neighbours a few
            lanes =
                meeting(node, ordinary_.node(level + 1, second / width), static_cast<int>(second % width));
        for (; lanes; lanes &= lanes - 1) {
            const int lane = std::countr_zero(lanes);
            unsigned hits = meeting(other, node, lane);
            if (first == second) hits &= level == 0 ? ~1u << lane : ~0u << lane;
            if (!hits) continue;
            const std::uint32_t a = first * width + static_cast<std::uint32_t>(lane);
            if (level > 0) {
                for (; hits; hits &= hits - 1)
                    pairs(level - 1, a, second * width + static_cast<std::uint32_t>(std::countr_zero(hits)),
                          current, visit);
                continue;
            }
            if (ordinary_.block(first).has_spread_corner(lane)) {
                hits &= ~sharing_spread(ordinary_.block(first), lane, ordinary_.block(second));
                if (!hits) continue;
            }
            if (current.block != first) current = {first, FacetPlanes(ordinary_.block(first), reach_)};
            hits =
                may_meet(ordinary_.block(first), current.planes, lane, ordinary_.block(second), hits, reach_);
            for (; hits; hits &= hits - 1)
                visit(ordinary_.facet(a),
                      ordinary_.facet(second * width + static_cast<std::uint32_t>(std::countr_zero(hits))));
        }
    }

    struct Start {
        exact::Point low, high;
    };
    template <class Visit>
    void ray(const BoxTree& tree, std::uint32_t level, std::uint32_t number, const Start& start, int axis,
             int sign, const Visit& visit) const {
        const BoxNode& node = tree.node(level, number);
        const int i = (axis + 1) % 3, j = (axis + 2) % 3;
        for (std::uint32_t lane = 0; lane < width; ++lane) {
            const bool meets = node.low[i][lane] <= start.high[i] && start.low[i] <= node.high[i][lane] &&
                               node.low[j][lane] <= start.high[j] && start.low[j] <= node.high[j][lane] &&
                               (sign > 0 ? node.high[axis][lane] >= start.low[axis]
                                         : node.low[axis][lane] <= start.high[axis]);
            if (!meets) continue;
            if (level == 0)
                visit(tree.facet(number * width + lane));
            else
                ray(tree, level - 1, number * width + lane, start, axis, sign, visit);
        }
    }

    double reach_ = 0;
    BoxTree ordinary_, long_;
    std::vector<BundleTrees> bundles_;
    BoxTree bundled_;  ///< upright boxes of the facets in bundles
};

}  // namespace octavo::boolean
