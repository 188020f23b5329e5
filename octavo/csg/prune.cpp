// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <octavo/csg/prune.hpp>

namespace octavo::csg {

Seen Pruner::evaluate(const Program& program, std::span<const std::uint32_t> words,
                      const octree::Cell& parent) {
    program_ = &program;
    remains_.matters.clear();
    remains_.windings.clear();
    nodes_.resize(words.size());
    ++evaluation_;
    unchanged_ = false;
    if (word::is_leaf(words[0])) {
        // One constraint, one box or one torus stays what it is as long as it is gray.
        const LeafKind kind = program.leaves[word::leaf(words[0])].kind;
        unchanged_ = kind != LeafKind::polyhedron && (words.size() == 3 || kind != LeafKind::convex);
    }
    const auto see = [&](std::uint32_t at, std::uint8_t needed) {
        Node& node = nodes_[at];
        node.evaluation = evaluation_;
        node.matters = static_cast<std::uint32_t>(remains_.matters.size());
        node.windings = static_cast<std::uint32_t>(remains_.windings.size());
        const Leaf& leaf = program.leaves[word::leaf(words[at])];
        Seen seen = classify(program, leaf, payload_at(words, at), parent, needed, remains_);
        node.whole = remains_.whole;
        node.met = seen.points.inside != 0 || seen.octants.black != 0;
        if (words[at] & word::complement_bit) seen = complement(seen);
        node.colors = seen.octants;
        return seen;
    };
    const auto note = [&](std::uint32_t at, const Seen& seen) { nodes_[at].colors = seen.octants; };
    return fold_words<Seen>(words, 0xFF, open_, see, note);
}

Pruner::LeafInCell Pruner::leaf_in_cell(std::size_t at) const {
    const Node& node = nodes_[at];
    if (node.evaluation != evaluation_) return {};
    const OctantColors colors = node.colors;
    if (colors.white == 0xFF) return {octree::Color::white, node.met};
    return {colors.black == 0xFF ? octree::Color::black : octree::Color::gray, node.met};
}

void Pruner::prune(std::span<const std::uint32_t> words, int octant, Scratch<std::uint32_t>& buffer) {
    // Words as they are, and for a leaf that had no payload what that takes: two, its items, a winding, and one that
    // is written and not kept.
    std::uint32_t* const room =
        buffer.room(2 * words.size() + remains_.matters.size() + remains_.windings.size() + 1);
    const auto write = [&](std::uint32_t at, std::uint32_t* to) {
        const Node& node = nodes_[at];
        if (node.whole) return std::copy_n(words.data() + at, word::size(words.data() + at), to);
        const std::uint8_t* const matters = remains_.matters.data() + node.matters;
        const bool polyhedron = program_->leaves[word::leaf(words[at])].kind == LeafKind::polyhedron;
        const std::int32_t winding =
            polyhedron ? remains_.windings[node.windings + static_cast<std::size_t>(octant)] : 0;
        return write_leaf(*program_, words, at, winding, to,
                          [&](std::size_t i) { return matters[i] >> octant & 1; });
    };
    buffer.end_at(prune_words(
        words, written_, room, [&](std::uint32_t at) { return nodes_[at].colors[octant]; }, write));
}

}  // namespace octavo::csg
