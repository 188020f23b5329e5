// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <octavo/base/result.hpp>
#include <octavo/octree/color.hpp>
#include <octavo/octree/morton.hpp>

// The DF code: an octree written depth first, two bits a node.
//
// A node is a white, black or gray leaf, or it is split and its eight octants follow, octant 0 first, each
// with all that is below it. Nothing else is stored: positions and levels follow from the order. Four nodes a
// byte is both the file and the form in memory; a quarter of a byte a node is 1/32 of a linear octree of
// sorted keys. Source: E. Kawaguchi and T. Endo, On a method of binary-picture representation and its
// application to data compression, 1980; with two bits instead of three symbols because gray leaves exist.
//
// Invariant kept by those who append: the symbols form exactly one tree. `check_tree` tests it.

namespace octavo::octree {

/// The two bits of a node.
enum class Node : std::uint8_t { white = 0, black = 1, gray = 2, split = 3 };

constexpr bool is_leaf(Node node) { return node != Node::split; }
constexpr Color color_of(Node leaf) { return static_cast<Color>(leaf); }
constexpr Node leaf_of(Color color) { return static_cast<Node>(color); }

/// Colours of the 64 cells two levels below a cell in Morton order, one bit each; gray where neither is set.
struct GrandchildColors {
    std::uint64_t white = 0, black = 0;
};

class DfCode {
  public:
    static constexpr std::size_t nodes_per_word = 32;

    std::size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    Node operator[](std::size_t index) const {
        return static_cast<Node>(words_[index / nodes_per_word] >> (2 * (index % nodes_per_word)) & 3);
    }

    void append(Node node) {
        const std::size_t shift = 2 * (size_ % nodes_per_word);
        if (shift == 0) words_.push_back(0);
        words_.back() |= static_cast<std::uint64_t>(node) << shift;
        ++size_;
    }
    /// Appends up to 32 nodes at once, the first in the lowest two bits; bits above the last must be zero.
    void append(std::uint64_t nodes, std::size_t count) {
        const std::size_t used = size_ % nodes_per_word;
        if (used == 0) {
            words_.push_back(nodes);
        } else {
            words_.back() |= nodes << (2 * used);
            if (used + count > nodes_per_word) words_.push_back(nodes >> (2 * (nodes_per_word - used)));
        }
        size_ += count;
    }
    void append(const DfCode& other);
    /// Appends a node with what is two levels below it. Octants that are all white or all black become one leaf, and
    /// so does the node, whose colour is returned then, else split.
    Node append(const GrandchildColors& colors);

    /// Forgets all nodes but the first `size`.
    void truncate(std::size_t size);
    void reserve(std::size_t nodes) { words_.reserve((nodes + nodes_per_word - 1) / nodes_per_word); }

    /// 32 nodes a word, the first in the lowest two bits; unused bits are zero.
    const std::vector<std::uint64_t>& words() const { return words_; }
    /// The inverse of `words` and `size`. Errors: bad_input when the lengths disagree or an unused bit is
    /// set.
    static Result<DfCode> from_words(std::vector<std::uint64_t> words, std::size_t size);

    std::size_t memory_bytes() const { return words_.capacity() * sizeof(std::uint64_t); }

    friend bool operator==(const DfCode&, const DfCode&) = default;

  private:
    std::vector<std::uint64_t> words_;
    std::size_t size_ = 0;
};

/// Walks the nodes of a code in order and knows where each is. No stack: the place after a leaf is its code
/// plus its size, and that sum's trailing zeros tell the level of the next node.
class DfCursor {
  public:
    explicit DfCursor(const DfCode& code) : code_(&code) {}

    /// True when the tree is complete: every octant has been visited.
    bool done() const { return morton_ >> 63 != 0; }
    std::size_t index() const { return index_; }
    int level() const { return level_; }
    CellKey key() const { return CellKey::from_code(morton_, level_); }
    Node node() const { return (*code_)[index_]; }

    /// To the next node in depth-first order.
    void next() {
        if (node() == Node::split) {
            ++index_;
            ++level_;
        } else {
            skip_leaf();
        }
    }
    /// Steps over the present node, which is a leaf.
    void skip_leaf() {
        ++index_;
        morton_ += 1ULL << (3 * (max_level - level_));
        level_ = max_level - std::countr_zero(morton_) / 3;
    }

  private:
    const DfCode* code_;
    std::size_t index_ = 0;
    std::uint64_t morton_ = 0;
    int level_ = 0;
};

/// Whether the nodes form exactly one tree that is at most `depth` deep (at most `max_level`). The error's
/// sentence says which node is wrong.
Status check_tree(const DfCode& code, int depth);

}  // namespace octavo::octree
