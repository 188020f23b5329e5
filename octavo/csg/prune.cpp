// SPDX-License-Identifier: Apache-2.0
#pragma GCC diagnostic ignored "-Wpsabi"  // vectors do not leave this file

#include <algorithm>
#include <cstring>

#include <octavo/csg/prune.hpp>

namespace octavo::csg {

Seen Pruner::evaluate(const Program& program, std::span<const std::uint32_t> words,
                      const octree::Cell& parent) {
    return evaluate_as<Seen>(program, words, parent);
}

OctantColors Pruner::evaluate_colors(const Program& program, std::span<const std::uint32_t> words,
                                     const octree::Cell& parent) {
    return evaluate_as<ColorsSeen>(program, words, parent).octants;
}

template <class SeenOfNode>
SeenOfNode Pruner::evaluate_as(const Program& program, std::span<const std::uint32_t> words,
                               const octree::Cell& parent) {
    program_ = &program;
    remains_.matters.clear();
    remains_.windings.clear();
    nodes_.resize(words.size());
    room_ = {};
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
        SeenOfNode seen =
            classify<SeenOfNode>(program, leaf, payload_at(words, at), parent, needed, remains_);
        node.whole = remains_.whole;
        node.met = seen.octants.black != 0;
        if constexpr (SeenOfNode::has_points) node.met |= seen.points.inside != 0;
        if (words[at] & word::complement_bit) seen = complement(seen);
        node.colors = seen.octants;
        // As it is, or with a payload: two words, its items and a winding.
        const std::size_t items = remains_.matters.size() - node.matters;
        make_room(seen.octants, std::max<std::size_t>(word::size(words.data() + at), items + 3));
        return seen;
    };
    const auto note = [&](std::uint32_t at, const SeenOfNode& seen) {
        nodes_[at].colors = seen.octants;
        make_room(seen.octants, 1);
    };
    if constexpr (SeenOfNode::has_points)
        return fold_words<SeenOfNode>(words, 0xFF, open_, see, note);
    else
        return fold_words<SeenOfNode>(words, 0xFF, open_colors_, see, note);
}

/// Room for so many words more in the gray octants.
void Pruner::make_room(OctantColors colors, std::size_t words) {
    using Counts = std::uint32_t __attribute__((vector_size(32)));
    constexpr Counts bit_of_octant{1, 2, 4, 8, 16, 32, 64, 128};
    Counts room;
    std::memcpy(&room, room_.data(), sizeof room);
    const auto gray = (static_cast<std::uint32_t>(colors.gray()) & bit_of_octant) != 0;
    room += gray ? Counts{} + static_cast<std::uint32_t>(words) : Counts{};
    std::memcpy(room_.data(), &room, sizeof room);
}

Pruner::LeafInCell Pruner::leaf_in_cell(std::size_t at) const {
    const Node& node = nodes_[at];
    if (node.evaluation != evaluation_) return {};
    const OctantColors colors = node.colors;
    if (colors.white == 0xFF) return {octree::Color::white, node.met};
    return {colors.black == 0xFF ? octree::Color::black : octree::Color::gray, node.met};
}

std::array<Pruner::Part, 8> Pruner::prune(std::span<const std::uint32_t> words, unsigned octants,
                                          Scratch<std::uint32_t>& buffer) {
    std::array<Part, 8> parts{};
    std::size_t size = 0;
    for_each_bit(octants, [&](std::size_t i) {
        parts[i].begin = static_cast<std::uint32_t>(buffer.size() + size);
        size += room_[i] + 1;  // one is written and not kept
    });
    std::uint32_t* const room = buffer.room(size);
    std::array<std::uint32_t*, 8> to{};
    for_each_bit(octants, [&](std::size_t i) { to[i] = buffer.data() + parts[i].begin; });
    const auto write = [&](std::uint32_t at, unsigned gray, std::array<std::uint32_t*, 8>& ends) {
        const Node& node = nodes_[at];
        const Leaf& leaf = program_->leaves[word::leaf(words[at])];
        const std::uint8_t* const matters = remains_.matters.data() + node.matters;
        if (node.whole) {
            const std::uint32_t length = word::size(words.data() + at);
            for_each_bit(gray,
                         [&](std::size_t i) { ends[i] = std::copy_n(words.data() + at, length, ends[i]); });
        } else if (leaf.kind == LeafKind::convex) {
            const std::span<const std::uint32_t> constraints = constraints_at(*program_, leaf, words, at);
            for_each_bit(gray, [&](std::size_t octant) {
                ends[octant] = write_convex(words[at], constraints, ends[octant],
                                            [&](std::size_t i) { return matters[i] >> octant & 1; });
            });
        } else {
            for_each_bit(gray, [&](std::size_t octant) {
                const std::int32_t winding =
                    leaf.kind == LeafKind::polyhedron ? remains_.windings[node.windings + octant] : 0;
                ends[octant] = write_leaf(*program_, words, at, winding, ends[octant],
                                          [&](std::size_t i) { return matters[i] >> octant & 1; });
            });
        }
    };
    prune_words(
        words, written_, octants, to, [&](std::uint32_t at) { return nodes_[at].colors; }, write);
    std::uint32_t* last = room;
    for_each_bit(octants, [&](std::size_t i) {
        parts[i].size = static_cast<std::uint32_t>(to[i] - buffer.data()) - parts[i].begin;
        last = to[i];
    });
    buffer.end_at(last);
    return parts;
}

}  // namespace octavo::csg
