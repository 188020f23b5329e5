// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <octavo/octree/linear_octree.hpp>

// 2:1 balance: the smallest refinement of an octree in which touching leaves differ by one level at most.
//
// Idea: balance is a statement about split cells. Leaves touch at most 2:1 exactly when, for every split cell P, the
// neighbours of P's parent Q that touch P are split too (or lie outside the universe). So the split cells of one level
// decide which cells of the next coarser level must be split, and one sweep from the finest level to the root
// gives the closure; nothing is ever looked at twice. Levels are sorted arrays of codes, and what a level asks
// for is sorted and merged into the next: no search trees, no hash maps. Split cells are an eighth of all
// nodes and their parents an eighth again, so nearly all time goes into writing the leaves.
//
// Invariant: the result is the unique minimum, so its cells are those of every other correct balance.
// Cost: linear, and 2 bytes a leaf beside input and output.
// Source: H. Sundar, R. S. Sampath, G. Biros, Bottom-up construction and 2:1 balance refinement of linear octrees in
// parallel, 2008; they ripple leaves, we sweep split cells, which needs no second pass for what is inserted.

namespace octavo::octree {

/// Which leaves count as touching.
enum class Contact : std::uint8_t {
    face,    ///< a common face
    edge,    ///< a common face or edge: what linear finite elements need, for their constraints never chain
    corner,  ///< any common point
};

/// The balanced refinement of `leaves`, which fill the universe and are sorted, as are the leaves returned.
std::vector<CellKey> balance(std::span<const CellKey> leaves, Contact contact = Contact::edge);

/// Whether touching leaves differ by one level at most. Slower than `balance`: for tests and checks of input.
bool is_balanced(std::span<const CellKey> leaves, Contact contact = Contact::edge);

/// For each leaf of a refinement, the leaf of the `coarse` tree that it lies in. Both are sorted.
std::vector<LeafIndex> origins(std::span<const CellKey> fine, std::span<const CellKey> coarse);

}  // namespace octavo::octree
