// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <octavo/bp_octree/figures.hpp>

namespace octavo::bp_octree {
namespace {

using octree::Node;

class Measuring {
  public:
    Measuring(const BpOctree& tree, const Context& context)
        : tree_(tree),
          context_(context),
          levels_(tree.levels.size()),
          split_(levels_.size(), 0),
          leaf_(levels_.size(), 0) {}

    std::vector<LevelFigures> run() {
        Polytope cell;
        cell.make_cell();
        visit(0, 0, std::move(cell));
        double settled = 0;
        for (std::size_t level = 0; level < levels_.size(); ++level) {
            double volume = 1;
            for (int axis = 0; axis < 3; ++axis)
                volume *= std::ldexp(
                    tree_.frame.side(axis, static_cast<int>(level)) * tree_.mesh.lattice.unit(), -1);
            settled += (leaf_[level] + static_cast<double>(levels_[level].black)) * volume;
            levels_[level].volume = settled + split_[level] * volume;
        }
        return std::move(levels_);
    }

  private:
    void visit(NodeIndex node, std::size_t level, Polytope shape) {
        if (context_.cancelled()) return;
        LevelFigures& figures = levels_[level];
        const Node kind = tree_.nodes[node];
        if (kind == Node::white || kind == Node::black) {
            ++(kind == Node::white ? figures.white : figures.black);
            return;
        }
        for (const BoundingPlane& plane : tree_.planes_of(node))
            shape.clip(plane.half_space(), Polytope::cell_faces);
        figures.planes += tree_.planes_of(node).size();
        const double volume =
            shape.volume() / (Polytope::cell_side * Polytope::cell_side * Polytope::cell_side);
        if (kind == Node::gray) {
            ++figures.gray;
            leaf_[level] += volume;
            return;
        }
        ++figures.split;
        split_[level] += volume;
        for (int i = 0; i < 8; ++i) {
            Polytope part;
            part.assign_octant(shape, i);
            visit(tree_.link[node] + static_cast<unsigned>(i), level + 1, std::move(part));
        }
    }

    const BpOctree& tree_;
    const Context& context_;
    std::vector<LevelFigures> levels_;
    std::vector<double> split_, leaf_;  ///< volumes of envelopes, in cells
};

}  // namespace

std::vector<LevelFigures> measure_levels(const BpOctree& tree, const Context& context) {
    return Measuring(tree, context).run();
}

}  // namespace octavo::bp_octree
