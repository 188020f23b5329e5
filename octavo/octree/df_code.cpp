// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include <octavo/octree/df_code.hpp>

namespace octavo::octree {
namespace {

/// The bits of a byte with a zero after each.
constexpr std::array<std::uint16_t, 256> two_apart = [] {
    std::array<std::uint16_t, 256> table{};
    for (unsigned byte = 0; byte < 256; ++byte)
        for (unsigned bit = 0; bit < 8; ++bit)
            if (byte >> bit & 1) table[byte] = static_cast<std::uint16_t>(table[byte] | 1U << (2 * bit));
    return table;
}();

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
    std::uint64_t nodes = static_cast<std::uint64_t>(Node::split);
    std::size_t count = 1;
    for (unsigned octant = 0; octant < 8; ++octant) {
        // Which octants are of one colour changes from cell to cell, so no branch asks.
        const auto white = static_cast<std::uint8_t>(colors.white >> (8 * octant));
        const auto black = static_cast<std::uint8_t>(colors.black >> (8 * octant));
        const bool leaf = white == 0xFF || black == 0xFF;
        const std::uint32_t gray = two_apart[static_cast<std::uint8_t>(~(white | black))];
        const std::uint32_t split = 3U | (two_apart[black] | gray << 1) << 2;
        nodes |= std::uint64_t{leaf ? black & 1U : split} << (2 * count);
        count += leaf ? 1 : 9;
        // Three octants are at most 27 nodes, and with the first 28.
        if (octant % 3 == 2 || octant == 7) {
            append(nodes, count);
            nodes = 0;
            count = 0;
        }
    }
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
