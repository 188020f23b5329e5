// SPDX-License-Identifier: Apache-2.0
#include <octavo/csg/pair_in_cell.hpp>
#include <octavo/csg/second_look.hpp>

namespace octavo::csg {
namespace {

using octree::Color;

/// Whether gray is exact for a program of one leaf: one plane, or a box along the axes. Of a torus nothing more is
/// known.
bool is_exact(const Program& program, std::span<const std::uint32_t> words) {
    if (!word::is_leaf(words[0])) return false;
    const Leaf& leaf = program.leaves[word::leaf(words[0])];
    if (leaf.kind == LeafKind::convex) return words.size() == 3 && !ConstraintId::is_cone(words[2]);
    return leaf.kind != LeafKind::polyhedron;
}

}  // namespace

Color SecondLook::color(const Program& program, std::span<const std::uint32_t> words,
                        const octree::Cell& cell) {
    if (is_exact(program, words)) return Color::gray;
    if (const std::optional<Color> color = color_of_pair(program, words, cell)) return *color;
    const Seen seen = below_.evaluate(program, words, cell);
    const bool black = seen.octants.black != 0 || seen.points.inside != 0;
    const bool white = seen.octants.white != 0 || seen.points.outside != 0;
    if (black && white) return Color::gray;
    if (seen.octants.gray() == 0) return black ? Color::black : Color::white;
    return arrangement_.resolve(program, words, cell, below_);
}

}  // namespace octavo::csg
