// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <octavo/csg/classify.hpp>
#include <octavo/csg/convex_overlap.hpp>
#include <octavo/csg/flat_patch.hpp>
#include <octavo/csg/local_arrangement.hpp>
#include <octavo/csg/point_sides.hpp>

namespace octavo::csg {
namespace {

using octree::Color;

LatticePlane axis_plane(int axis, std::int32_t at) {
    LatticePlane plane;
    plane.normal[static_cast<std::size_t>(axis)] = std::int64_t{1} << LatticePlane::normal_bits;
    plane.offset = -(std::int64_t{at} << LatticePlane::normal_bits);
    return plane;
}

Color neutral(std::uint32_t w) {
    const bool full = word::operation(w) == word::intersection ||
                      (word::operation(w) == word::symmetric_difference && (w & word::even_bit));
    return full ? Color::black : Color::white;
}

Color fold(std::uint32_t w, Color a, Color b) {
    switch (word::operation(w)) {
        case word::union_of:
            return octree::unite(a, b);
        case word::intersection:
            return octree::intersect(a, b);
        default:
            return octree::symmetric_difference(a, b);
    }
}

}  // namespace

octree::Color LocalArrangement::resolve(const Program& program, std::span<const std::uint32_t> words,
                                        const octree::Cell& cell, const Pruner& below) {
    program_ = &program;
    below_ = &below;
    cell_ = cell;
    if (repeats_a_leaf(words)) {
        const Color color = arrange(words, Variables::leaves);
        if (is_decided(color)) return color;
    }
    return arrange(words, Variables::surfaces);
}

Color LocalArrangement::arrange(std::span<const std::uint32_t> words, Variables variables) {
    variables_ = variables;
    nodes_.clear();
    literals_.clear();
    count_ = 0;
    if (!read(words)) return Color::gray;
    // A convex body that does not keep off the cell, and has a constraint that cuts it.
    if (nodes_.size() == 1 && literals_.size() > 1) return Color::gray;

    sides_.fill(Color::gray);
    black_ = white_ = false;
    combinations_ = 0;
    try_signs(0);
    if (black_ && !white_) return Color::black;
    return white_ && !black_ ? Color::white : Color::gray;
}

// --- Reading the program -------------------------------------------------------------------------------------

bool LocalArrangement::read(std::span<const std::uint32_t> words) {
    open_.clear();  // `word` is the node, `end` where its words end
    for (std::size_t at = 0; at < words.size();) {
        const std::uint32_t w = words[at];
        if (word::is_leaf(w)) {
            if (!read_leaf(words, at)) return false;
            at += word::size(words.data() + at);
        } else {
            if (word::operation(w) != word::skip) {
                open_.push_back({static_cast<std::uint32_t>(nodes_.size()),
                                 static_cast<std::uint32_t>(at + (w & word::size_mask)), Color::gray});
                nodes_.push_back({Node::Kind::operation, false, w, 0, 0, 0});
            }
            ++at;
        }
        for (; !open_.empty() && open_.back().end == at; open_.pop_back())
            nodes_[open_.back().word].end = static_cast<std::uint32_t>(nodes_.size());
    }
    return true;
}

bool LocalArrangement::repeats_a_leaf(std::span<const std::uint32_t> words) {
    seen_leaves_.clear();
    for (std::size_t at = 0; at < words.size();) {
        if (!word::is_leaf(words[at])) {
            ++at;
            continue;
        }
        const std::uint32_t leaf = word::leaf(words[at]);
        if (std::find(seen_leaves_.begin(), seen_leaves_.end(), leaf) != seen_leaves_.end()) return true;
        if (seen_leaves_.size() == most_surfaces) return false;
        seen_leaves_.push_back(leaf);
        at += word::size(words.data() + at);
    }
    return false;
}

bool LocalArrangement::read_leaf(std::span<const std::uint32_t> words, std::size_t at) {
    const std::uint32_t w = words[at];
    const Leaf& leaf = program_->leaves[word::leaf(w)];
    std::span<const std::uint32_t> items;
    if (w & word::payload_bit) items = words.subspan(at + 2, words[at + 1]);
    Node node{Node::Kind::literals,
              (w & word::complement_bit) != 0,
              0,
              0,
              static_cast<std::uint32_t>(literals_.size()),
              0};
    const Pruner::LeafInCell known = below_->leaf_in_cell(at);
    if (is_decided(known.color)) {  // its complement, if the word says so, is in the colour
        nodes_.push_back({Node::Kind::constant, known.color == Color::black, 0, 0, 0, 0});
        return true;
    }
    if (variables_ == Variables::leaves) {
        node.count = 1;
        nodes_.push_back(node);
        return add_leaf(word::leaf(w));
    }
    bool fits = true;
    switch (leaf.kind) {
        case LeafKind::box:
            fits = read_box(leaf);
            break;
        case LeafKind::convex:
            if (!(w & word::payload_bit)) items = program_->constraints_of(leaf);
            fits = read_convex(items, known.met, node);
            break;
        case LeafKind::torus:
            fits = add_torus(leaf.first);
            break;
        case LeafKind::polyhedron:
            fits = read_polyhedron(word::leaf(w), items, node);
            break;
    }
    node.count = static_cast<std::uint32_t>(literals_.size()) - node.first;
    nodes_.push_back(node);
    return fits;
}

/// The faces of a box that cut through the cell's interior.
bool LocalArrangement::read_box(const Leaf& leaf) {
    const exact::Point low = cell_.low, high = cell_.high();
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        for (const bool lower : {true, false}) {
            const std::int32_t face = lower ? leaf.low[a] : leaf.high[a];
            if (face <= low[axis] || face >= high[axis]) continue;
            if (!add_plane(axis_plane(axis, face), lower)) return false;
        }
    }
    return true;
}

