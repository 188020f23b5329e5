// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

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
// A class Seen (seen.hpp) has: Cells, a set of cells, and any(cells); all() and none(), what everything and nothing look
// like; unsettled(operation, cells), the cells that the operands seen so far leave open; forget_points(operation), for
// operands that were not looked at; and the set operations.

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

/// An operation that is being written.
struct WrittenOperation {
    std::uint32_t end;    // in the words read
    std::uint32_t* word;  // in the words written
    std::uint32_t count;  // operands written
};

/// Writes what is undecided in one cell. `color(at)` is that of the node at a word there, `write_leaf(at, to)` writes
/// a leaf and returns the end. The program must be gray in the cell. Returns the end of what was written.
template <class ColorOf, class WriteLeaf>
std::uint32_t* prune_words(std::span<const std::uint32_t> words, std::vector<WrittenOperation>& written,
                           std::uint32_t* to, const ColorOf& color_of, const WriteLeaf& write_leaf) {
    if (word::is_leaf(words[0])) return write_leaf(0, to);
    written.clear();
    std::uint32_t at = 0;
    const auto end = static_cast<std::uint32_t>(words.size());
    for (;;) {
        while (!written.empty() && written.back().end == at) {
            const WrittenOperation closed = written.back();
            written.pop_back();
            std::uint32_t& w = *closed.word;
            w = (w & ~word::size_mask) | static_cast<std::uint32_t>(to - closed.word);
            if (closed.count > 1) continue;
            // One operand left: it stands for the operation, complemented where an even count was asked for.
            std::uint32_t& operand = closed.word[1];
            const bool flip = word::operation(w) == word::symmetric_difference && (w & word::even_bit);
            if (flip && !word::is_leaf(operand)) continue;
            if (flip) operand ^= word::complement_bit;
            w = std::uint32_t{word::skip} << word::operation_shift;
        }
        if (at == end) return to;
        const std::uint32_t w = words[at];
        if (!word::is_leaf(w) && word::operation(w) == word::skip) {
            ++at;
            continue;
        }
        const octree::Color color = color_of(at);
        if (color != octree::Color::gray) {
            if (color == octree::Color::black && !written.empty()) {
                std::uint32_t& around = *written.back().word;
                if (word::operation(around) == word::symmetric_difference) around ^= word::even_bit;
            }
            at += word::size(words.data() + at);
            continue;
        }
        if (!written.empty()) ++written.back().count;
        if (word::is_leaf(w)) {
            to = write_leaf(at, to);
            at += word::size(words.data() + at);
        } else {
            written.push_back({at + (w & word::size_mask), to, 0});
            *to++ = w;
            ++at;
        }
    }
}

/// The payload of a leaf: all of it (`items` empty and `all` true), or the words after the count.
struct Payload {
    bool all = true;
    std::span<const std::uint32_t> items;
};
inline Payload payload_at(std::span<const std::uint32_t> words, std::size_t at) {
    if (!(words[at] & word::payload_bit)) return {};
    return {false, words.subspan(at + 2, words[at + 1])};
}
/// Payload word of a polyhedron that precedes its triangles.
inline std::int32_t winding_of_word(std::uint32_t word) { return static_cast<std::int32_t>(word); }

/// Writes the leaf at a word with those items of its payload that matter, `matters(i)` by their place in it; `winding`
/// is that of a polyhedron in the cell.
template <class Matters>
std::uint32_t* write_leaf(const Program& program, std::span<const std::uint32_t> words, std::size_t at,
                          std::int32_t winding, std::uint32_t* to, const Matters& matters) {
    const std::uint32_t w = words[at];
    const Leaf& leaf = program.leaves[word::leaf(w)];
    if (leaf.kind == LeafKind::box || leaf.kind == LeafKind::torus) {
        *to++ = w;
        return to;
    }
    *to++ = w | word::payload_bit;
    std::uint32_t* const count = to++;
    Payload payload = payload_at(words, at);
    std::size_t i = 0;
    if (leaf.kind == LeafKind::polyhedron) {
        *to++ = static_cast<std::uint32_t>(winding);
        const std::size_t triangles = payload.all ? program.polyhedra[leaf.first].triangles.size() : 0;
        for (; i < triangles; ++i) {
            *to = static_cast<std::uint32_t>(i);
            to += matters(i);
        }
        if (!payload.all) payload.items = payload.items.subspan(1);
    } else if (payload.all) {
        payload.items = program.constraints_of(leaf);
    }
    for (const std::uint32_t item : payload.items) {
        *to = item;
        to += matters(i++);
    }
    *count = static_cast<std::uint32_t>(to - count - 1);
    return to;
}

}  // namespace octavo::csg
