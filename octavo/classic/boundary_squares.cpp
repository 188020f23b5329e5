// SPDX-License-Identifier: Apache-2.0
#include <utility>

#include <octavo/base/grouped.hpp>
#include <octavo/classic/boundary_squares.hpp>
#include <octavo/octree/cell.hpp>

namespace octavo::classic {
namespace {

using octree::Cell;
using octree::Node;

class Faces {
  public:
    Faces(const octree::Octree& octree, std::array<bool, 3> solid) : solid_(solid) { unfold(octree.code()); }

    std::vector<BoundarySquare> run() {
        inside({0, Cell::root()});
        for (int axis = 0; axis < 3; ++axis) {
            between({0, Cell::root()}, beyond, axis);
            between(beyond, {0, Cell::root()}, axis);
        }
        return std::move(squares_);
    }

  private:
    static constexpr std::uint32_t leaf = most_unfolded_nodes;  // plus solid or not
    struct Place {
        std::uint32_t node;
        Cell cell;
    };
    static constexpr Place beyond{0xFFFFFFFFU, {}};

    /// nodes_[i] is a leaf's colour, or where its eight octants begin.
    void unfold(const octree::DfCode& code) {
        nodes_.resize(1);
        std::vector<std::pair<std::uint32_t, int>> open;  // first octant, octants done
        std::uint32_t target = 0;
        for (std::size_t i = 0; i < code.size(); ++i) {
            if (is_leaf(code[i])) {
                nodes_[target] = leaf + (solid_[static_cast<std::size_t>(code[i])] ? 1 : 0);
            } else {
                nodes_[target] = static_cast<std::uint32_t>(nodes_.size());
                open.emplace_back(nodes_[target], -1);
                nodes_.resize(nodes_.size() + 8);
            }
            while (!open.empty() && ++open.back().second == 8) open.pop_back();
            if (!open.empty()) target = open.back().first + static_cast<std::uint32_t>(open.back().second);
        }
    }

    bool is_split(Place p) const { return p.node != beyond.node && nodes_[p.node] < leaf; }
    bool is_solid(Place p) const { return p.node != beyond.node && nodes_[p.node] == leaf + 1; }
    Place octant(Place p, int index) const {
        return {nodes_[p.node] + static_cast<std::uint32_t>(index), p.cell.child(index)};
    }

    /// Faces between the octants of a cell, and inside them.
    void inside(Place p) {
        if (!is_split(p)) return;
        for (int i = 0; i < 8; ++i) inside(octant(p, i));
        for (int axis = 0; axis < 3; ++axis)
            for (int i = 0; i < 8; ++i)
                if (!(i >> axis & 1)) between(octant(p, i), octant(p, i | 1 << axis), axis);
    }

    /// The face that `low` and `high`, in this order along the axis, share; one may be `beyond` the universe.
    void between(Place low, Place high, int axis) {
        if (!is_split(low) && !is_split(high)) return add(low, high, axis);
        for (int i = 0; i < 8; ++i) {
            if (i >> axis & 1) continue;
            between(is_split(low) ? octant(low, i | 1 << axis) : low, is_split(high) ? octant(high, i) : high,
                    axis);
        }
    }

    void add(Place low, Place high, int axis) {
        if (is_solid(low) == is_solid(high)) return;
        const bool low_is_finer =
            high.node == beyond.node || (low.node != beyond.node && low.cell.level >= high.cell.level);
        const Cell& cell = low_is_finer ? low.cell : high.cell;
        BoundarySquare square;
        for (int a = 0; a < 3; ++a) square.low[static_cast<std::size_t>(a)] = cell.low[a];
        square.side = cell.side();
        if (low_is_finer) square.low[static_cast<std::size_t>(axis)] += cell.side();
        square.axis = static_cast<std::uint8_t>(axis);
        square.faces_up = is_solid(low);
        squares_.push_back(square);
    }

    std::array<bool, 3> solid_;
    std::vector<std::uint32_t> nodes_;
    std::vector<BoundarySquare> squares_;
};

}  // namespace

Result<std::vector<BoundarySquare>> boundary_squares(const octree::Octree& octree,
                                                     std::array<bool, 3> solid) {
    if (octree.code().size() > most_unfolded_nodes)
        return Error{ErrorCode::limit,
                     "the octree has " + grouped(octree.code().size()) +
                         " nodes, more than its boundary can be made of: " + grouped(most_unfolded_nodes),
                     {}};
    return Faces(octree, solid).run();
}

}  // namespace octavo::classic
