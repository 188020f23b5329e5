// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <octavo/boolean/box_tree.hpp>
#include <octavo/boolean/near_pairs.hpp>

// The pairs of triangles of the result that rounding may bring into contact, in the pairs of facets of near_pairs.hpp.
//
// Of two facets only those triangles are told that no edge parts (`parts`): seen along an axis, one lies behind its own
// edge and the other before it, farther than anything moves. Nearly all boxes of a fan of slivers meet, and this leaves
// an eighth of them to the exact tests of rounding_faults.hpp, which cost ten times as much: a cut through 16 000
// facets with 5 million such pairs takes 0.25 s instead of 0.63. Cost: about 1 µs a facet with moved corners, 5 ns any
// other, and 10 ns a pair of triangles whose boxes meet.

namespace octavo::boolean {

class NearFacets {
    /// The triangles of a facet that is in a pair.
    struct Group {
        std::uint32_t facet, begin, end, tree;
        std::uint32_t size() const { return end - begin; }
    };

  public:
    /// Facets of the soup, by which the triangles in their planes are meant.
    using Pair = NearPairs::Pair;

    NearFacets(const Surface& surface, const Soup& soup, std::span<const Pair> near,
               const RoundedPoints& rounded, const Context& context);

    /// Sorted; one of either has a triangle with a moved corner.
    const UninitialisedVector<Pair>& pairs() const { return pairs_; }
    bool empty() const { return pairs_.empty(); }

    /// The work on a pair. It has parts: the triangles of one of the facets.
    class Work {
      public:
        std::uint32_t parts() const { return few_->size(); }

      private:
        friend NearFacets;
        const Group *few_, *many_;
        bool is_first_few_;
    };
    Work work(const Pair& pair) const {
        const Group &first = group_of(pair.first),
                    &second = pair.first == pair.second ? first : group_of(pair.second);
        Work work;
        work.is_first_few_ = first.size() <= second.size();
        work.few_ = work.is_first_few_ ? &first : &second;
        work.many_ = work.is_first_few_ ? &second : &first;
        return work;
    }
    /// Calls `visit(first, second)` for the triangles of parts [begin, end) that may meet, unless they are inverted;
    /// once for two of one facet.
    template <class Visit>
    void for_each(const Work& work, std::uint32_t begin, std::uint32_t end, const Visit& visit) const {
        if (work.few_ == work.many_)
            each_within(*work.few_, begin, end, visit);
        else if (work.is_first_few_)
            each_between(*work.many_, *work.few_, begin, end,
                         [&](std::uint32_t b, std::uint32_t a) { visit(a, b); });
        else
            each_between(*work.many_, *work.few_, begin, end, visit);
    }
    template <class Visit>
    void for_each(const Pair& pair, const Visit& visit) const {
        const Work all = work(pair);
        for_each(all, 0, all.parts(), visit);
    }

  private:
    /// A triangle in lattice units, and its box with room for what mending does.
    struct Shape {
        exact::Point low, high;
        /// Of corners 0, 1, 2, 0, 1: lanes of four and those one further on are its edges.
        std::int32_t ids[5];
        double at[3][5];
        int axis;     ///< the dominant one of its plane
        double turn;  ///< how it turns seen along that, 1 or -1
    };
    bool may_meet(const Shape& a, const Shape& b) const {
        return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y &&
               a.low.z <= b.high.z && b.low.z <= a.high.z && !parts(a, b) && !parts(b, a);
    }
    /// Whether an edge of `a` has all corners of `b` that do not end it on its outer side, seen along the axis of `a`,
    /// wherever rounding and mending take them without turning `a` over.
    bool parts(const Shape& a, const Shape& b) const;

    const Group& group_of(std::uint32_t facet) const {
        return *std::lower_bound(groups_.begin(), groups_.end(), facet,
                                 [](const Group& group, std::uint32_t of) { return group.facet < of; });
    }
    template <class Visit>
    void each_within(const Group& group, std::uint32_t begin, std::uint32_t end, const Visit& visit) const {
        for (std::uint32_t i = group.begin + begin; i < group.begin + end; ++i) {
            if (group.tree != no_index) {
                trees_[group.tree].for_each_meeting(shapes_[i].low, shapes_[i].high, [&](std::uint32_t k) {
                    if (k > i && may_meet(shapes_[i], shapes_[k])) visit(triangles_[i], triangles_[k]);
                });
                continue;
            }
            for (std::uint32_t k = i + 1; k < group.end; ++k)
                if (may_meet(shapes_[i], shapes_[k])) visit(triangles_[i], triangles_[k]);
        }
    }
    /// The first is the larger one.
    template <class Visit>
    void each_between(const Group& first, const Group& second, std::uint32_t begin, std::uint32_t end,
                      const Visit& visit) const {
        for (std::uint32_t k = second.begin + begin; k < second.begin + end; ++k) {
            if (first.tree != no_index) {
                trees_[first.tree].for_each_meeting(shapes_[k].low, shapes_[k].high, [&](std::uint32_t i) {
                    if (may_meet(shapes_[i], shapes_[k])) visit(triangles_[i], triangles_[k]);
                });
                continue;
            }
            for (std::uint32_t i = first.begin; i < first.end; ++i)
                if (may_meet(shapes_[i], shapes_[k])) visit(triangles_[i], triangles_[k]);
        }
    }

    void fill_groups(const Surface& surface, const Soup& soup, const RoundedPoints& rounded,
                     std::span<const std::uint32_t> first_of, std::span<const std::uint32_t> next,
                     const Context& context);

    /// What a cancelled search has left.
    void forget();
    void find_groups(const Soup& soup, std::span<const std::uint32_t> first_of,
                     std::span<const std::uint32_t> next, const Context& context);
    static Shape shape_of(const mesh::Triangle& triangle, const RoundedPoints& rounded, std::int32_t mending,
                          int axis, double turn);
    void plant_trees(const Surface& surface, const RoundedPoints& rounded, std::int32_t mending,
                     const Context& context);

    double moved_ =
        0;  ///< how far mending may take two points apart in a coordinate, and what `Shape::at` is off by
    UninitialisedVector<Pair> pairs_;
    UninitialisedVector<Group> groups_;             ///< sorted by facet
    UninitialisedVector<std::uint32_t> triangles_;  ///< of the groups
    UninitialisedVector<Shape> shapes_;             ///< of these
    std::vector<BoxTree> trees_;  ///< of large groups; their facets are positions in `triangles_`
};

}  // namespace octavo::boolean
