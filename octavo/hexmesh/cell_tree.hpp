// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <octavo/octree/morton.hpp>

// The tree above sorted leaves, and the walk that knows each leaf's neighbours on the high sides.
//
// Searching a sorted list for each neighbour costs a dozen dependent loads. Instead the walk goes down the tree and
// carries, for the node it visits, the eight nodes at offsets {0, 1}³ of its size: those of a child are children of
// its parent's. So a neighbour costs one load, and the corner, edges and faces that a leaf shares on its high sides
// are all seen at once (T. Ju and others, Dual contouring of Hermite data, 2002, walk faces and edges alike).
//
// Cost: 4.6 bytes a leaf for a complete tree. Leaves may leave gaps, which read as `none` like the outside.

namespace octavo::hexmesh {

namespace cell_tree_detail {

/// A cell at an offset {0, 1, 2}³ in half sides, as an octant of one of the eight nodes of a block.
struct GridCell {
    std::uint8_t node, octant;
};
constexpr std::array<GridCell, 27> make_grid_cells() {
    std::array<GridCell, 27> cells{};
    for (unsigned i = 0; i < 27; ++i) {
        const unsigned x = i % 3, y = i / 3 % 3, z = i / 9;
        cells[i] = {static_cast<std::uint8_t>(x / 2 + 2 * (y / 2) + 4 * (z / 2)),
                    static_cast<std::uint8_t>(x % 2 + 2 * (y % 2) + 4 * (z % 2))};
    }
    return cells;
}
inline constexpr std::array<GridCell, 27> grid_cells = make_grid_cells();

}  // namespace cell_tree_detail

class CellTree {
  public:
    /// A leaf by its index, an inner node, or nothing.
    using Ref = std::uint32_t;
    static constexpr Ref none = ~Ref{0};
    static constexpr Ref inner_bit = Ref{1} << 31;
    /// Leaves that fit: every inner node of a complete tree has seven leaves.
    static constexpr std::size_t most_leaves = inner_bit - 2;

    static constexpr bool is_inner(Ref ref) { return ref >= inner_bit && ref != none; }
    static constexpr bool is_leaf(Ref ref) { return ref < inner_bit; }

    /// `leaves` are sorted and disjoint; at most `most_leaves`. They must outlive the tree's walks.
    explicit CellTree(std::span<const octree::CellKey> leaves);

    Ref root() const { return root_; }
    Ref octant(Ref inner, int index) const {
        return inner_[inner & ~inner_bit][static_cast<std::size_t>(index)];
    }
    /// The leaf whose low corner is that of the node, or none when there is a gap.
    Ref first_leaf(Ref ref) const {
        while (is_inner(ref)) ref = octant(ref, 0);
        return ref;
    }

    /// The cells at offsets {0, 1}³ of a cell's side (bit 0 is x): nodes of the cell's level, larger leaves that
    /// contain them, or none. The first is the cell itself.
    struct Block {
        std::array<Ref, 8> nodes;
        std::uint8_t larger = 0;  ///< a bit for each that is a larger leaf

        Ref operator[](std::size_t offset) const { return nodes[offset]; }
    };

    /// Calls `visit(leaf, level, block)` in order for the leaves of levels up to `last_level`.
    template <class Visit>
    void for_each_leaf(const Visit& visit, int last_level = octree::max_level) const {
        Block block;
        block.nodes.fill(none);
        block.nodes[0] = root_;
        if (is_leaf(root_) && last_level >= 0) visit(root_, 0, block);
        if (is_inner(root_) && last_level > 0) walk(block, 0, last_level, visit);
    }

  private:
    Ref build(octree::CellKey cell, std::size_t& next);

    template <class Visit>
    void walk(const Block& block, int level, int last_level, const Visit& visit) const {
        // The 27 cells of the next level at offsets {0, 1, 2}³.
        std::array<Ref, 27> grid;
        std::uint32_t larger = 0;
        for (std::size_t i = 0; i < 27; ++i) {
            const auto [node, octant] = cell_tree_detail::grid_cells[i];
            const Ref ref = block[node];
            grid[i] = is_inner(ref) ? inner_[ref & ~inner_bit][octant] : ref;
            larger |= std::uint32_t{is_leaf(ref)} << i;
        }
        for (std::size_t child = 0; child < 8; ++child) {
            const std::size_t low = child_in_grid[child];
            const Ref ref = grid[low];
            if (ref == none) continue;
            const std::uint32_t bits = larger >> low;
            const Block next{{ref, grid[low + 1], grid[low + 3], grid[low + 4], grid[low + 9], grid[low + 10],
                              grid[low + 12], grid[low + 13]},
                             static_cast<std::uint8_t>((bits & 3) | (bits >> 1 & 12) | (bits >> 5 & 48) |
                                                       (bits >> 6 & 192))};
            if (is_leaf(ref))
                visit(ref, level + 1, next);
            else if (level + 1 < last_level)
                walk(next, level + 1, last_level, visit);
        }
    }

    static constexpr std::array<std::uint8_t, 8> child_in_grid{0, 1, 3, 4, 9, 10, 12, 13};

    std::span<const octree::CellKey> leaves_;
    std::vector<std::array<Ref, 8>> inner_;
    Ref root_ = none;
};

}  // namespace octavo::hexmesh