bool LocalArrangement::keeps_off(std::span<const std::uint32_t> constraints) const {
    std::array<LatticePlane, most_constraints> planes;
    std::array<const SecondOrderCone*, most_constraints> cones;
    std::size_t plane_count = 0, cone_count = 0;
    for (const std::uint32_t id : constraints) {
        if (plane_count + cone_count == most_constraints) break;
        if (ConstraintId::is_cone(id))
            cones[cone_count++] = &program_->cones[ConstraintId::index(id)];
        else
            planes[plane_count++] = program_->planes[id];
    }
    if (plane_count == 1 && cone_count == 0) return false;
    return overlap(cell_, {planes.data(), plane_count}, {cones.data(), cone_count}) == Overlap::apart;
}

/// Each constraint meets the cell, or pruning would have removed it; but near an edge of the body all of them together
/// may not, and a quadric alone is seen only by its tangents before this.
bool LocalArrangement::read_convex(std::span<const std::uint32_t> constraints, bool met, Node& node) {
    if (!met && keeps_off(constraints)) {
        node.kind = Node::Kind::constant;
        return true;
    }
    for (const std::uint32_t id : constraints)
        if (!(ConstraintId::is_cone(id) ? add_cone(ConstraintId::index(id))
                                        : add_plane(program_->planes[id], true)))
            return false;
    return true;
}

bool LocalArrangement::read_polyhedron(std::uint32_t leaf_index, std::span<const std::uint32_t> items,
                                       Node& node) {
    const Leaf& leaf = program_->leaves[leaf_index];
    FlatPatch patch;
    if (items.size() >= 2)
        patch =
            flat_patch(program_->polyhedra[leaf.first], cell_, winding_of_word(items[0]), items.subspan(1));
    if (patch.kind == FlatPatch::Kind::constant) {
        node.kind = Node::Kind::constant;
        node.complemented = patch.inside != node.complemented;
        return true;
    }
    if (patch.kind == FlatPatch::Kind::plane) return add_plane(patch.plane, true);
    return add_leaf(leaf_index);
}

// --- Surfaces ------------------------------------------------------------------------------------------------

bool LocalArrangement::add_plane(const LatticePlane& plane, bool value) {
    for (std::size_t s = 0; s < count_; ++s)
        if (surfaces_[s].kind == LocalSurface::Kind::plane)
            if (const int same = same_plane(surfaces_[s].plane, plane); same != 0)
                return add_literal(s, value == (same > 0));
    const LatticePlane side = value ? plane : plane.flipped();
    return add_surface({LocalSurface::Kind::plane, 0, side, sides_of(side, cell_)});
}

bool LocalArrangement::add_cone(std::uint32_t index) {
    for (std::size_t s = 0; s < count_; ++s)
        if (surfaces_[s].kind == LocalSurface::Kind::cone &&
            (surfaces_[s].index == index ||
             same_cone(program_->cones[surfaces_[s].index], program_->cones[index])))
            return add_literal(s, true);
    return add_surface(
        {LocalSurface::Kind::cone, index, {}, sides_of(program_->quadrics[index], cell_).points});
}

