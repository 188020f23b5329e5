// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include <octavo/base/huge_page_allocator.hpp>
#include <octavo/octree/morton.hpp>

// From a place to the leaf of an octree that holds it, in few loads and few bytes.
//
// Problem: a dependent load beyond the cache costs as much as a hundred instructions, and an octree of pointers makes
// one a level. Idea: a dense table of the top levels, and below it bricks of 4×4×4 cells. Most cells of a brick are
// white or black, and a leaf of a coarser level fills eight in a row, so a brick is three masks of 64 bits and a word
// for each leaf or brick in it. Two masks tell the kind of each cell, the third where a new word begins; which word is
// a cell's is a count of its bits. The records of its gray leaves follow the brick, so that they arrive with it:
//
//     brick:  │ A │ B │ C │ word │ word │ … │ record │ record │ …
//             └ 8 bytes each ┘ one for each bit of C
//
//     kind of cell i = bits i of A and B: 00 white, 10 black, 01 gray, 11 brick
//
// The kinds of cells one level below the table are also kept apart, two bits each: at most 512 KiB, which stay in the
// cache, tell nineteen of twenty places in a box what they are.
//
// Invariant: every place has one leaf. Cost: 24 bytes a brick and 4 a leaf, a quarter of a word for every cell, for two
// more instructions a level.

namespace octavo::query {

class CellIndex {
  public:
    enum class Kind : std::uint8_t { white = 0, black = 1, gray = 2, brick = 3 };

    /// A cell's kind and, for a gray one, where its record begins.
    struct Entry {
        Kind kind = Kind::white;
        std::uint32_t value = 0;
        friend bool operator==(const Entry&, const Entry&) = default;
    };

    /// A leaf to index.
    struct Item {
        octree::CellKey key;
        Entry entry;
    };

    CellIndex() = default;
    /// Leaves in Morton order that fill the universe, and the records that the gray ones point to (leaf_record.hpp),
    /// which are copied. Twice the leaves and the words of the records must be fewer than 2^30.
    CellIndex(std::span<const Item> items, std::span<const std::uint32_t> records);

    /// White or black where all of the place's cell one level below the table is; from memory that is nearly always in
    /// the cache.
    Kind kind_of(std::uint64_t code) const {
        const std::uint64_t cell = code >> (3 * (octree::max_level - top_level_ - 1));
        return static_cast<Kind>(kinds_[cell / cells_a_word] >> 2 * (cell % cells_a_word) & 3);
    }
    /// Loads of one search that depend on each other: `top`, then `below` for as long as the kind is brick, with
    /// `level` growing by `brick_levels` from `top_level()`. `code` is that of the place, of octree::max_level.
    Entry top(std::uint64_t code) const {
        const std::uint32_t word = top_[code >> (3 * (octree::max_level - top_level_))];
        return {static_cast<Kind>(word >> 30), word & value_mask};
    }
    Entry below(Entry brick, std::uint64_t code, int level) const {
        // Bricks may reach below the last level of a code, which then goes on with zeros.
        const int shift = 3 * (octree::max_level - level - brick_levels);
        const std::uint64_t cell = (shift >= 0 ? code >> shift : code << -shift) & (brick_cells - 1);
        const std::uint32_t* words = words_.data() + brick.value;
        std::array<std::uint64_t, 3> masks;
        std::memcpy(masks.data(), words, sizeof masks);
        const std::uint64_t a = masks[0] >> cell & 1, b = masks[1] >> cell & 1;
        const auto kind = static_cast<Kind>(a | b << 1);
        if (b == 0) return {kind, 0};
        const int begun = std::popcount(masks[2] << (brick_cells - 1 - cell));
        return {kind, words[head_words - 1 + static_cast<std::size_t>(begun)]};
    }
    /// All of them, from the entry of the table on: the leaf.
    Entry find_below(Entry entry, std::uint64_t code) const {
        for (int level = top_level_; entry.kind == Kind::brick; level += brick_levels) {
            prefetch_records(entry);
            entry = below(entry, code, level);
        }
        return entry;
    }
    /// Of a gray entry.
    const std::uint32_t* record(Entry gray) const { return words_.data() + gray.value; }

    static constexpr int brick_levels = 2;
    int top_level() const { return top_level_; }
    void prefetch_top(std::uint64_t code) const {
        __builtin_prefetch(&top_[code >> (3 * (octree::max_level - top_level_))]);
    }
    void prefetch_brick(Entry brick) const {
        __builtin_prefetch(words_.data() + brick.value);
        __builtin_prefetch(words_.data() + brick.value + 16);
    }

    std::size_t memory_bytes() const {
        return 8 * kinds_.capacity() + 4 * (top_.capacity() + words_.capacity());
    }

  private:
    static constexpr std::uint64_t brick_cells = std::uint64_t{1} << (3 * brick_levels);
    static constexpr std::size_t head_words = 6;
    static constexpr std::uint64_t cells_a_word = 32;
    static constexpr std::uint32_t value_mask = (1U << 30) - 1;

    class Builder;

    void prefetch_records(Entry brick) const {
        const std::uint32_t* words = words_.data() + brick.value;
        for (std::size_t line = 1; line < 6; ++line) __builtin_prefetch(words + 16 * line);
    }

    template <class T>
    using Array = std::vector<T, HugePageAllocator<T>>;

    int top_level_ = 0;
    std::vector<std::uint64_t> kinds_;
    Array<std::uint32_t> top_;  ///< the cells of `top_level_` in Morton order, kind in the highest two bits
    Array<std::uint32_t>
        words_;  ///< bricks with their records, children before their parent; records of the table
};

}  // namespace octavo::query
