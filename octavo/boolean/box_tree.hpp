// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/base/uninitialised.hpp>
#include <octavo/boolean/facet_filter.hpp>
#include <octavo/boolean/soup.hpp>

// A pointer-free tree of boxes over some facets of a soup, in the order of an octree.
//
// Facets are sorted along the Morton curve of their box centres; eight neighbours in that order form a node, eight
// nodes form a node of the next level, and so on: an octree's order with full nodes, so that a node is eight
// boxes side by side in memory and is compared with a box in one go.
//
// Cost: 72 bytes and about 60 ns a facet to build.

namespace octavo::boolean {

/// Eight boxes side by side.
struct alignas(32) BoxNode {
    static constexpr int width = FacetBlock::width;
    std::int32_t low[3][width], high[3][width];
};

/// About a facet.
struct FacetBox {
    FacetBox(const mesh::Triangle& corners, std::span<const exact::Point> places) {
        const exact::Point a = places[corners[0]], b = places[corners[1]], c = places[corners[2]];
        low = {std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}), std::min({a.z, b.z, c.z})};
        high = {std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}), std::max({a.z, b.z, c.z})};
    }
    exact::Point low, high;
};

/// Bit k: box k of `node` meets box `lane` of `other`.
unsigned meeting(const BoxNode& node, const BoxNode& other, int lane);

class BoxTree {
  public:
    static constexpr int width = BoxNode::width;

    /// A facet with a key by which facets are sorted: along the Morton curve of the centres of their boxes.
    struct Keyed {
        std::uint32_t key, facet;
    };
    static std::uint32_t key_of(const FacetBox& box);

    /// Where boxes are: made of the soup's points, or of others for these, and larger by the margin along each axis.
    struct Room {
        std::span<const exact::Point> places;
        std::array<std::int32_t, 3> margin;
    };

    BoxTree() = default;
    /// Of the facets listed; boxes are larger by `margin` on every side.
    BoxTree(const Soup& soup, std::vector<std::uint32_t> facets, std::int32_t margin, const Context& context);
    /// Of facets whose keys are known. `spread` tells of vertices what blocks note of them; none are when it is empty.
    BoxTree(const Soup& soup, UninitialisedVector<Keyed> keyed, const Room& room, const Context& context,
            std::span<const char> spread = {});

    /// Calls `visit(facet)` for the facets whose boxes meet the closed box from `low` to `high`.
    template <class Visit>
    void for_each_meeting(exact::Point low, exact::Point high, const Visit& visit) const {
        if (empty()) return;
        BoxNode probe;
        for (int axis = 0; axis < 3; ++axis) probe.low[axis][0] = low[axis], probe.high[axis][0] = high[axis];
        for_each_meeting(probe, top(), 0, visit);
    }

    /// Node n of level 0 holds the facets at positions 8 n to 8 n + 7; box k of node n of a higher level holds
    /// node 8 n + k of the level below. The highest level has one node.
    bool empty() const { return facets_.empty(); }
    std::size_t size() const { return facets_.size(); }
    std::uint32_t facet(std::size_t position) const { return facets_[position]; }
    std::uint32_t top() const { return static_cast<std::uint32_t>(levels_.size() - 1); }
    const BoxNode& node(std::uint32_t level, std::uint32_t number) const { return levels_[level][number]; }
    const FacetBlock& block(std::uint32_t number) const { return blocks_[number]; }
    /// After this there are none; what is left finds facets by boxes.
    void forget_blocks() { blocks_ = {}; }

  private:
    template <class Visit>
    void for_each_meeting(const BoxNode& probe, std::uint32_t level, std::uint32_t number,
                          const Visit& visit) const {
        for (unsigned hits = meeting(node(level, number), probe, 0); hits; hits &= hits - 1) {
            const std::uint32_t child = number * width + static_cast<std::uint32_t>(std::countr_zero(hits));
            if (level == 0)
                visit(facets_[child]);
            else
                for_each_meeting(probe, level - 1, child, visit);
        }
    }
    void fill_blocks(const Soup& soup, const Room& room, std::span<const char> spread,
                     const Context& context);
    void build_levels(const Context& context);

    UninitialisedVector<std::uint32_t> facets_;
    UninitialisedVector<FacetBlock> blocks_;
    std::vector<UninitialisedVector<BoxNode>> levels_;
};

}  // namespace octavo::boolean