bool LocalArrangement::add_torus(std::uint32_t index) {
    for (std::size_t s = 0; s < count_; ++s)
        if (surfaces_[s].kind == LocalSurface::Kind::torus &&
            program_->tori[surfaces_[s].index] == program_->tori[index])
            return add_literal(s, true);
    return add_surface({LocalSurface::Kind::torus, index, {}, {}});
}

bool LocalArrangement::add_leaf(std::uint32_t index) {
    for (std::size_t s = 0; s < count_; ++s)
        if (surfaces_[s].kind == LocalSurface::Kind::leaf && surfaces_[s].index == index)
            return add_literal(s, true);
    return add_surface({LocalSurface::Kind::leaf, index, {}, {}});
}

bool LocalArrangement::add_surface(const LocalSurface& surface) {
    if (count_ == most_surfaces) return false;
    surfaces_[count_] = surface;
    return add_literal(count_++, true);
}

bool LocalArrangement::add_literal(std::size_t surface, bool value) {
    literals_.push_back({static_cast<std::uint8_t>(surface), value});
    return true;
}

// --- Evaluating ----------------------------------------------------------------------------------------------

Color LocalArrangement::color_of(const Node& node) const {
    Color color = Color::black;
    if (node.kind == Node::Kind::constant) color = Color::white;
    for (std::uint32_t i = 0; i < node.count; ++i) {
        const Literal literal = literals_[node.first + i];
        const Color side = sides_[literal.surface];
        color = octree::intersect(color, literal.value ? side : octree::complement(side));
    }
    return node.complemented ? octree::complement(color) : color;
}

Color LocalArrangement::evaluate() {
    open_.clear();
    Color result = Color::gray;
    const auto hand_up = [&](Color color) {
        if (open_.empty())
            result = color;
        else
            open_.back().color = fold(open_.back().word, open_.back().color, color);
    };
    for (std::uint32_t at = 0; at < nodes_.size(); ++at) {
        const Node& node = nodes_[at];
        if (node.kind == Node::Kind::operation)
            open_.push_back({node.word, node.end, neutral(node.word)});
        else
            hand_up(color_of(node));
        while (!open_.empty() && open_.back().end == at + 1) {
            const Color color = open_.back().color;
            open_.pop_back();
            hand_up(color);
        }
    }
    return result;
}

// --- Trying signs --------------------------------------------------------------------------------------------

/// Colours of the regions in which the first `depth` surfaces have the signs chosen so far.
void LocalArrangement::try_signs(std::size_t depth) {
    const Color color = evaluate();
    if (is_decided(color)) {
        (color == Color::black ? black_ : white_) = true;
        return;
    }
    if (depth == count_ || combinations_ >= most_combinations) {
        black_ = white_ = true;  // not known: stay gray
        return;
    }
    for (const Color side : {Color::black, Color::white}) {
        sides_[depth] = side;
        if (is_possible(depth + 1)) try_signs(depth + 1);
        if (black_ && white_) break;
    }
    sides_[depth] = Color::gray;
}

/// False when no point of the cell's interior has these signs.
bool LocalArrangement::is_possible(std::size_t depth) {
    ++combinations_;
    std::array<LatticePlane, most_surfaces> planes;
    std::array<const SecondOrderCone*, most_surfaces> cones;
    std::size_t plane_count = 0, cone_count = 0;
    std::uint64_t points = PointColors::all;
    for (std::size_t s = 0; s < depth; ++s) {
        const LocalSurface& surface = surfaces_[s];
        const bool inside = sides_[s] == Color::black;
        if (surface.kind == LocalSurface::Kind::plane) {
            planes[plane_count++] = inside ? surface.plane : surface.plane.flipped();
            points &= inside ? surface.points.inside : surface.points.outside;
        } else if (surface.kind == LocalSurface::Kind::cone && inside) {
            cones[cone_count++] = &program_->cones[surface.index];
            points &= surface.points.inside;
        }
    }
    // One surface alone meets the cell on both sides, or pruning would have removed it.
    if (plane_count + cone_count < 2 || points != 0) return true;
    return overlap(cell_, {planes.data(), plane_count}, {cones.data(), cone_count}) != Overlap::apart;
}

}  // namespace octavo::csg
