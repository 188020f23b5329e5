// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <octavo/boolean/soup.hpp>

// A pointer-free tree of boxes over the facets of a soup, in the order of an octree.
//
// Facets are sorted along the Morton curve of their box centres; eight neighbours in that order form a node, eight
// nodes form a node of the next level, and so on: an octree's order with full nodes, so that a node is eight
// boxes side by side in memory and is compared with a box in one go. Finding all pairs of boxes that meet is one
// descent of the tree against itself.
//
// A second test throws out most pairs that only have boxes in common: all corners of one on one side of the other's
// plane, eight facets at a time, at about 4 ns a pair. It is what makes fans of thousands of slivers bearable, whose
// boxes all meet. We tried to clip long facets to cells that they really cross; it lost, because slivers of one fan
// are neighbours in every cell along their length, and each cell paid for them again.
// Cost: 80 bytes and about 80 ns a facet to build.

namespace octavo::boolean {

class FacetTree {
  public:
    static constexpr int width = 8;

    struct alignas(32) Node {
        std::int32_t low[3][width];
        std::int32_t high[3][width];
    };

    /// The facets of a node of level 0, side by side for comparing one facet with all eight.
    struct alignas(32) Leaf {
        std::int32_t point[3][3][width];  ///< corner, axis, lane
        std::uint32_t corner[3][width];
    };

    /// A facet, ready to be compared with eight others at once.
    ///
    /// The normal is exact in doubles, and so are differences of coordinates; a product of 53 and 26 bits rounds
    /// once and two sums round, so a corner's value on the plane is off by at most 4u 2^26 (|a| + |b| + |c|), and
    /// `bound` is twice that.
    struct PlaneFilter {
        double normal[3];
        double bound;
        std::int32_t at[3];  ///< a corner
        std::uint32_t corner[3];

        PlaneFilter(const Leaf& leaf, int lane);
        /// Bit k: facet k of the leaf is not known to have all corners that are not shared on one side.
        unsigned undecided(const Leaf& leaf) const;
    };

    FacetTree() = default;
    explicit FacetTree(const Soup& soup);

    /// Nodes of level 0 hold facets: lane k of node n is facet `facet(8 n + k)`, if that is less than `size()`.
    std::size_t size() const { return order_.size(); }
    std::uint32_t facet(std::size_t position) const { return order_[position]; }

    /// A part of the self-intersection of the tree: nodes `first` <= `second` of one level, all pairs between
    /// them.
    struct Task {
        std::uint32_t level, first, second;
    };
    /// All pairs of boxes of the tree, as at least about `count` independent tasks where there are that many.
    std::vector<Task> pair_tasks(std::size_t count) const;

    /// Calls `visit(position, position)` for the pairs of facets of the task that may meet: their boxes do, and
    /// the second has not all its corners on one side of the first's plane (corners they share aside).
    template <class Visit>
    void for_each_pair(const Task& task, const Visit& visit) const {
        pairs(task.level, task.first, task.second, visit);
    }

    /// Calls `visit(facet)` for each facet whose box meets the ray from `point` along `axis`, in the direction of
    /// `sign`.
    template <class Visit>
    void for_each_on_ray(exact::Point point, int axis, int sign, const Visit& visit) const {
        if (!levels_.empty()) ray(levels_.size() - 1, 0, point, axis, sign, visit);
    }

  private:
    /// Bit k: box k of `node` meets box `lane` of `other`.
    static unsigned meeting(const Node& node, const Node& other, int lane);

    template <class Visit>
    void pairs(std::uint32_t level, std::uint32_t first, std::uint32_t second, const Visit& visit) const {
        const Node& node = levels_[level][first];
        const Node& other = levels_[level][second];
        for (int lane = 0; lane < width; ++lane) {
            unsigned hits = meeting(other, node, lane);
            if (first == second) hits &= level == 0 ? ~1u << lane : ~0u << lane;
            if (level == 0 && hits) hits &= PlaneFilter(leaves_[first], lane).undecided(leaves_[second]);
            for (; hits; hits &= hits - 1) {
                const auto hit = static_cast<std::uint32_t>(__builtin_ctz(hits));
                const std::uint32_t a = first * width + static_cast<std::uint32_t>(lane),
                                    b = second * width + hit;
                if (level == 0)
                    visit(a, b);
                else
                    pairs(level - 1, a, b, visit);
            }
        }
    }

    template <class Visit>
    void ray(std::size_t level, std::uint32_t number, exact::Point point, int axis, int sign,
             const Visit& visit) const {
        const Node& node = levels_[level][number];
        const int i = (axis + 1) % 3, j = (axis + 2) % 3;
        for (std::uint32_t lane = 0; lane < width; ++lane) {
            const bool meets =
                node.low[i][lane] <= point[i] && point[i] <= node.high[i][lane] &&
                node.low[j][lane] <= point[j] && point[j] <= node.high[j][lane] &&
                (sign > 0 ? node.high[axis][lane] >= point[axis] : node.low[axis][lane] <= point[axis]);
            if (!meets) continue;
            if (level == 0)
                visit(order_[number * width + lane]);
            else
                ray(level - 1, number * width + lane, point, axis, sign, visit);
        }
    }

    std::vector<std::uint32_t> order_;
    std::vector<Leaf> leaves_;
    std::vector<std::vector<Node>> levels_;
};

}  // namespace octavo::boolean
