// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include <octavo/octree/df_code.hpp>

namespace octavo::octree {
namespace {

/// The bits of a number with a zero after each.
std::uint64_t two_apart(std::uint64_t bits) {
    bits &= 0xFFFFFFFF;
    bits = (bits | bits << 16) & 0x0000FFFF0000FFFF;
    bits = (bits | bits << 8) & 0x00FF00FF00FF00FF;
    bits = (bits | bits << 4) & 0x0F0F0F0F0F0F0F0F;
    bits = (bits | bits << 2) & 0x3333333333333333;
    return (bits | bits << 1) & 0x5555555555555555;
}

}  // namespace

void DfCode::append(const DfCode& other) {
    if (other.empty()) return;
    OCTAVO_CHECK(&other != this, "a code cannot be appended to itself");
    const std::size_t used = 2 * (size_ % nodes_per_word);
    if (used == 0) {
        words_.insert(words_.end(), other.words_.begin(), other.words_.end());
    } else {
        for (const std::uint64_t word : other.words_) {
            words_.back() |= word << used;
            words_.push_back(word >> (64 - used));
        }
    }
    size_ += other.size_;
    words_.resize((size_ + nodes_per_word - 1) / nodes_per_word);
}

Node DfCode::append(const GrandchildColors& colors) {
    if (colors.white == ~std::uint64_t{0} || colors.black == ~std::uint64_t{0}) {
        const Node node = colors.black ? Node::black : Node::white;
        append(node);
        return node;
    }
    // Written here first, from where the last word has room: up to 31 nodes of it and 73 new ones.
    std::array<std::uint64_t, 4> words{};
    const std::size_t used = size_ % nodes_per_word;
    if (used != 0) words[0] = words_.back();
    std::size_t end = used;
    const auto write = [&](std::uint64_t nodes, std::size_t count) {
        const std::size_t shift = 2 * (end % nodes_per_word);
        std::uint64_t* const to = &words[end / nodes_per_word];
        to[0] |= nodes << shift;
        to[1] |= nodes >> 1 >> (63 - shift);
        end += count;
    };
    std::uint64_t nodes = static_cast<std::uint64_t>(Node::split);
    std::size_t count = 1;
    // The leaves of four octants each.
    const std::uint64_t gray = ~(colors.white | colors.black);
    const std::array<std::uint64_t, 2> leaves{two_apart(colors.black) | two_apart(gray) << 1,
                                              two_apart(colors.black >> 32) | two_apart(gray >> 32) << 1};
#pragma GCC unroll 8
    for (unsigned octant = 0; octant < 8; ++octant) {
        // Which octants are of one colour changes from cell to cell, so no branch asks.
        const std::uint64_t eight = leaves[octant / 4] >> (16 * (octant % 4)) & 0xFFFF;
        const std::uint64_t is_one = (eight == 0) | (eight == 0x5555), split = 3U | eight << 2;
        nodes |= (split ^ ((split ^ (eight & 1)) & (0 - is_one))) << (2 * count);
        count += 9 - 8 * is_one;
        // Three octants are at most 27 nodes, and with the first 28.
        if (octant % 3 == 2 || octant == 7) {
            write(nodes, count);
            nodes = 0;
            count = 0;
        }
    }
    if (used != 0) words_.back() = words[0];
    for (std::size_t i = used != 0; nodes_per_word * i < end; ++i) words_.push_back(words[i]);
    size_ += end - used;
    return Node::split;
}

void DfCode::truncate(std::size_t size) {
    OCTAVO_CHECK(size <= size_, "a code cannot be truncated to more nodes than it has");
    size_ = size;
    words_.resize((size + nodes_per_word - 1) / nodes_per_word);
    const std::size_t used = 2 * (size % nodes_per_word);
    if (used != 0) words_.back() &= (1ULL << used) - 1;
}

Result<DfCode> DfCode::from_words(std::vector<std::uint64_t> words, std::size_t size) {
    if (words.size() != size / nodes_per_word + (size % nodes_per_word != 0))
        return Error{
            ErrorCode::bad_input, "the DF code does not have the length that its node count asks for", {}};
    const std::size_t used = 2 * (size % nodes_per_word);
    if (used != 0 && words.back() >> used != 0)
        return Error{ErrorCode::bad_input, "the DF code goes on after its last node", {}};
    DfCode code;
    code.words_ = std::move(words);
    code.size_ = size;
    return code;
}

Status check_tree(const DfCode& code, int depth) {
    OCTAVO_CHECK(depth >= 0 && depth <= max_level, "the depth of an octree is 0 to 21");
    DfCursor cursor(code);
    for (; !cursor.done(); cursor.next()) {
        if (cursor.index() == code.size())
            return Error{ErrorCode::bad_input,
                         "the DF code ends after " + std::to_string(code.size()) + " nodes, inside the tree",
                         {}};
        if (cursor.node() == Node::split && cursor.level() >= depth)
            return Error{ErrorCode::bad_input,
                         "node " + std::to_string(cursor.index()) +
                             " of the DF code splits a cell of the last level, " + std::to_string(depth),
                         {}};
    }
    if (cursor.index() != code.size())
        return Error{ErrorCode::bad_input,
                     "the DF code has " + std::to_string(code.size()) + " nodes but its tree ends after " +
                         std::to_string(cursor.index()),
                     {}};
    return Done{};
}

}  // namespace octavo::octree
