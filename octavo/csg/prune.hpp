// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <octavo/csg/classify.hpp>
#include <octavo/csg/octant_colors.hpp>
#include <octavo/csg/program.hpp>

// Pruning: an expression restricted to the octants of a cell.
//
// Problem: testing every primitive in every cell costs octants × primitives. Idea: evaluate the expression once
// for the eight octants of a cell in three-valued logic, keep the colours of all its nodes, and hand to each
// octant that stays gray only what is undecided there: A ∪ white → A, A ∩ black → A, A ∪ black → black and so
// on. A list shrinks about eight times a level until cells are smaller than the primitives; then one to three
// leaves are left (J. Woodwark and K. Quinlan, Reducing the effect of complexity on volume model evaluation,
// 1982). The walks themselves are in fold_words.hpp.

namespace octavo::csg {

class Pruner {
  public:
    /// Evaluates `words`, a program restricted to `parent`, in its octants and at their points. Colours of nodes are
    /// kept for `prune`.
    Seen evaluate(const Program& program, std::span<const std::uint32_t> words, const octree::Cell& parent);
    /// The same without the points, which takes half the time.
    OctantColors evaluate_colors(const Program& program, std::span<const std::uint32_t> words,
                                 const octree::Cell& parent);

    /// Where what is left for an octant lies.
    struct Part {
        std::uint32_t begin = 0, size = 0;
    };
    /// Appends to `to` what the words last evaluated leave undecided in each of some octants, which must be gray.
    std::array<Part, 8> prune(std::span<const std::uint32_t> words, unsigned octants,
                              Scratch<std::uint32_t>& to);

    /// Whether the words last evaluated would be pruned to themselves in every gray octant.
    bool unchanged() const { return unchanged_; }

    /// What the words last evaluated showed of the leaf at a word, in all of the cell: gray unless its octants agree,
    /// and whether a point of the cell lies strictly inside it. Nothing of leaves that were not looked at.
    struct LeafInCell {
        octree::Color color = octree::Color::gray;
        bool met = false;
    };
    LeafInCell leaf_in_cell(std::size_t at) const;

    /// Leaves tested so far, counted once for each octant that the leaf's bounding box meets.
    std::uint64_t primitive_tests() const { return remains_.tests; }

  private:
    template <class SeenOfNode>
    SeenOfNode evaluate_as(const Program& program, std::span<const std::uint32_t> words,
                           const octree::Cell& parent);
    void make_room(OctantColors colors, std::size_t words);

    /// What was seen of a node, by its word.
    struct Node {
        OctantColors colors;
        bool met;                         // of a leaf: a point lies strictly inside it
        bool whole;                       // of a leaf: all of it is left
        std::uint32_t evaluation;         // of a leaf: the last in which it was looked at
        std::uint32_t matters, windings;  // of a leaf: where its part of `remains_` begins
    };
    const Program* program_ = nullptr;
    Scratch<Node> nodes_;
    std::vector<OpenOperation<Seen>> open_;
    std::vector<OpenOperation<ColorsSeen>> open_colors_;
    std::vector<WrittenOperation> written_;
    Remains remains_;
    alignas(32) std::array<std::uint32_t, 8> room_{};  // words that are enough for what is left, by octant
    std::uint32_t evaluation_ = 0;
    bool unchanged_ = false;
};

}  // namespace octavo::csg
