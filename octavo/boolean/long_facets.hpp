// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>

#include <octavo/boolean/box_tree.hpp>
#include <octavo/boolean/facet_prism.hpp>

// What long facets may meet, each searched for by itself: it is a small part of what the facet's box holds.
//
// Each descends the tree past the boxes that its plane and edges miss; what is left goes through facet_filter.hpp.
// Tried and lost: the planes at all levels; they hardly ever miss larger nodes, in turned frames either. To cut long
// facets into the cells that they cross: slivers of one fan are neighbours in every cell along their length, and each
// cell pays for them again. And slabs about the long facets below each box, along their mean normal: 3 % of the time of
// the worst pair of fans, which a page of code is too much for.

namespace octavo::boolean {

class LongFacets {
  public:
    /// Of the facets of the tree `own`. All trees are in one frame, upright unless `frame` says which.
    LongFacets(const BoxTree& own, const TurnedFrame* frame, double reach)
        : own_(own), frame_(frame), reach_(reach) {}

    /// Calls `visit(facet, other)` for the facets at the positions [first, second) of their tree, with facets of
    /// `others` and with those behind them in their own.
    template <class Visit>
    void for_each_pair(std::uint32_t first, std::uint32_t second, const BoxTree& others,
                       const Visit& visit) const {
        for (std::uint32_t position = first; position < second; ++position) {
            const One one(*this, position);
            descend(one, others, 0, visit);
            descend(one, own_, position + 1, visit);
        }
    }

  private:
    static constexpr int width = BoxTree::width;

    /// One of them.
    struct One {
        One(const LongFacets& all, std::uint32_t position)
            : facet(all.own_.facet(position)),
              lane(static_cast<int>(position % width)),
              block(all.own_.block(position / width)),
              box(all.own_.node(0, position / width)),
              has_spread_corner(block.has_spread_corner(lane)),
              planes(block, all.reach_),
              prism(block, lane, all.reach_),
              prism_in_frame(all.frame_ ? prism.turned(*all.frame_) : prism) {}
        std::uint32_t facet;
        int lane;
        const FacetBlock& block;
        const BoxNode& box;
        bool has_spread_corner;
        FacetPlanes planes;
        FacetPrism prism, prism_in_frame;
    };

    /// With the facets of `tree` from position `begin` on.
    template <class Visit>
    void descend(const One& one, const BoxTree& tree, std::size_t begin, const Visit& visit) const {
        if (!tree.empty()) descend(one, tree, begin, tree.top(), 0, visit);
    }
    template <class Visit>
    void descend(const One& one, const BoxTree& tree, std::size_t begin, std::uint32_t level,
                 std::uint32_t number, const Visit& visit) const {
        const BoxNode& node = tree.node(level, number);
        unsigned hits = meeting(node, one.box, one.lane);
        if (level == 0 && begin > number * width) hits &= ~0u << (begin - number * width);
        if (level > 0) {
            // Upright boxes of other slivers, and all larger nodes, are such that the planes hardly ever miss them.
            if (level == 1 && (frame_ || &tree != &own_)) hits = one.prism_in_frame.meeting(node, hits);
        } else if (hits) {
            if (one.has_spread_corner) hits &= ~sharing_spread(one.block, one.lane, tree.block(number));
            if (hits) hits = across_plane(one.block, one.planes, one.lane, tree.block(number), hits);
            if (hits) hits = one.prism.meeting(tree.block(number), hits);
            if (hits) hits = not_parted(one.block, one.lane, tree.block(number), hits, reach_);
        }
        for (; hits; hits &= hits - 1) {
            const std::uint32_t child = number * width + static_cast<std::uint32_t>(std::countr_zero(hits));
            if (level == 0)
                visit(one.facet, tree.facet(child));
            else if ((std::size_t{child} + 1) << (3 * level) > begin)
                descend(one, tree, begin, level - 1, child, visit);
        }
    }

    const BoxTree& own_;
    const TurnedFrame* frame_;
    double reach_;
};

}  // namespace octavo::boolean
