// SPDX-License-Identifier: Apache-2.0
#include <octavo/hexmesh/cell_tree.hpp>

namespace octavo::hexmesh {

CellTree::CellTree(std::span<const octree::CellKey> leaves) : leaves_(leaves) {
    OCTAVO_CHECK(leaves.size() <= most_leaves, "a cell tree holds less than 2^31 leaves");
    inner_.reserve(leaves.size() / 7 + octree::max_level);
    std::size_t next = 0;
    root_ = build(octree::CellKey::root(), next);
    OCTAVO_CHECK(next == leaves.size(), "the leaves of a cell tree are sorted and disjoint");
}

CellTree::Ref CellTree::build(octree::CellKey cell, std::size_t& next) {
    if (next == leaves_.size() || cell.last_descendant() < leaves_[next]) return none;
    if (leaves_[next] == cell) return static_cast<Ref>(next++);
    const std::size_t index = inner_.size();
    inner_.emplace_back();
    if (cell.level() == octree::max_level) return none;  // unsorted input: the check above tells
    for (int octant = 0; octant < 8; ++octant) {
        const Ref ref = build(cell.child(octant), next);
        inner_[index][static_cast<std::size_t>(octant)] = ref;
    }
    return static_cast<Ref>(index) | inner_bit;
}

}  // namespace octavo::hexmesh
