// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <optional>

#include <octavo/csg/brick.hpp>
#include <octavo/csg/classify.hpp>

namespace octavo::csg {
namespace {

// Looking at bounds first pays where leaves are many.
constexpr std::size_t many_words = 32;

/// Where the operands of a program that is a union begin; past its end where it is none.
std::uint32_t first_operand_of_union(std::span<const std::uint32_t> words) {
    std::uint32_t at = 0;
    while (!word::is_leaf(words[at]) && word::operation(words[at]) == word::skip) ++at;
    const bool unites = !word::is_leaf(words[at]) && word::operation(words[at]) == word::union_of;
    return unites ? at + 1 : static_cast<std::uint32_t>(words.size());
}

std::array<std::int32_t, 3> middle_of_box(const Leaf& leaf) {
    std::array<std::int32_t, 3> middle;
    for (std::size_t a = 0; a < 3; ++a) middle[a] = (leaf.low[a] + leaf.high[a]) / 2;
    return middle;
}

/// The cell of a brick that holds a lattice point.
std::optional<BrickCell> cell_of(const std::array<std::int32_t, 3>& point, const octree::Cell& brick) {
    if (!brick.contains({point[0], point[1], point[2]})) return {};
    const int shift = std::countr_zero(static_cast<std::uint32_t>(brick.side())) - 2;
    const auto quarters = [&](int axis) {
        return static_cast<std::uint32_t>(point[static_cast<std::size_t>(axis)] - brick.low[axis]) >> shift;
    };
    return BrickCell{quarters(0), quarters(1), quarters(2)};
}

}  // namespace

/// Cells that have been shown to be gray stay so: of them leaves were perhaps not looked at.
inline void Brick::give(const LayerPair& cells, const LayerPair& reached) {
    colors_.cells = {cells.out & open_cells_, cells.in & open_cells_};
    colors_.unproved = without(neither(colors_.cells, open_cells_), reached.out & reached.in);
}

void Brick::look(const Program& program, std::span<const std::uint32_t> words, const octree::Cell& parent) {
    program_ = &program;
    words_ = words;
    ++looks_;
    matters_.clear();
    windings_.clear();
    surfaces_.clear();
    nodes_.resize(words.size());
    open_cells_ = Layers::cells();
    if (words.size() >= many_words) open_cells_ = without(open_cells_, gray_by_bounds(parent));
    const auto see = [&](std::uint32_t at, const Layers& needed) {
        Node& node = nodes_[at];
        node.matters = static_cast<std::uint32_t>(matters_.size());
        node.windings = static_cast<std::uint32_t>(windings_.size());
        node.surfaces = static_cast<std::uint32_t>(surfaces_.size());
        node.surface_count = 0;
        node.look = looks_;
        node.needed = needed;
        node.body = {};
        CornersSeen seen =
            look_at(program.leaves[word::leaf(words[at])], payload_at(words, at), parent, node);
        node.seen = seen;
        if (words[at] & word::complement_bit) seen = complement(seen);
        node.cells = seen.cells;
        return seen;
    };
    const auto note = [&](std::uint32_t at, const CornersSeen& seen) { nodes_[at].cells = seen.cells; };
    if (!open_cells_.any()) {
        colors_ = {};
        return;
    }
    const CornersSeen seen = fold_words<CornersSeen>(words, open_cells_, open_, see, note);
    reached_by_corners_ = seen.reached();
    give(seen.cells, reached_by_corners_);
}

/// Cells in which a point of a leaf lies and a corner, or a part, is out of all boxes: most of those at the bottom of
/// a scene of bodies smaller than they are, where each would else be looked at for six leaves.
Layers Brick::gray_by_bounds(const octree::Cell& parent) {
    // Of a union one point is enough.
    Layers entered;
    std::uint32_t operand = first_operand_of_union(words_);
    const auto see = [&](std::uint32_t at, const Layers&) {
        const Leaf& leaf = program_->leaves[word::leaf(words_[at])];
        // Words that were skipped have no size.
        while (operand < at) operand += std::max(word::size(&words_[operand]), 1U);
        const bool complemented = (words_[at] & word::complement_bit) != 0;
        const BrickSides box = brick_sides_of_box(leaf, parent);
        BoundsSeen seen{{{box.white, box.black}, box.corners},
                        {{box.white, box.black}, {box.white, box.black}}};
        if (leaf.kind == LeafKind::box) {
            seen.reach.reached.in = without(Layers::cells(), box.white);
        } else if (const std::optional<BrickCell> cell = cell_of(middle_of_box(leaf), parent);
                   cell && leaf.kind == LeafKind::convex && !complemented && !cell->in(entered)) {
            ++tests_;
            if (holds_middle(leaf)) cell->add_to(seen.reach.reached.in);
        }
        if (operand == at && !complemented) entered = entered | seen.reach.reached.in;
        return complemented ? complement(seen) : seen;
    };
    return fold_words<BoundsSeen>(words_, Layers::cells(), open_bounds_, see,
                                  [](std::uint32_t, const BoundsSeen&) {})
        .gray();
}

/// Whether the middle of its box is strictly inside a convex body, as it is of all but some cones and hulls.
bool Brick::holds_middle(const Leaf& leaf) const {
    const auto [x, y, z] = middle_of_box(leaf);
    for (const std::uint32_t id : program_->constraints_of(leaf)) {
        if (!ConstraintId::is_cone(id)) {
            if (program_->planes[id].at(x, y, z) <= 0) return false;
            continue;
        }
        const SecondOrderCone& cone = program_->cones[ConstraintId::index(id)];
        const double dx = x - cone.origin[0], dy = y - cone.origin[1], dz = z - cone.origin[2],
                     farthest = std::max({std::fabs(dx), std::fabs(dy), std::fabs(dz)});
        if (!(cone.excess(dx, dy, dz) < -cone.error(farthest))) return false;
    }
    return true;
}

void Brick::ask(BodiesInCells& bodies) {
    if (!colors_.unproved.any()) return;
    for (std::uint32_t at = 0; at < words_.size();
         at += word::is_leaf(words_[at]) ? word::size(&words_[at]) : 1) {
        if (!word::is_leaf(words_[at])) continue;
        Node& node = nodes_[at];
        if (node.look != looks_ || node.surface_count == 0) continue;
        // Where no corner lies in the body.
        const Layers asked =
            without(without(colors_.unproved & node.needed, node.seen.cells.out), node.seen.reached().in);
        for_each_cell(asked, [&](BrickCell cell) {
            bodies.ask({surfaces_.data() + node.surfaces, node.surface_count}, matters_.data() + node.matters,
                       cell, node.body);
        });
    }
}

const Brick::Colors& Brick::settle() {
    if (!colors_.unproved.any()) return colors_;
    const auto see = [&](std::uint32_t at, const Layers&) {
        Node& node = nodes_[at];
        const LayerPair reached = node.seen.reached();
        ReachSeen seen{
            {node.seen.cells.out | node.body.missed, without(node.seen.cells.in, node.body.missed)},
            {reached.out | node.body.missed, reached.in | node.body.entered}};
        if (words_[at] & word::complement_bit) seen = complement(seen);
        node.cells = seen.cells;
        return seen;
    };
    const auto note = [&](std::uint32_t at, const ReachSeen& seen) { nodes_[at].cells = seen.cells; };
    const ReachSeen seen = fold_words<ReachSeen>(words_, open_cells_, open_again_, see, note);
    give(seen.cells, {reached_by_corners_.out | seen.reached.out, reached_by_corners_.in | seen.reached.in});
    return colors_;
}

const Brick::Colors& Brick::evaluate(const Program& program, std::span<const std::uint32_t> words,
                                     const octree::Cell& parent) {
    BodiesInCells bodies;
    look(program, words, parent);
    ask(bodies);
    bodies.finish();
    return settle();
}

CornersSeen Brick::look_at(const Leaf& leaf, Payload payload, const octree::Cell& parent, Node& node) {
    const BrickSides box = brick_sides_of_box(leaf, parent);
    const Layers met = without(node.needed, box.white);
    tests_ += static_cast<std::uint64_t>(met.count_cells());
    if (leaf.kind == LeafKind::box) return {{box.white, box.black}, box.corners};
    if (!met.any()) return {{box.white, {}}, {box.corners.out, {}}};
    switch (leaf.kind) {
        case LeafKind::convex:
            return look_at_convex(payload.all() ? program_->constraints_of(leaf) : payload.items, parent, box,
                                  node);
        case LeafKind::torus:
            return look_at_torus(program_->tori[leaf.first], parent, node.needed, box);
        default:
            return look_at_polyhedron(program_->polyhedra[leaf.first], payload, parent, box);
    }
}

CornersSeen Brick::look_at_convex(std::span<const std::uint32_t> constraints, const octree::Cell& parent,
                                  const BrickSides& box, Node& node) {
    Layers* const matters = matters_.room(constraints.size());
    BrickSurface* const surfaces = surfaces_.room(constraints.size());
    CornersSeen seen{{box.white, Layers::cells()}, {box.corners.out, Layers::corners()}};
    bool plain = true;
    for (std::size_t i = 0; i < constraints.size(); ++i) {
        const std::uint32_t id = constraints[i];
        const BrickSides sides =
            ConstraintId::is_cone(id)
                ? brick_sides(program_->quadrics[ConstraintId::index(id)], parent, surfaces[i])
                : brick_sides(program_->planes[id], parent, surfaces[i]);
        seen.cells = intersect(seen.cells, {sides.white, sides.black});
        seen.corners = intersect(seen.corners, sides.corners);
        matters[i] = without(Layers::cells(), sides.black);
        plain &= surfaces[i].plain;
        // White wherever it is asked about: other constraints have nothing to add.
        if (!without(node.needed, seen.cells.out).any())
            return {{seen.cells.out, {}}, {seen.corners.out, {}}};
    }
    matters_.end_at(matters + constraints.size());
    surfaces_.end_at(surfaces + constraints.size());
    // The other nappe of a cone is no convex body.
    node.surface_count = plain ? static_cast<std::uint32_t>(constraints.size()) : 0;
    seen.cells.in = without(seen.cells.in, seen.cells.out);
    return seen;
}

CornersSeen Brick::look_at_torus(const LatticeTorus& torus, const octree::Cell& parent, const Layers& needed,
                                 const BrickSides& box) {
    CornersSeen seen{{box.white, {}}, brick_sides(torus, parent).corners};
    for (unsigned outer = 0; outer < 8; ++outer)
        for (unsigned inner = 0; inner < 8; ++inner) {
            const BrickCell cell = BrickCell::of(outer, inner);
            if (!cell.in(needed) || cell.in(box.white)) continue;
            const octree::Color color =
                torus.color(parent.child(static_cast<int>(outer)).child(static_cast<int>(inner)));
            if (color == octree::Color::white) cell.add_to(seen.cells.out);
            if (color == octree::Color::black) cell.add_to(seen.cells.in);
        }
    return seen;
}

CornersSeen Brick::look_at_polyhedron(const LatticePolyhedron& polyhedron, Payload payload,
                                      const octree::Cell& parent, const BrickSides& box) {
    const auto [triangles, winding] = triangles_in(polyhedron, payload, parent, all_);
    Layers* const matters = matters_.room(triangles.size());
    std::fill(matters, matters + triangles.size(), Layers{});
    matters_.end_at(matters + triangles.size());
    std::int32_t* windings = windings_.room(64);
    windings_.end_at(windings + 64);
    const std::array<std::int32_t, 8> outer_windings =
        polyhedron.windings(parent, winding, triangles.data(), triangles.size());
    std::vector<std::uint8_t> outer_met;
    for (const std::uint32_t triangle : triangles)
        outer_met.push_back(polyhedron.octants_met(triangle, parent));

    CornersSeen seen{{Layers::cells(), {}}, {box.corners.out, {}}};
    for (unsigned outer = 0; outer < 8; ++outer) {
        const octree::Cell octant = parent.child(static_cast<int>(outer));
        met_.clear();
        for (std::size_t i = 0; i < triangles.size(); ++i) {
            if (!(outer_met[i] >> outer & 1)) continue;
            met_.push_back(triangles[i]);
            const std::uint8_t inner_met = polyhedron.octants_met(triangles[i], octant);
            for (unsigned inner = 0; inner < 8; ++inner)
                if (inner_met >> inner & 1) {
                    BrickCell::of(outer, inner).add_to(matters[i]);
                    BrickCell::of(outer, inner).take_from(seen.cells.out);
                }
        }
        const std::array<std::int32_t, 8> inner_windings =
            polyhedron.windings(octant, outer_windings[outer], met_.data(), met_.size());
        for (unsigned inner = 0; inner < 8; ++inner) {
            *windings++ = inner_windings[inner];
            const BrickCell cell = BrickCell::of(outer, inner);
            if (inner_windings[inner] <= 0 || !cell.in(seen.cells.out)) continue;
            cell.take_from(seen.cells.out);
            cell.add_to(seen.cells.in);
        }
    }
    return seen;
}

void Brick::prune(BrickCell cell, Scratch<std::uint32_t>& buffer) {
    const std::span<const std::uint32_t> words = words_;
    buffer.clear();
    // As in prune.cpp.
    std::array<std::uint32_t*, 8> to{buffer.room(2 * words.size() + matters_.size() + windings_.size() + 1)};
    const auto colors_at = [&](std::uint32_t at) {
        const LayerPair& cells = nodes_[at].cells;
        return OctantColors{cell.in(cells.out), cell.in(cells.in)};
    };
    const std::size_t place = 8 * (cell.x / 2 + 2 * (cell.y / 2) + 4 * (cell.z / 2)) +
                              (cell.x % 2 + 2 * (cell.y % 2) + 4 * (cell.z % 2));
    const auto write = [&](std::uint32_t at, unsigned, std::array<std::uint32_t*, 8>& ends) {
        const Node& node = nodes_[at];
        const Layers* const matters = matters_.data() + node.matters;
        const bool polyhedron = program_->leaves[word::leaf(words[at])].kind == LeafKind::polyhedron;
        ends[0] = write_leaf(*program_, words, at, polyhedron ? windings_[node.windings + place] : 0, ends[0],
                             [&](std::size_t i) { return cell.in(matters[i]); });
    };
    prune_words(words, written_, 1, to, colors_at, write);
    buffer.end_at(to[0]);
}

}  // namespace octavo::csg
