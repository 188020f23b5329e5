// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include <octavo/csg/octant_colors.hpp>
#include <octavo/csg/program.hpp>
#include <octavo/csg/scratch.hpp>

// Two walks over a program: one evaluates it in several cells at once, one writes what is undecided in one of them.
//
// Both are loops over words in prefix order with a stack of open operations; nothing recurses, and no memory is
// allocated once the buffers have grown. They are templates over what is seen of a node: colours of eight octants
// (prune.hpp) or of 64 cells (brick.hpp). The short circuits of the source (an operand that decides an operation ends
// it) apply to all cells at once: an operand is looked at only when some cell still needs it. An operation left with
// one operand keeps its place as a `skip` word until the next pass, which saves moving what follows.
//
// A class Seen (seen.hpp) has: Cells, a set of cells, and any(cells); all() and none(), what everything and nothing
// look like; unsettled(operation, cells), the cells that the operands seen so far leave open; forget_points(operation),
// for operands that were not looked at; and the set operations.

namespace octavo::csg {

/// An operation whose operands are being evaluated.
template <class Seen>
struct OpenOperation {
    std::uint32_t word;
    std::uint32_t end;
    typename Seen::Cells needed;
    Seen seen;
};

template <class Seen>
Seen neutral(std::uint32_t w) {
    switch (word::operation(w)) {
        case word::union_of:
            return Seen::none();
        case word::intersection:
            return Seen::all();
        default:
            return w & word::even_bit ? Seen::all() : Seen::none();
    }
}

/// One more operand of an operation.
template <class Seen>
void fold_in(std::uint32_t w, Seen& seen, const Seen& operand) {
    switch (word::operation(w)) {
        case word::union_of:
            seen = unite(seen, operand);
            break;
        case word::intersection:
            seen = intersect(seen, operand);
            break;
        default:
            seen = symmetric_difference(seen, operand);
    }
}

/// Evaluates `words`. `see(at, needed)` looks at the leaf at a word, `note(at, seen)` keeps what an operation is.
template <class Seen, class See, class Note>
Seen fold_words(std::span<const std::uint32_t> words, const typename Seen::Cells& all_needed,
                std::vector<OpenOperation<Seen>>& open, const See& see, const Note& note) {
    std::uint32_t at = 0;
    while (!word::is_leaf(words[at]) && word::operation(words[at]) == word::skip) ++at;
    if (word::is_leaf(words[at])) return see(at, all_needed);
    const auto begin = [&](const typename Seen::Cells& needed) {
        const std::uint32_t w = words[at];
        return OpenOperation<Seen>{at, at + (w & word::size_mask), needed, neutral<Seen>(w)};
    };
    open.clear();
    OpenOperation<Seen> around = begin(all_needed);
    ++at;
    for (;;) {
        if (at == around.end) {  // it goes to the operation around it as an operand
            note(around.word, around.seen);
            if (open.empty()) return around.seen;
            fold_in(words[open.back().word], open.back().seen, around.seen);
            around = open.back();
            open.pop_back();
            continue;
        }
        const std::uint32_t w = words[at];
        if (!word::is_leaf(w) && word::operation(w) == word::skip) {
            ++at;
            continue;
        }
        const typename Seen::Cells needed =
            around.seen.unsettled(word::operation(words[around.word]), around.needed);
        if (!Seen::any(needed)) {
            around.seen.forget_points(word::operation(words[around.word]));
            at = around.end;
        } else if (word::is_leaf(w)) {
            fold_in(words[around.word], around.seen, see(at, needed));
            at += word::size(words.data() + at);
        } else {
            open.push_back(around);
            around = begin(needed);
            ++at;
        }
    }
}

/// An operation that is being written, in some of up to eight cells.
struct WrittenOperation {
    std::uint32_t end;  // in the words read
    word::Operation operation;
    unsigned cells;                      // in which it is written; only these have what follows
    std::array<std::uint32_t*, 8> word;  // in the words written
    std::array<std::uint32_t, 8> operands;
};

template <class Visit>
void for_each_bit(unsigned bits, const Visit& visit) {
    for (; bits != 0; bits &= bits - 1) visit(static_cast<std::size_t>(std::countr_zero(bits)));
}

/// Ends an operation in one cell.
inline void close_operation(std::uint32_t* word, std::uint32_t operands, const std::uint32_t* end) {
    std::uint32_t& w = *word;
    w = (w & ~word::size_mask) | static_cast<std::uint32_t>(end - word);
    if (operands > 1) return;
    // One operand left: it stands for the operation, complemented where an even count was asked for.
    const bool flip = word::operation(w) == word::symmetric_difference && (w & word::even_bit);
    if (flip && !word::is_leaf(word[1])) return;
    if (flip) word[1] ^= word::complement_bit;
    w = std::uint32_t{word::skip} << word::operation_shift;
}

/// Writes what is undecided in each of some cells, of up to eight, in one pass over the words: each is needed in one or
/// two cells only. `colors_at(at)` are those of the node at a word, `write_leaf(at, cells, to)` writes a leaf in some
/// of the cells and moves their `to` on. The program must be gray in the cells. `to` is moved on to the ends of what
/// was written.
template <class ColorsAt, class WriteLeaf>
void prune_words(std::span<const std::uint32_t> words, std::vector<WrittenOperation>& written, unsigned cells,
                 std::array<std::uint32_t*, 8>& to, const ColorsAt& colors_at, const WriteLeaf& write_leaf) {
    written.clear();
    std::uint32_t at = 0;
    const auto end = static_cast<std::uint32_t>(words.size());
    for (;;) {
        for (; !written.empty() && written.back().end == at; written.pop_back()) {
            const WrittenOperation& closed = written.back();
            for_each_bit(closed.cells,
                         [&](std::size_t i) { close_operation(closed.word[i], closed.operands[i], to[i]); });
        }
        if (at == end) return;
        const std::uint32_t w = words[at];
        if (!word::is_leaf(w) && word::operation(w) == word::skip) {
            ++at;
            continue;
        }
        const OctantColors colors = colors_at(at);
        unsigned gray = cells & colors.gray();
        if (!written.empty()) {
            WrittenOperation& around = written.back();
            gray = around.cells & colors.gray();
            if (around.operation == word::symmetric_difference)
                for_each_bit(around.cells & colors.black,
                             [&](std::size_t i) { *around.word[i] ^= word::even_bit; });
            for_each_bit(gray, [&](std::size_t i) { ++around.operands[i]; });
        }
        if (gray == 0 || word::is_leaf(w)) {
            if (gray != 0) write_leaf(at, gray, to);
            at += word::size(words.data() + at);
            continue;
        }
        WrittenOperation& open = written.emplace_back();
        open.end = at + (w & word::size_mask);
        open.operation = word::operation(w);
        open.cells = gray;
        for_each_bit(gray, [&](std::size_t i) {
            open.word[i] = to[i];
            open.operands[i] = 0;
            *to[i]++ = w;
        });
        ++at;
    }
}

/// The payload of a leaf: all of it, or the words after the count. Two numbers, since three would go through memory.
struct Payload {
    std::span<const std::uint32_t> items;

