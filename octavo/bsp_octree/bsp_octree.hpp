// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>
#include <octavo/bsp/classify.hpp>
#include <octavo/bsp_octree/options.hpp>
#include <octavo/bsp_octree/store.hpp>
#include <octavo/exact/lattice.hpp>
#include <octavo/mesh/mesh.hpp>
#include <octavo/octree/cell.hpp>

// A solid as an octree whose leaves are white, black, or hold a BSP tree of the faces in them: exact, and closed under
// set operations for ever.
//
// Planes of trees are those of input faces, and separators through their edges; cells are cut out by walls between
// lattice points. So every vertex of every result is a point of three such planes, within one bit budget, after any
// number of operations. Set operations descend both trees at once and work only where both have faces; all other nodes
// are shared with the operands. A BspOctree is a version: operations return new ones, cheaply, and old ones stay valid.
//
// Versions of one solid share a store. One thread at a time may work with versions that do.
// Source: Argüelles, BSP-OctTree (chapter 3 of the thesis). We depart from it in exactness (an integer lattice), in
// the stop rule, in walls between lattice points, and in sharing nodes between versions.

namespace octavo::bsp_octree {

struct Stats {
    std::uint64_t white = 0, black = 0, bsp_leaves = 0, gray = 0;  ///< nodes of the tree
    std::uint64_t bsp_nodes = 0;                                   ///< of all BSP trees
    std::uint64_t largest_tree = 0;
    std::uint64_t planes = 0;  ///< different ones that the trees refer to
    int deepest = 0;
    std::uint64_t bytes = 0;  ///< of the nodes and planes of this version
};

/// What an edit did.
struct Edit {
    std::vector<octree::Cell>
        changed;  ///< cells whose nodes are not those of the solid before, as large as they are
    std::uint64_t merged_cells = 0;  ///< where both solids had faces
};

class BspOctree {
  public:
    /// The empty solid on a lattice.
    explicit BspOctree(const exact::Lattice& lattice = {}, const Options& options = {});
    BspOctree(const exact::Lattice& lattice, const Options& options, std::shared_ptr<Store> store,
              NodeRef root)
        : lattice_(lattice), options_(options), store_(std::move(store)), root_(root) {}

    const exact::Lattice& lattice() const { return lattice_; }
    const Options& options() const { return options_; }
    const Store& store() const { return *store_; }
    const std::shared_ptr<Store>& shared_store() const { return store_; }
    NodeRef root() const { return root_; }

    bool is_empty() const { return root_.is_white(); }
    bool is_everything() const { return root_.is_black(); }

    /// All that is not in this solid; constant time.
    BspOctree complement() const { return {lattice_, options_, store_, root_.complement()}; }

    /// Set operations. Cost: that of the cells in which both have faces, and of copying the other solid's nodes when it
    /// is in another store. Errors: bad_input when the solids are not on one lattice, cancelled.
    Result<BspOctree> intersect(const BspOctree& other, Edit* edit = nullptr,
                                const Context& context = {}) const;
    Result<BspOctree> unite(const BspOctree& other, Edit* edit = nullptr, const Context& context = {}) const;
    Result<BspOctree> subtract(const BspOctree& other, Edit* edit = nullptr,
                               const Context& context = {}) const;

    /// Where a point of the world lies; exact, for any finite doubles. Outside the universe is where its walls are:
    /// out, unless the solid is a complement.
    bsp::Position classify(Vec3 point) const;

    Stats stats() const;

    /// The same solid in a store of its own, without nodes and planes that it does not refer to.
    BspOctree compacted() const;

    /// Calls `visit(Cell, NodeRef)` for the leaves, octant 0 first.
    template <class Visit>
    void for_each_leaf(const Visit& visit) const {
        visit_leaves(octree::Cell::root(), root_, visit);
    }

  private:
    template <class Visit>
    void visit_leaves(const octree::Cell& cell, NodeRef node, const Visit& visit) const {
        if (!node.is_gray()) return visit(cell, node);
        const Octants octants = store_->octants(node);
        for (int i = 0; i < 8; ++i) visit_leaves(cell.child(i), octants[static_cast<std::size_t>(i)], visit);
    }

    exact::Lattice lattice_;
    Options options_;
    std::shared_ptr<Store> store_;
    NodeRef root_;
};

}  // namespace octavo::bsp_octree
