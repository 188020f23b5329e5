// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#ifdef __BMI2__
#include <immintrin.h>
#endif

#include <octavo/octree/df_code.hpp>

namespace octavo::octree {
namespace {

/// The bits of a number with a zero after each.
std::uint64_t two_apart(std::uint64_t bits) {
#ifdef __BMI2__
    return _pdep_u64(bits, 0x5555555555555555);
#else
    bits &= 0xFFFFFFFF;
    bits = (bits | bits << 16) & 0x0000FFFF0000FFFF;
    bits = (bits | bits << 8) & 0x00FF00FF00FF00FF;
    bits = (bits | bits << 4) & 0x0F0F0F0F0F0F0F0F;
    bits = (bits | bits << 2) & 0x3333333333333333;
    return (bits | bits << 1) & 0x5555555555555555;
#endif
}

struct Nodes {
    std::uint64_t bits;
    std::size_t count;
};

/// Octants of which the leaves are given, 16 bits each: the colour that all eight have, or a split node and the eight.
/// Which are of one colour changes from cell to cell, so no branch asks.
template <unsigned octants>
Nodes up_to_three_octants(std::uint64_t leaves) {
#ifdef __BMI2__
    // All with their eight leaves first, 18 bits each, from which those of octants of one colour are then taken out.
    constexpr std::uint64_t lanes = 0x000100010001 >> (octants == 2 ? 16 : 0), tops = lanes << 15,
                            fields = octants == 2 ? 1 | 1ULL << 18 : 1 | 1ULL << 18 | 1ULL << 36;
    const auto nonzero = [](std::uint64_t v) { return ((v & (tops - lanes)) + (tops - lanes)) | v; };
    const std::uint64_t split = _pext_u64(nonzero(leaves) & nonzero(leaves ^ 0x555555555555), tops),
                        black = _pext_u64(leaves, lanes) & ~split, split_fields = _pdep_u64(split, fields);
    const std::uint64_t nodes =
        _pdep_u64(leaves, 0xFFFF * 4 * fields) | _pdep_u64(black, fields) | 3 * split_fields;
    return {_pext_u64(nodes, 3 * fields | 0xFFFF * 4 * split_fields),
            octants + 8 * static_cast<std::size_t>(std::popcount(split))};
#else
    Nodes nodes{0, 0};
    for (unsigned octant = 0; octant < octants; ++octant) {
        const std::uint64_t eight = leaves >> (16 * octant) & 0xFFFF;
        const std::uint64_t is_one = (eight == 0) | (eight == 0x5555), split = 3U | eight << 2;
        nodes.bits |= (split ^ ((split ^ (eight & 1)) & (0 - is_one))) << (2 * nodes.count);
        nodes.count += 9 - 8 * is_one;
    }
    return nodes;
#endif
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
    write(static_cast<std::uint64_t>(Node::split), 1);
    // The leaves of four octants each.
    const std::uint64_t gray = ~(colors.white | colors.black);
    const std::uint64_t first = two_apart(colors.black) | two_apart(gray) << 1,
                        second = two_apart(colors.black >> 32) | two_apart(gray >> 32) << 1;
    // Three octants are at most 27 nodes.
    for (const std::uint64_t leaves : {first, first >> 48 | second << 16}) {
        const Nodes nodes = up_to_three_octants<3>(leaves);
        write(nodes.bits, nodes.count);
    }
    const Nodes nodes = up_to_three_octants<2>(second >> 32);
    write(nodes.bits, nodes.count);
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
