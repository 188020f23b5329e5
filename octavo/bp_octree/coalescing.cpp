// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <numeric>

#include <octavo/bp_octree/cell_split.hpp>
#include <octavo/bp_octree/coalescing.hpp>

namespace octavo::bp_octree {
namespace {

using octree::Cell;
using Triangles = std::vector<mesh::FaceIndex>;

class SplitBySiblings {
  public:
    SplitBySiblings(const mesh::LatticeMesh& mesh, const Frame& frame, int depth,
                    const SiblingCriterion& criterion, const Context& context)
        : mesh_(mesh),
          frame_(frame),
          depth_(depth),
          criterion_(criterion),
          context_(context),
          octants_(static_cast<std::size_t>(depth)) {}

    Result<std::vector<octree::CellKey>> run() {
        Triangles all(mesh_.triangles.size());
        std::iota(all.begin(), all.end(), 0U);
        joins(Cell::root(), all);
        if (context_.cancelled()) return Context::cancelled_error();
        std::sort(split_.begin(), split_.end());
        return std::move(split_);
    }

  private:
    /// Whether all below the cell, which meets these triangles, becomes one leaf.
    bool joins(const Cell& cell, const Triangles& triangles) {
        if (cell.level == depth_ || criterion_.always_joins(triangles.size()) || context_.cancelled())
            return true;
        auto& octants = octants_[static_cast<std::size_t>(cell.level)];
        for (Triangles& octant : octants) octant.clear();
        distribute(mesh_, triangles, frame_.box(cell), octants);
        std::size_t sum = 0, met = 0;
        bool all_join = true;
        for (int i = 0; i < 8; ++i) {
            const Triangles& octant = octants[static_cast<std::size_t>(i)];
            if (octant.empty()) continue;
            sum += octant.size();
            ++met;
            if (!joins(cell.child(i), octant)) all_join = false;
        }
        if (all_join && criterion_.joins(sum, met)) return true;
        split_.push_back(cell.key());
        return false;
    }

    const mesh::LatticeMesh& mesh_;
    const Frame& frame_;
    int depth_;
    SiblingCriterion criterion_;
    const Context& context_;
    std::vector<std::array<Triangles, 8>> octants_;  ///< of the cell of each level that is looked at
    std::vector<octree::CellKey> split_;
};

}  // namespace

Result<std::vector<octree::CellKey>> split_by_siblings(const mesh::LatticeMesh& mesh, const Frame& frame,
                                                       int depth, const SiblingCriterion& criterion,
                                                       const Context& context) {
    return SplitBySiblings(mesh, frame, depth, criterion, context).run();
}

}  // namespace octavo::bp_octree
