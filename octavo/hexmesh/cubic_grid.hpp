// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <unordered_set>
#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/hexmesh/cell_template.hpp>

// The tree of 27 of a conforming mesh: on each level, which cells are cut in 27, as sparse sets.
//
// Level 0 has the smallest cells; a cell of level k has 3^k times their side. Roots are given cells of the last level.
// A leaf is a cell that is not cut and whose parent is; its edges are cut where a cell that shares them is cut.

namespace octavo::hexmesh {

using GridPlace = std::array<std::int64_t, 3>;  ///< in cells of a level

class CubicGrid {
  public:
    static constexpr int place_bits = 21;

    /// With more than `max_leaves` leaves below roots the grid is full.
    explicit CubicGrid(int levels, std::uint64_t max_leaves = ~std::uint64_t{0});

    int last_level() const { return static_cast<int>(cut_.size()) - 1; }

    /// A cell of the last level; it may be added again.
    void add_root(const GridPlace& place) {
        if (roots_.size() >= roots_to_sort_) sort_roots();
        roots_.push_back(key_of(place));
    }
    /// Asks for cells of this level or smaller at a place below a root, given in cells of `level`.
    void refine_to(int level, const GridPlace& place) { leaves_cut_ += 26 * cut_above(level, place); }
    /// Cuts more cells until every leaf has a template, and sorts the roots. Stops early when the grid is full or
    /// the work is cancelled; the grid is of no use then.
    void close(const Context& context = {});
    /// True when there are more leaves than allowed; it never is too early, and late by the roots added since they were
    /// sorted last.
    bool is_full() const { return leaves_cut_ + sorted_roots_ > max_leaves_; }

    struct Leaf {
        int level;
        GridPlace place;
        EdgeSet cut;
    };
    /// The leaves below roots, in the order of places; call `close` before.
    template <class Visit>
    void for_each_leaf(const Visit& visit) const {
        for (const Key root : roots_) walk(last_level(), place_of(root), visit);
    }

  private:
    using Key = std::uint64_t;
    static Key key_of(const GridPlace& place);
    static GridPlace place_of(Key key);

    bool is_cut(int level, const GridPlace& place) const {
        return cut_[static_cast<std::size_t>(level)].contains(key_of(place));
    }
    EdgeSet cut_edges(int level, const GridPlace& place) const;
    bool has_template(EdgeSet cut) const { return templates_[cut]; }
    void sort_roots();
    /// Cuts the cells above a place; how many were not cut before.
    std::uint64_t cut_above(int level, GridPlace place);
    bool is_below_root(int level, GridPlace place) const;
    void close_level(int level, const Context& context);
    /// Cuts what must be cut beside a cell that is, and adds to `open` those of the same level.
    void close_beside(int level, const GridPlace& place, std::vector<Key>& open);

    template <class Visit>
    void walk(int level, const GridPlace& place, const Visit& visit) const {
        if (!is_cut(level, place)) return visit(Leaf{level, place, cut_edges(level, place)});
        for (std::int64_t child = 0; child < 27; ++child)
            walk(level - 1,
                 {3 * place[0] + child % 3, 3 * place[1] + child / 3 % 3, 3 * place[2] + child / 9}, visit);
    }

    std::vector<Key> roots_;                     ///< with repetitions until they are sorted
    std::size_t sorted_roots_ = 0;               ///< so many are sorted and without repetition
    std::size_t roots_to_sort_ = 1 << 20;        ///< sorted when there are so many
    std::uint64_t leaves_cut_ = 0, max_leaves_;  ///< what cutting added to the roots
    std::vector<std::unordered_set<Key>> cut_;   ///< per level
    std::vector<bool> templates_;                ///< per set of cut edges, whether it has one
};

}  // namespace octavo::hexmesh
