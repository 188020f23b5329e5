// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <octavo/octree/df_code.hpp>

namespace octavo::octree {

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
