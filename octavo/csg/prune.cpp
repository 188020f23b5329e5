// SPDX-License-Identifier: Apache-2.0
#include <octavo/csg/prune.hpp>

namespace octavo::csg {
namespace {

OctantColors neutral(std::uint32_t w) {
    switch (word::operation(w)) {
        case word::union_of:
            return OctantColors::all_white();
        case word::intersection:
            return OctantColors::all_black();
        default:
            return w & word::even_bit ? OctantColors::all_black() : OctantColors::all_white();
    }
}

OctantColors fold(std::uint32_t w, OctantColors a, OctantColors b) {
    switch (word::operation(w)) {
        case word::union_of:
            return unite(a, b);
        case word::intersection:
            return intersect(a, b);
        default:
            return symmetric_difference(a, b);
    }
}

/// Octants for which the operands seen so far do not settle the operation. In a symmetric difference nothing
/// does, and the colours of the rest are needed for pruning even where one operand is gray.
std::uint8_t unsettled(std::uint32_t w, OctantColors so_far) {
    switch (word::operation(w)) {
        case word::union_of:
            return static_cast<std::uint8_t>(~so_far.black);
        case word::intersection:
            return static_cast<std::uint8_t>(~so_far.white);
        default:
            return 0xFF;
    }
}

Payload payload_at(std::span<const std::uint32_t> words, std::size_t at) {
    if (!(words[at] & word::payload_bit)) return {};
    return {false, words.subspan(at + 2, words[at + 1])};
}

}  // namespace

OctantColors Pruner::evaluate_leaf(const Program& program, std::span<const std::uint32_t> words,
                                   std::size_t at, const octree::Cell& parent, std::uint8_t needed) {
    const Leaf& leaf = program.leaves[word::leaf(words[at])];
    matters_[at] = static_cast<std::uint32_t>(remains_.matters.size());
    windings_[at] = static_cast<std::uint32_t>(remains_.windings.size());
    const OctantColors colors = classify(program, leaf, payload_at(words, at), parent, needed, remains_);
    return words[at] & word::complement_bit ? complement(colors) : colors;
}

OctantColors Pruner::evaluate(const Program& program, std::span<const std::uint32_t> words,
                              const octree::Cell& parent) {
    program_ = &program;
    remains_.matters.clear();
    remains_.windings.clear();
    if (colors_.size() < words.size()) {
        colors_.resize(words.size());
        matters_.resize(words.size());
        windings_.resize(words.size());
    }
    if (word::is_leaf(words[0])) {  // most cells near the bottom
        colors_[0] = evaluate_leaf(program, words, 0, parent, 0xFF);
        // One constraint, one box or one torus stays what it is as long as it is gray.
        const LeafKind kind = program.leaves[word::leaf(words[0])].kind;
        unchanged_ = kind != LeafKind::polyhedron && (words.size() == 3 || kind != LeafKind::convex);
        return colors_[0];
    }
    unchanged_ = false;
    open_.clear();
    std::uint32_t at = 0;
    const auto end = static_cast<std::uint32_t>(words.size());
    OctantColors result;
    for (;;) {
        // Operations that end here hand their colours to the one around them.
        while (!open_.empty() && open_.back().end == at) {
            const Open closed = open_.back();
            open_.pop_back();
            colors_[closed.word] = closed.colors;
            if (open_.empty())
                result = closed.colors;
            else
                open_.back().colors = fold(words[open_.back().word], open_.back().colors, closed.colors);
        }
        if (at == end) return result;
        std::uint8_t needed = 0xFF;
        if (!open_.empty()) {
            const Open& around = open_.back();
            needed = around.needed & unsettled(words[around.word], around.colors);
            if (needed == 0) {
                at = around.end;
                continue;
            }
        }
        const std::uint32_t w = words[at];
        if (word::is_leaf(w)) {
            const OctantColors colors = evaluate_leaf(program, words, at, parent, needed);
            colors_[at] = colors;
            at += word::size(words.data() + at);
            if (open_.empty())
                result = colors;
            else
                open_.back().colors = fold(words[open_.back().word], open_.back().colors, colors);
        } else {
            if (word::operation(w) != word::skip)
                open_.push_back({at, at + (w & word::size_mask), needed, neutral(w)});
            ++at;
        }
    }
}

void Pruner::write_leaf(std::span<const std::uint32_t> words, std::size_t at, int octant,
                        std::vector<std::uint32_t>& to) {
    const std::uint32_t w = words[at];
    const Leaf& leaf = program_->leaves[word::leaf(w)];
    if (leaf.kind == LeafKind::box || leaf.kind == LeafKind::torus) {
        to.push_back(w);
        return;
    }
    to.push_back(w | word::payload_bit);
    const std::size_t count_at = to.size();
    to.push_back(0);
    const Payload payload = payload_at(words, at);
    const std::uint8_t* matters = remains_.matters.data() + matters_[at];
    if (leaf.kind == LeafKind::convex) {
        const std::span<const std::uint32_t> items =
            payload.all ? program_->constraints_of(leaf) : payload.items;
        for (std::size_t i = 0; i < items.size(); ++i)
            if (matters[i] >> octant & 1) to.push_back(items[i]);
    } else {
        to.push_back(
            static_cast<std::uint32_t>(remains_.windings[windings_[at] + static_cast<std::size_t>(octant)]));
        if (payload.all) {
            const std::size_t count = program_->polyhedra[leaf.first].triangles.size();
            for (std::size_t i = 0; i < count; ++i)
                if (matters[i] >> octant & 1) to.push_back(static_cast<std::uint32_t>(i));
        } else {
            for (std::size_t i = 1; i < payload.items.size(); ++i)
                if (matters[i - 1] >> octant & 1) to.push_back(payload.items[i]);
        }
    }
    to[count_at] = static_cast<std::uint32_t>(to.size() - count_at - 1);
}

void Pruner::prune(std::span<const std::uint32_t> words, int octant, std::vector<std::uint32_t>& to) {
    written_.clear();
    std::uint32_t at = 0;
    const auto end = static_cast<std::uint32_t>(words.size());
    for (;;) {
        while (!written_.empty() && written_.back().end == at) {
            const Written closed = written_.back();
            written_.pop_back();
            std::uint32_t& w = to[closed.word];
            const auto size = static_cast<std::uint32_t>(to.size() - closed.word);
            w = (w & ~word::size_mask) | size;
            if (closed.count > 1) continue;
            // One operand left: it stands for the operation, complemented where an even count was asked for.
            const bool flip = word::operation(w) == word::symmetric_difference && (w & word::even_bit);
            if (flip && !word::is_leaf(to[closed.word + 1])) continue;
            if (flip) to[closed.word + 1] ^= word::complement_bit;
            w = std::uint32_t{word::skip} << word::operation_shift;
        }
        if (at == end) return;
        const std::uint32_t w = words[at];
        if (!word::is_leaf(w) && word::operation(w) == word::skip) {
            ++at;
            continue;
        }
        const octree::Color color = colors_[at][octant];
        if (color != octree::Color::gray) {
            if (color == octree::Color::black && !written_.empty()) {
                std::uint32_t& around = to[written_.back().word];
                if (word::operation(around) == word::symmetric_difference) around ^= word::even_bit;
            }
            at += word::size(words.data() + at);
            continue;
        }
        if (!written_.empty()) ++written_.back().count;
        if (word::is_leaf(w)) {
            write_leaf(words, at, octant, to);
            at += word::size(words.data() + at);
        } else {
            written_.push_back({at + (w & word::size_mask), to.size(), 0});
            to.push_back(w);
            ++at;
        }
    }
}

}  // namespace octavo::csg
