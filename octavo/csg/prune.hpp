// SPDX-License-Identifier: Apache-2.0
#pragma once

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
// 1982). The short circuits of the source (an operand that decides an operation ends it) apply to eight octants
// at once: an operand is looked at only when some octant still needs it.
//
// Both passes are loops over words in prefix order with a stack of open operations; nothing recurses, and no
// memory is allocated once the buffers have grown. An operation left with one operand keeps its place as a `skip`
// word until the next pass, which saves moving what follows.

namespace octavo::csg {

class Pruner {
  public:
    /// Evaluates `words`, a program restricted to `parent`, in its octants. Colours of nodes are kept for `prune`.
    OctantColors evaluate(const Program& program, std::span<const std::uint32_t> words,
                          const octree::Cell& parent);

    /// Appends to `to` what the words last evaluated leave undecided in this octant, which must be gray.
    void prune(std::span<const std::uint32_t> words, int octant, std::vector<std::uint32_t>& to);

    /// Whether the words last evaluated would be pruned to themselves in every gray octant.
    bool unchanged() const { return unchanged_; }

    /// Leaves tested so far, counted once for each octant that the leaf's bounding box meets.
    std::uint64_t primitive_tests() const { return remains_.tests; }

  private:
    struct Open {
        std::uint32_t word;
        std::uint32_t end;
        std::uint8_t needed;
        OctantColors colors;
    };
    struct Written {
        std::uint32_t end;    // in the words read
        std::size_t word;     // in the words written
        std::uint32_t count;  // operands written
    };

    OctantColors evaluate_leaf(const Program& program, std::span<const std::uint32_t> words, std::size_t at,
                               const octree::Cell& parent, std::uint8_t needed);
    void write_leaf(std::span<const std::uint32_t> words, std::size_t at, int octant,
                    std::vector<std::uint32_t>& to);

    const Program* program_ = nullptr;
    std::vector<OctantColors> colors_;    // by word
    std::vector<std::uint32_t> matters_;  // by leaf word: where its bytes begin in `remains_`
    std::vector<std::uint32_t> windings_;
    std::vector<Open> open_;
    std::vector<Written> written_;
    Remains remains_;
    bool unchanged_ = false;
};

}  // namespace octavo::csg
