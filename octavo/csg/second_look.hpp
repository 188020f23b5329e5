// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/csg/local_arrangement.hpp>
#include <octavo/csg/prune.hpp>

// Looks again at a cell of the last level that three-valued logic leaves gray.
//
// Problem: gray ∪ gray is gray even when two boxes share the face between them and the cell is full, and classifying
// leaves cells gray that a body only passes by. Idea: prove that the cell is gray, cheaply, and spend time on the few
// that resist. In turn, each step for fewer cells than the one before:
//
//   1. two corners of the cell, strictly inside and strictly outside: evaluated with the colours, before this;
//   2. two surfaces by themselves (pair_in_cell.hpp);
//   3. any, one level further down: 35 points and the colours of the eight octants of the cell;
//   4. the arrangement of all surfaces in the cell (local_arrangement.hpp).

namespace octavo::csg {

class SecondLook {
  public:
    /// The colour of a cell that is gray so far; `words` is what pruning left for it.
    octree::Color color(const Program& program, std::span<const std::uint32_t> words,
                        const octree::Cell& cell);

  private:
    Pruner below_;
    LocalArrangement arrangement_;
};

}  // namespace octavo::csg
