// SPDX-License-Identifier: Apache-2.0
#include <bit>

#include <octavo/csg/brick.hpp>
#include <octavo/csg/classify.hpp>

namespace octavo::csg {

const BrickSeen& Brick::evaluate(const Program& program, std::span<const std::uint32_t> words,
                                 const octree::Cell& parent) {
    program_ = &program;
    matters_.clear();
    windings_.clear();
    nodes_.resize(words.size());
    const auto see = [&](std::uint32_t at, const Layers& needed) {
        nodes_[at].matters = static_cast<std::uint32_t>(matters_.size());
        nodes_[at].windings = static_cast<std::uint32_t>(windings_.size());
        BrickSeen seen = look(program.leaves[word::leaf(words[at])], payload_at(words, at), parent, needed);
        if (words[at] & word::complement_bit) seen = complement(seen);
        nodes_[at].cells = seen.cells;
        return seen;
    };
    const auto note = [&](std::uint32_t at, const BrickSeen& seen) { nodes_[at].cells = seen.cells; };
    result_ = fold_words<BrickSeen>(words, Layers::cells(), open_, see, note);
    return result_;
}

BrickSeen Brick::look(const Leaf& leaf, Payload payload, const octree::Cell& parent, const Layers& needed) {
    const BrickSides box = brick_sides_of_box(leaf, parent);
    const Layers met = without(needed, box.white);
    for (const std::uint32_t cells : met.layer) tests_ += static_cast<std::uint64_t>(std::popcount(cells));
    if (leaf.kind == LeafKind::box) return {{box.white, box.black}, box.corners, {box.white, box.black}};
    if (!met.any()) return {{box.white, {}}, {box.corners.out, {}}, {box.white, {}}};
    switch (leaf.kind) {
        case LeafKind::convex:
            return look_at_convex(payload.all ? program_->constraints_of(leaf) : payload.items, parent,
                                  needed, box);
        case LeafKind::torus:
            return look_at_torus(program_->tori[leaf.first], parent, needed, box);
        default:
            return look_at_polyhedron(program_->polyhedra[leaf.first], payload, parent, box);
    }
}

BrickSeen Brick::look_at_convex(std::span<const std::uint32_t> constraints, const octree::Cell& parent,
                                const Layers& needed, const BrickSides& box) {
    Layers* matters = matters_.room(constraints.size());
    BrickSeen seen{{box.white, Layers::cells()}, {box.corners.out, Layers::corners()}, {}};
    surfaces_.clear();
    bool plain = true;
    for (const std::uint32_t id : constraints) {
        BrickSurface surface;
        const BrickSides sides =
            ConstraintId::is_cone(id)
                ? brick_sides(program_->quadrics[ConstraintId::index(id)], parent, surface)
                : brick_sides(program_->planes[id], parent, surface);
        seen.cells = intersect(seen.cells, {sides.white, sides.black});
        seen.corners = intersect(seen.corners, sides.corners);
        *matters = without(Layers::cells(), sides.black);
        if (matters->any()) surfaces_.push_back(surface);
        plain &= surface.plain;
        ++matters;
        // White wherever it is asked about: other constraints have nothing to add.
        if (!without(needed, seen.cells.out).any())
            return {{seen.cells.out, {}}, {seen.corners.out, {}}, {seen.cells.out, {}}};
    }
    matters_.end_at(matters);
    seen.cells.in = without(seen.cells.in, seen.cells.out);
    seen.reached = {cells_with_corner(seen.corners.out), cells_with_corner(seen.corners.in)};
    if (plain && !surfaces_.empty()) look_past_corners(needed, seen);
    return seen;
}

/// Where no corner lies in the body, asks whether it enters the cell all the same.
void Brick::look_past_corners(const Layers& needed, BrickSeen& seen) const {
    const Layers asked = without(without(needed, seen.cells.out), seen.reached.in);
    if (!asked.any()) return;
    const BodyInCells body = body_in_cells(surfaces_, asked);
    seen.cells.out = seen.cells.out | body.missed;
    seen.cells.in = without(seen.cells.in, body.missed);
    seen.reached = {seen.reached.out | body.missed, seen.reached.in | body.entered};
}

BrickSeen Brick::look_at_torus(const LatticeTorus& torus, const octree::Cell& parent, const Layers& needed,
                               const BrickSides& box) {
    BrickSeen seen{{box.white, {}}, brick_sides(torus, parent).corners, {}};
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

BrickSeen Brick::look_at_polyhedron(const LatticePolyhedron& polyhedron, Payload payload,
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

    BrickSeen seen{{Layers::cells(), {}}, {box.corners.out, {}}, {}};
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

void Brick::prune(std::span<const std::uint32_t> words, BrickCell cell, Scratch<std::uint32_t>& buffer) {
    buffer.clear();
    // As in prune.cpp.
    std::uint32_t* const room = buffer.room(2 * words.size() + matters_.size() + windings_.size() + 1);
    const auto color_of = [&](std::uint32_t at) {
        const LayerPair& cells = nodes_[at].cells;
        if (cell.in(cells.out)) return octree::Color::white;
        return cell.in(cells.in) ? octree::Color::black : octree::Color::gray;
    };
    const std::size_t place = 8 * (cell.x / 2 + 2 * (cell.y / 2) + 4 * (cell.z / 2)) +
                              (cell.x % 2 + 2 * (cell.y % 2) + 4 * (cell.z % 2));
    const auto write = [&](std::uint32_t at, std::uint32_t* to) {
        const Node& node = nodes_[at];
        const Layers* const matters = matters_.data() + node.matters;
        const bool polyhedron = program_->leaves[word::leaf(words[at])].kind == LeafKind::polyhedron;
        return write_leaf(*program_, words, at, polyhedron ? windings_[node.windings + place] : 0, to,
                          [&](std::size_t i) { return cell.in(matters[i]); });
    };
    buffer.end_at(prune_words(words, written_, room, color_of, write));
}

}  // namespace octavo::csg
