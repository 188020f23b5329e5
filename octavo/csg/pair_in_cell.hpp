// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include <octavo/csg/program.hpp>
#include <octavo/octree/cell.hpp>

// Looks again at a gray cell of the last level that holds two surfaces, as three in four do.
//
// Problem: mostly two bodies meet there and all corners lie in one or the other; between them runs a groove, or none.
// The ways that are open to any expression (prune.hpp, local_arrangement.hpp) take 400 nanoseconds. Idea: the same
// points and octants, of the two surfaces alone, and where those do not tell, the edges of the cell: of two half spaces
// and a cube the point deepest in both lies on an edge (four constraints of a linear program are tight there, two of
// them faces of the cube), where both are equally far. So the two are followed along the twelve edges, eight lanes a
// direction, and looked at where they cross. A quadric's square term is added to what lies linearly between its ends.
// What holds: a colour is the one that the longer ways give. A union of bodies of which one is curved is left gray when
// nothing shows a point outside both: that there is none, those do not look for either.
// Cost: about 100 nanoseconds.

namespace octavo::csg {

/// The colour of the cell; `words` is what pruning left for it. None unless they hold two planes or quadrics, and where
/// only the longer ways can tell.
std::optional<octree::Color> color_of_pair(const Program& program, std::span<const std::uint32_t> words,
                                           const octree::Cell& cell);

}  // namespace octavo::csg
