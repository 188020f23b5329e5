// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <bit>

#include <octavo/csg/box_sides.hpp>
#include <octavo/csg/classify.hpp>
#include <octavo/csg/point_sides.hpp>

namespace octavo::csg {
namespace {

/// One constraint on the octants and their corners: those strictly inside, those strictly outside, and octants that it
/// misses or holds.
struct ConstraintSides {
    PointColors points;
    std::uint8_t white, black;
};
ConstraintSides sides_of_constraint(const Program& program, std::uint32_t id, const octree::Cell& parent) {
    if (!ConstraintId::is_cone(id)) {
        const PointColors points = sides_of(program.planes[id], parent);
        return {points, static_cast<std::uint8_t>(~octants_with_corner(points.inside)),
                static_cast<std::uint8_t>(~octants_with_corner(points.outside))};
    }
    const QuadricSides sides = sides_of(program.quadrics[ConstraintId::index(id)], parent);
    return {sides.points, sides.missed,
            static_cast<std::uint8_t>(~octants_with_corner(~sides.points.inside))};
}

/// Whether the leaf's box is at most half as wide as an octant, so that it cannot fill one and meets few.
bool is_small(const Leaf& leaf, const octree::Cell& parent) {
    std::int32_t widest = 0;
    for (std::size_t a = 0; a < 3; ++a) widest = std::max(widest, leaf.high[a] - leaf.low[a]);
    return widest <= parent.side() / 4;
}

Seen classify_convex(const Program& program, std::span<const std::uint32_t> constraints,
                     const octree::Cell& parent, std::uint8_t needed, const BoxSides& box, Remains& remains) {
    std::uint8_t* const matters = remains.matters.room(constraints.size());
    std::uint64_t inside = PointColors::all, outside = box.outside();
    unsigned white = box.white(), black = 0xFF;
    for (std::size_t i = 0; i < constraints.size(); ++i) {
        const ConstraintSides sides = sides_of_constraint(program, constraints[i], parent);
        inside &= sides.points.inside;
        outside |= sides.points.outside;
        white |= sides.white;
        black &= sides.black;
        matters[i] = static_cast<std::uint8_t>(~sides.black);
        if ((white & needed) == needed) return {{static_cast<std::uint8_t>(white), 0}, {outside, 0}};
    }
    remains.matters.end_at(matters + constraints.size());
    return {{static_cast<std::uint8_t>(white), static_cast<std::uint8_t>(black & ~white)}, {outside, inside}};
}

Seen classify_torus(const LatticeTorus& torus, const octree::Cell& parent, std::uint8_t needed,
                    std::uint8_t white) {
    Seen seen{{white, 0}, sides_of(torus, parent)};
    for (int octant = 0; octant < 8; ++octant)
        if (needed >> octant & ~white >> octant & 1)
            seen.octants.set(octant, torus.color(parent.child(octant)));
    return seen;
}

Seen classify_polyhedron(const LatticePolyhedron& polyhedron, Payload payload, const octree::Cell& parent,
                         std::uint64_t outside, Remains& remains) {
    std::vector<std::uint32_t> all;  // only at the first cell of a descent
    const auto [triangles, winding] = triangles_in(polyhedron, payload, parent, all);
    unsigned met = 0;
    std::uint8_t* matters = remains.matters.room(triangles.size());
    for (const std::uint32_t triangle : triangles) {
        *matters = polyhedron.octants_met(triangle, parent);
        met |= *matters++;
    }
    remains.matters.end_at(matters);
    const std::array<std::int32_t, 8> windings =
        polyhedron.windings(parent, winding, triangles.data(), triangles.size());
    remains.windings.end_at(std::copy(windings.begin(), windings.end(), remains.windings.room(8)));
    unsigned inside = 0;
    for (std::size_t i = 0; i < 8; ++i) inside |= static_cast<unsigned>(windings[i] > 0) << i;
    return {{static_cast<std::uint8_t>(~met & ~inside), static_cast<std::uint8_t>(~met & inside)},
            {outside, 0}};
}

}  // namespace

Seen classify(const Program& program, const Leaf& leaf, Payload payload, const octree::Cell& parent,
              std::uint8_t needed, Remains& remains) {
    remains.whole = false;
    const BoxSides box(leaf, parent);
    const std::uint8_t white = box.white();
    remains.tests += static_cast<std::uint64_t>(std::popcount(static_cast<unsigned>(needed & ~white)));
    if (leaf.kind == LeafKind::box) return {{white, box.black()}, {box.outside(), box.inside()}};
    if ((white & needed) == needed) return {{white, 0}, {box.outside(), 0}};
    if (leaf.kind == LeafKind::convex && is_small(leaf, parent)) {
        remains.whole = true;
        return {{white, 0}, {box.outside(), 0}};
    }
    switch (leaf.kind) {
        case LeafKind::convex:
            return classify_convex(program, payload.all ? program.constraints_of(leaf) : payload.items,
                                   parent, needed, box, remains);
        case LeafKind::torus:
            return classify_torus(program.tori[leaf.first], parent, needed, white);
        default:
            return classify_polyhedron(program.polyhedra[leaf.first], payload, parent, box.outside(),
                                       remains);
    }
}

TrianglesInCell triangles_in(const LatticePolyhedron& polyhedron, Payload payload, const octree::Cell& cell,
                             std::vector<std::uint32_t>& all) {
    if (!payload.all) return {payload.items.subspan(1), winding_of_word(payload.items[0])};
    all.resize(polyhedron.triangles.size());
    for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
    std::int32_t winding = polyhedron.winding_of_universe();
    // A walk from the universe's reference point to this cell's, level by level.
    for (octree::Cell at = octree::Cell::root(); at.level < cell.level;) {
        const int octant = cell.key().ancestor(at.level + 1).child_index();
        winding = polyhedron.windings(at, winding, all.data(), all.size())[static_cast<std::size_t>(octant)];
        at = at.child(octant);
    }
    return {all, winding};
}

}  // namespace octavo::csg
