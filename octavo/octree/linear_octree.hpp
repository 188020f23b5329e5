// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/octree/cell.hpp>
#include <octavo/octree/octree.hpp>

// A linear octree: the leaves as sorted keys with their colours, for random access.
//
// Nine bytes a leaf instead of the DF code's quarter, and in return a point is located by one look into a table of
// the top levels and a binary search of the few leaves below that entry, and neighbours are key arithmetic and a
// location. Leaves fill the universe, are disjoint and sorted in Morton order.
// Source: I. Gargantini, An effective way to represent quadtrees, 1982.

namespace octavo::octree {

using LeafIndex = std::uint32_t;

/// Leaves [begin, end).
struct LeafRange {
    LeafIndex begin = 0, end = 0;
    friend bool operator==(const LeafRange&, const LeafRange&) = default;
};

class LinearOctree {
  public:
    /// Errors: limit beyond 2^32 − 2 leaves.
    static Result<LinearOctree> from(const Octree& octree);

    /// The DF code of the same tree.
    Octree to_octree() const;

    const exact::Lattice& lattice() const { return lattice_; }
    int depth() const { return depth_; }
    LeafIndex size() const { return static_cast<LeafIndex>(keys_.size()); }
    const std::vector<CellKey>& keys() const { return keys_; }
    const std::vector<Color>& colors() const { return colors_; }
    CellKey key(LeafIndex leaf) const { return keys_[leaf]; }
    Color color(LeafIndex leaf) const { return colors_[leaf]; }

    /// The leaf that contains a lattice point of the universe (low sides belong to a leaf).
    LeafIndex locate(exact::Point p) const { return leaf_at(CellKey::at(p, max_level)); }
    /// The same for many points, in the order given; parallel.
    std::vector<LeafIndex> locate(std::span<const exact::Point> points, const Context& context = {}) const;

    /// The one leaf that contains the cell, or else the leaves inside it.
    LeafRange leaves_of(CellKey cell) const;

    /// The leaves in the cell of the leaf's size that is its neighbour in the given direction (−1, 0 or 1 an axis):
    /// one leaf when it is of that size or larger, all that lie in it when they are smaller. Empty outside the
    /// universe.
    LeafRange neighbours(LeafIndex leaf, int dx, int dy, int dz) const;

  private:
    LeafIndex leaf_at(CellKey key) const;

    exact::Lattice lattice_;
    int depth_ = 0;
    std::vector<CellKey> keys_;
    std::vector<Color> colors_;
    int top_level_ = 0;
    /// For each cell of `top_level_` in Morton order, the leaf that contains its first lattice point; one more.
    std::vector<LeafIndex> top_;
};

}  // namespace octavo::octree
