// SPDX-License-Identifier: Apache-2.0
#include <octavo/bp_octree/bpo_view.hpp>
#include <octavo/bp_octree/figures.hpp>

namespace octavo::bp_octree {
namespace {

using octree::Cell;
using octree::Node;

class View {
  public:
    View(BpoReader& reader, const Refine& refine) : reader_(reader), refine_(refine) {
        tree_.mesh.lattice = reader.head().lattice;
        tree_.frame = reader.head().frame;
        tree_.is_solid = reader.head().is_solid;
        tree_.solid_volume = reader.head().solid_volume;
        tree_.level_begin = {0};
        tree_.plane_begin = {0};
        tree_.leaf_begin = {0};
    }

    Result<BpOctree> run() {
        std::vector<std::uint32_t> parents{0};
        std::vector<Cell> cells{Cell::root()};
        for (std::size_t level = 0; !parents.empty(); ++level) {
            const auto octants = reader_.octants(level, parents);
            if (!octants) return octants.error();
            std::vector<std::uint32_t> next_parents;
            std::vector<Cell> next_cells;
            for (std::size_t i = 0; i < parents.size(); ++i)
                for (int octant = 0; octant < (level == 0 ? 1 : 8); ++octant) {
                    const Cell cell = level == 0 ? cells[i] : cells[i].child(octant);
                    const auto& found = (*octants)[i];
                    const std::size_t node = found.first + static_cast<std::size_t>(octant);
                    if (!add(found, node, cell)) continue;
                    next_parents.push_back(found.split[node]);
                    next_cells.push_back(cell);
                }
            tree_.level_begin.push_back(static_cast<NodeIndex>(tree_.nodes.size()));
            parents = std::move(next_parents);
            cells = std::move(next_cells);
        }
        tree_.levels.resize(tree_.level_begin.size() - 1);
        tree_.levels = measure_levels(tree_);
        return std::move(tree_);
    }

  private:
    /// Whether the node's octants come too.
    bool add(const BpoReader::Octants& found, std::size_t node, const Cell& cell) {
        const EnvelopeChunk& chunk = *found.chunk;
        const Node kind = chunk.nodes[node];
        const bool is_refined = kind == Node::split && refine_(cell, world_box(cell));
        tree_.nodes.push_back(kind == Node::split && !is_refined ? Node::gray : kind);
        tree_.link.push_back(0);
        if (is_refined) {
            tree_.link.back() = static_cast<std::uint32_t>(1 + 8 * refined_++);
        } else if (tree_.nodes.back() == Node::gray) {
            tree_.link.back() = static_cast<std::uint32_t>(tree_.leaf_count());
            tree_.leaf_begin.push_back(0);
            tree_.leaf_winding.push_back(kind == Node::gray ? chunk.windings[found.gray[node]] : 0);
        }
        tree_.planes.insert(tree_.planes.end(), chunk.planes.begin() + chunk.plane_begin[node],
                            chunk.planes.begin() + chunk.plane_begin[node + 1]);
        tree_.plane_begin.push_back(static_cast<std::uint32_t>(tree_.planes.size()));
        return is_refined;
    }

    Box3 world_box(const Cell& cell) const {
        const CellBox box = tree_.frame.box(cell);
        const exact::Lattice& lattice = tree_.mesh.lattice;
        Box3 world;
        for (int axis = 0; axis < 3; ++axis) {
            const auto origin = static_cast<double>(lattice.origin()[static_cast<std::size_t>(axis)]);
            world.low[axis] = (origin + 0.5 * box.low[static_cast<std::size_t>(axis)]) * lattice.unit();
            world.high[axis] = (origin + 0.5 * box.high[static_cast<std::size_t>(axis)]) * lattice.unit();
        }
        return world;
    }

    BpoReader& reader_;
    const Refine& refine_;
    BpOctree tree_;
    std::size_t refined_ = 0;
};

}  // namespace

Result<BpOctree> read_view(BpoReader& reader, const Refine& refine) { return View(reader, refine).run(); }

}  // namespace octavo::bp_octree
