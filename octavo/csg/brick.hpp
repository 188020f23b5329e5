// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <octavo/csg/body_in_cells.hpp>
#include <octavo/csg/brick_seen.hpp>
#include <octavo/csg/brick_sides.hpp>
#include <octavo/csg/fold_words.hpp>
#include <octavo/csg/scratch.hpp>

// The last two levels of a descent at once: an expression in the 64 cells two levels below a cell.
//
// Near the bottom a program is one to three leaves long, and the way from level to level (look at each, write what is
// left eight times, come back) costs more than looking. A surface in 64 cells costs twice what it does in eight, and
// the two levels have nine times eight cells. The 125 corners of the cells are evaluated as well: a cell with one
// strictly inside and one strictly outside is proved to be gray. Measured on 10 000 space-filling primitives at
// depth 8: 438 million instructions for the whole octree, 565 with one level at a time. Tried and lost: the middles of
// the cells as more points, since what the corners leave open is nearly always white. Not tried: three levels at once,
// where cells decided two levels up would be looked at in vain.
//
// A brick goes three steps, so that several can share the second: `look` evaluates its corners; `ask` asks, of each
// cell that these leave open, whether the bodies that may enter it do; `settle` evaluates the expression again with the
// answers.

namespace octavo::csg {

class Brick {
  public:
    struct Colors {
        LayerPair cells;  ///< white and black; the rest is gray
        Layers unproved;  ///< gray, and no two of their points prove it
    };

    /// Looks at `words`, a program restricted to `parent`, in the brick; `parent` has a side of at least 4. Program and
    /// words must last until `settle`.
    void look(const Program& program, std::span<const std::uint32_t> words, const octree::Cell& parent);
    /// Answers are there after `bodies.finish`.
    void ask(BodiesInCells& bodies);
    const Colors& settle();
    /// The three steps of one brick.
    const Colors& evaluate(const Program& program, std::span<const std::uint32_t> words,
                           const octree::Cell& parent);

    /// Replaces `to` by what the words last evaluated leave undecided in a cell, which must be gray.
    void prune(BrickCell cell, Scratch<std::uint32_t>& to);

    /// Leaves tested so far, counted once for each cell of a brick that the leaf's bounding box meets.
    std::uint64_t primitive_tests() const { return tests_; }

  private:
    struct Node {
        LayerPair cells;
        // Of a leaf, not complemented: the cells that were asked about, what was seen, and the answers about its body.
        Layers needed;
        CornersSeen seen;
        BodyInCells body;
        std::uint32_t matters, windings;  // where its part begins
        std::uint32_t surfaces, surface_count;
        std::uint64_t look;  // the last in which it was looked at
    };

    void give(const LayerPair& cells, const LayerPair& reached);
    // Apart: in line it would make `look` slower where it is not called.
    [[gnu::noinline]] Layers gray_by_bounds(const octree::Cell& parent);
    bool holds_middle(const Leaf& leaf) const;
    CornersSeen look_at(const Leaf& leaf, Payload payload, const octree::Cell& parent, Node& node);
    CornersSeen look_at_convex(std::span<const std::uint32_t> constraints, const octree::Cell& parent,
                               const BrickSides& box, Node& node);
    CornersSeen look_at_torus(const LatticeTorus& torus, const octree::Cell& parent, const Layers& needed,
                              const BrickSides& box);
    CornersSeen look_at_polyhedron(const LatticePolyhedron& polyhedron, Payload payload,
                                   const octree::Cell& parent, const BrickSides& box);

    const Program* program_ = nullptr;
    std::span<const std::uint32_t> words_;
    Colors colors_;
    Layers open_cells_;  // that boxes have not shown to be gray
    LayerPair reached_by_corners_;
    Scratch<Node> nodes_;
    std::vector<OpenOperation<BoundsSeen>> open_bounds_;
    std::vector<OpenOperation<CornersSeen>> open_;
    std::vector<OpenOperation<ReachSeen>> open_again_;
    std::vector<WrittenOperation> written_;
    Scratch<Layers> matters_;         // the cells in which an item of a payload matters
    Scratch<std::int32_t> windings_;  // 64 for each polyhedron
    Scratch<BrickSurface> surfaces_;  // of convex leaves, as many as items
    std::vector<std::uint32_t> all_, met_;
    std::uint64_t tests_ = 0, looks_ = 0;
};

}  // namespace octavo::csg
