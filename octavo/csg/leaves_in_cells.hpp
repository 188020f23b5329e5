// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <octavo/csg/program.hpp>
#include <octavo/csg/scratch.hpp>
#include <octavo/octree/color.hpp>

// The leaves of a large expression, sorted into the cells of one level that they can reach.
//
// Problem: on the first levels of a descent nearly all of ten thousand leaves are small beside the octants; each is
// looked at, and copied, once a level, only to be left as it is. Idea: a leaf's bounding box tells the cells of any
// level by a shift. So leaves go at once to the cells of a level at which few lie in more than one, counted and put in
// place (H. Seward, 1954) by the cells' Morton codes: those of a cell above that level are then a range, which eight
// octants share without reading it. The program of a cell is written from its leaves: they bring the operations that
// they stand in, and of every operation it is known what its operands are where they have no leaf.
// What holds: the program is that of pruning by bounding boxes. It is not done for few leaves, for large ones, for
// symmetric differences and deep expressions; pruning then starts at the root.
// Cost: three passes over the leaves. Tried and lost: sorting the operands of a union by boxes around them, which in
// scenes of random operands reach everywhere.

namespace octavo::csg {

class LeavesInCells {
  public:
    /// None where it would not pay. The level is at most `last`.
    static std::optional<LeavesInCells> sort(const Program& program, std::span<const std::uint32_t> words,
                                             int last);

    int level() const { return level_; }
    /// Leaves in so many cells of the level from one on, in Morton order.
    std::uint32_t count(std::uint32_t first, std::uint32_t cells) const {
        return begin_[first + cells] - begin_[first];
    }
    /// The colour of a cell without leaves.
    octree::Color color_without() const { return color_without_; }
    /// Appends the program of a cell with leaves, unless these leave it decided: returns its colour, or gray.
    octree::Color write(std::uint32_t cell, Scratch<std::uint32_t>& to) const;

    std::size_t memory_bytes() const;

  private:
    static constexpr std::size_t most_depth = 32;

    /// An operation. An operand decides it where it has no leaf, or where it is decided so.
    struct Operation {
        std::uint32_t word, end, parent;
        std::uint32_t decided_without;  // by how many operands, where no operand has leaves
        octree::Color without;          // its colour there

        octree::Color deciding() const {
            return word::operation(word) == word::union_of ? octree::Color::black : octree::Color::white;
        }
    };
    struct PlacedLeaf {
        std::uint32_t at, parent;  // its word, and the operation that it is an operand of
    };
    /// An operation that is being written.
    struct Open {
        std::uint32_t operation;
        std::size_t begin;              // among the words written
        std::uint32_t operands;         // written
        std::uint32_t decided_without;  // by so many operands that have no leaf in the cell
        bool decided;
    };

    bool read(std::span<const std::uint32_t> words);
    bool choose_level(const Program& program, int last);
    void place(const Program& program);
    const Leaf& leaf_of(const Program& program, const PlacedLeaf& leaf) const {
        return program.leaves[word::leaf(words_[leaf.at])];
    }

    std::span<const std::uint32_t> words_;
    int level_ = 0;
    octree::Color color_without_ = octree::Color::white;
    std::vector<Operation> operations_;
    std::vector<PlacedLeaf> leaves_;
    std::vector<std::uint32_t> begin_;   // by cell, where its leaves begin, and where the last end
    std::vector<std::uint32_t> placed_;  // by cell, its leaves
};

}  // namespace octavo::csg
