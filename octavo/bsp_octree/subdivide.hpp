// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/bsp/boundary.hpp>
#include <octavo/bsp/build.hpp>
#include <octavo/bsp/fragment.hpp>
#include <octavo/bsp/winding_labels.hpp>
#include <octavo/bsp_octree/cell_progress.hpp>
#include <octavo/bsp_octree/options.hpp>
#include <octavo/bsp_octree/store.hpp>
#include <octavo/octree/cell.hpp>

// From the faces in a cell to its node: BSP leaf where they are simple, else eight octants.
//
// Faces are cut by the walls between octants and go on as fragments, so a leaf receives exactly what lies in it. What
// is simple is the options' matter (options.hpp). What colour an octant without faces has, the faces cannot say; the
// caller does.

namespace octavo::bsp_octree {

using Fragments = std::vector<bsp::Fragment>;

/// The memory of one operation: pools, lists by level, builders.
class Workspace {
  public:
    /// Tells the context how far `phase` is. `options` must be in range.
    Workspace(Store& store, bsp::FragmentPool& pool, const Options& options, const Context& context,
              std::string_view phase)
        : store_(store),
          pool_(pool),
          options_(options),
          context_(context),
          progress_(context, phase),
          builder_(options.tree) {
        OCTAVO_CHECK(check(options).has_value(), "options of a BSP-octree out of range");
    }

    /// Once true, nodes are made of nothing, and fast; who started the work throws them away.
    bool cancelled() const { return context_.cancelled(); }
    /// Nothing of the cell is left to do.
    void finish(const octree::Cell& cell) { progress_.finish(cell); }

    Store& store() { return store_; }
    bsp::FragmentPool& pool() { return pool_; }
    const Options& options() const { return options_; }

    /// Cuts fragments of a cell to its octants. What comes back stays until the next cell of this level.
    std::array<Fragments, 8>& distribute(const octree::Cell& cell, std::span<const bsp::Fragment> fragments);

    /// May these faces be the leaf of this cell?
    bool is_simple(const octree::Cell& cell, std::span<const bsp::Fragment> fragments);
    /// Whether octants that came of a cell are no simpler than the cell: long thin faces go through many of them.
    bool is_futile(std::span<const bsp::Fragment> fragments, const std::array<Fragments, 8>& octants) const;

    NodeRef make_leaf(std::span<const bsp::Fragment> fragments);
    /// The node of a cell where parts of input triangles may cross, cover and nest one another: a leaf, or uniform.
    /// `winding` is that of the low corner, displaced (bsp/winding_labels.hpp).
    NodeRef make_resolved_leaf(const octree::Cell& cell, std::span<const bsp::Fragment> fragments,
                               std::int32_t winding);
    /// Of those, the ones where they did.
    std::uint64_t resolved_leaves() const { return resolved_leaves_; }
    /// The gray node of these octants, or what it is condensed to.
    NodeRef make_gray(const octree::Cell& cell, const Octants& octants);

    /// Appends the faces of a BSP leaf.
    void extract(const octree::Cell& cell, NodeRef leaf, Fragments& faces) {
        extractor_.extract(pool_, cell, store_.tree(leaf), faces);
    }

  private:
    bool shares_a_point(const octree::Cell& cell) const;
    std::size_t count_planes(std::span<const bsp::Fragment> fragments, std::size_t most);

    Store& store_;
    bsp::FragmentPool& pool_;
    Options options_;
    const Context& context_;
    CellProgress progress_;
    bsp::TreeBuilder builder_;
    bsp::BoundaryExtractor extractor_;
    bsp::WindingLabels winding_labels_;
    std::uint64_t resolved_leaves_ = 0;
    std::vector<bsp::PlaneId> planes_;
    // Lists are kept, since making them anew for every cell took a tenth of the time.
    std::array<Fragments, 2> by_x_;
    std::array<Fragments, 4> by_xy_;
    std::array<std::array<Fragments, 8>, exact::coordinate_bits> octants_;  ///< by level of the cell
};

/// Subdivides until all leaves are simple. `Colors` knows the labels of cells without faces:
///   State         what it knows about a cell
///   octants(cell, fragments, state) → std::array<State, 8>
///   label(cell, state)              of a cell without faces
///   leaf(workspace, cell, fragments, state)
template <class Colors>
class Subdivider {
  public:
    using State = typename Colors::State;

    Subdivider(Workspace& workspace, Colors colors) : workspace_(workspace), colors_(std::move(colors)) {}

    NodeRef operator()(const octree::Cell& cell, std::span<const bsp::Fragment> fragments,
                       const State& state) {
        if (workspace_.cancelled()) return NodeRef::white();
        if (fragments.empty() || workspace_.is_simple(cell, fragments)) {
            workspace_.finish(cell);
            return fragments.empty() ? NodeRef::uniform(colors_.label(cell, state))
                                     : colors_.leaf(workspace_, cell, fragments, state);
        }

        const bsp::FragmentPool::Mark mark = workspace_.pool().mark();
        const std::array<Fragments, 8>& octants = workspace_.distribute(cell, fragments);
        NodeRef result;
        if (workspace_.is_futile(fragments, octants)) {
            workspace_.finish(cell);
            result = colors_.leaf(workspace_, cell, fragments, state);
        } else {
            const std::array<State, 8> states = colors_.octants(cell, fragments, state);
            Octants children;
            for (int i = 0; i < 8; ++i) {
                const auto octant = static_cast<std::size_t>(i);
                children[octant] = (*this)(cell.child(i), octants[octant], states[octant]);
            }
            result = workspace_.make_gray(cell, children);
        }
        workspace_.pool().release(mark);
        return result;
    }

  private:
    Workspace& workspace_;
    Colors colors_;
};

}  // namespace octavo::bsp_octree