    bool all() const { return items.data() == nullptr; }
};
inline Payload payload_at(std::span<const std::uint32_t> words, std::size_t at) {
    if (!(words[at] & word::payload_bit)) return {};
    return {words.subspan(at + 2, words[at + 1])};
}
/// Payload word of a polyhedron that precedes its triangles.
inline std::int32_t winding_of_word(std::uint32_t word) { return static_cast<std::int32_t>(word); }

/// The constraints of the convex leaf at a word.
inline std::span<const std::uint32_t> constraints_at(const Program& program, const Leaf& leaf,
                                                     std::span<const std::uint32_t> words, std::size_t at) {
    const Payload payload = payload_at(words, at);
    return payload.all() ? program.constraints_of(leaf) : payload.items;
}

/// Writes those of some words for which `matters` holds, by their place, and returns the end.
template <class Matters>
std::uint32_t* write_items(std::span<const std::uint32_t> items, std::uint32_t* to, const Matters& matters) {
    for (std::size_t i = 0; i < items.size(); ++i) {
        *to = items[i];
        to += matters(i);
    }
    return to;
}

/// Writes a convex leaf with those of its constraints that matter.
template <class Matters>
std::uint32_t* write_convex(std::uint32_t w, std::span<const std::uint32_t> constraints, std::uint32_t* to,
                            const Matters& matters) {
    std::uint32_t* const end = write_items(constraints, to + 2, matters);
    to[0] = w | word::payload_bit;
    to[1] = static_cast<std::uint32_t>(end - to - 2);
    return end;
}

/// Writes the leaf at a word with those items of its payload that matter, `matters(i)` by their place in it; `winding`
/// is that of a polyhedron in the cell.
template <class Matters>
std::uint32_t* write_leaf(const Program& program, std::span<const std::uint32_t> words, std::size_t at,
                          std::int32_t winding, std::uint32_t* to, const Matters& matters) {
    const std::uint32_t w = words[at];
    const Leaf& leaf = program.leaves[word::leaf(w)];
    if (leaf.kind == LeafKind::convex)
        return write_convex(w, constraints_at(program, leaf, words, at), to, matters);
    if (leaf.kind != LeafKind::polyhedron) {
        *to++ = w;
        return to;
    }
    std::uint32_t* end = to + 3;
    to[0] = w | word::payload_bit;
    to[2] = static_cast<std::uint32_t>(winding);
    if (const Payload payload = payload_at(words, at); !payload.all()) {
        end = write_items(payload.items.subspan(1), end, matters);
    } else {
        for (std::size_t i = 0; i < program.polyhedra[leaf.first].triangles.size(); ++i) {
            *end = static_cast<std::uint32_t>(i);
            end += matters(i);
        }
    }
    to[1] = static_cast<std::uint32_t>(end - to - 2);
    return end;
}

}  // namespace octavo::csg
