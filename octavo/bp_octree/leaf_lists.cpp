// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <numeric>

#include <octavo/bp_octree/cell_split.hpp>
#include <octavo/bp_octree/leaf_lists.hpp>

namespace octavo::bp_octree {
namespace {

using octree::Cell;
using octree::Node;

class LeafLists {
  public:
    LeafLists(BpOctree& tree, const Context& context)
        : tree_(tree), context_(context), lists_(tree.leaf_count()), buffers_(tree.levels.size()) {}

    Status run() {
        std::vector<mesh::FaceIndex> all(tree_.mesh.triangles.size());
        std::iota(all.begin(), all.end(), 0U);
        const bool agrees = all_points_in_root() && visit(0, Cell::root(), all);
        if (context_.cancelled()) return Context::cancelled_error();
        if (references_ > limit())
            return Error{ErrorCode::limit, "the leaves of the BP-octree hold too many triangles", {}};
        if (!agrees)
            return Error{ErrorCode::bad_input, "the tree and its triangles do not belong together", {}};
        tree_.leaf_begin.assign(1, 0);
        tree_.leaf_triangles.clear();
        for (const auto& list : lists_) {
            tree_.leaf_triangles.insert(tree_.leaf_triangles.end(), list.begin(), list.end());
            tree_.leaf_begin.push_back(static_cast<std::uint32_t>(tree_.leaf_triangles.size()));
        }
        return Done{};
    }

  private:
    /// A triangle beside the root's cell would be in no leaf, and lost when the tree is written.
    bool all_points_in_root() const {
        const CellBox root = tree_.frame.box(Cell::root());
        for (const exact::Point p : tree_.mesh.points)
            for (int axis = 0; axis < 3; ++axis) {
                const auto i = static_cast<std::size_t>(axis);
                if (2 * p[axis] < root.low[i] || 2 * p[axis] > root.high[i]) return false;
            }
        return true;
    }

    bool visit(NodeIndex node, const Cell& cell, const std::vector<mesh::FaceIndex>& triangles) {
        switch (tree_.nodes[node]) {
            case Node::white:
            case Node::black:
                return triangles.empty();
            case Node::gray:
                references_ += triangles.size();
                if (references_ > limit()) return false;
                lists_[tree_.link[node]] = triangles;
                return !triangles.empty();
            case Node::split:
                break;
        }
        if (context_.cancelled()) return false;
        auto& octants = buffers_[static_cast<std::size_t>(cell.level)];
        for (auto& octant : octants) octant.clear();
        distribute(tree_.mesh, triangles, tree_.frame.box(cell), octants);
        for (unsigned i = 0; i < 8; ++i)
            if (!visit(tree_.link[node] + i, cell.child(static_cast<int>(i)), octants[i])) return false;
        return true;
    }

    /// Files say nothing of lists, so a small file could ask for any amount of memory; trees that `build` makes of
    /// more than a few triangles stay far below this.
    std::size_t limit() const { return std::max(std::size_t{1} << 26, 256 * tree_.mesh.triangles.size()); }

    BpOctree& tree_;
    const Context& context_;
    std::size_t references_ = 0;
    std::vector<std::vector<mesh::FaceIndex>> lists_;
    std::vector<std::array<std::vector<mesh::FaceIndex>, 8>>
        buffers_;  ///< a level's octants, while they are visited
};

}  // namespace

Status fill_leaf_lists(BpOctree& tree, const Context& context) { return LeafLists(tree, context).run(); }

}  // namespace octavo::bp_octree
