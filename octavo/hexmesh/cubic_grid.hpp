// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <unordered_set>
#include <vector>

#include <octavo/hexmesh/cell_template.hpp>

// The tree of 27 of a conforming mesh: on each level, which cells are cut in 27, as sparse sets.
//
// Level 0 has the smallest cells; a cell of level k has 3^k times their side. Roots are given cells of the last level. A leaf is a cell that is not cut and whose parent is; its edges are cut where a cell that shares them is cut.

namespace octavo::hexmesh {

using GridPlace = std::array<std::int64_t, 3>;  ///< in cells of a level

class CubicGrid {
  public:
    static constexpr int place_bits = 21;

    explicit CubicGrid(int levels);

    int last_level() const { return static_cast<int>(cut_.size()) - 1; }

    /// A cell of the last level.
    void add_root(const GridPlace& place) { roots_.push_back(key_of(place)); }
    /// Asks for cells of this level or smaller at a place given in cells of `level`.
    void refine_to(int level, GridPlace place);
    /// Cuts more cells until every leaf has a template, and sorts the roots.
    void close();

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
    void close_level(int level);

    template <class Visit>
    void walk(int level, const GridPlace& place, const Visit& visit) const {
        if (!is_cut(level, place)) return visit(Leaf{level, place, cut_edges(level, place)});
        for (std::int64_t child = 0; child < 27; ++child)
            walk(level - 1,
                 {3 * place[0] + child % 3, 3 * place[1] + child / 3 % 3, 3 * place[2] + child / 9}, visit);
    }

    std::vector<Key> roots_;
    std::vector<std::unordered_set<Key>> cut_;  ///< per level
    std::vector<bool> templates_;               ///< per set of cut edges, whether it has one
};

}  // namespace octavo::hexmesh
