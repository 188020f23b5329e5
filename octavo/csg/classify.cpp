// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <bit>

#include <octavo/csg/box_sides.hpp>
#include <octavo/csg/classify.hpp>
#include <octavo/csg/point_sides.hpp>

namespace octavo::csg {
namespace {

/// What is seen of a leaf's octants, with its points where they are asked for.
template <class SeenOfLeaf, class Points>
SeenOfLeaf seen_of(OctantColors octants, const Points& points) {
    if constexpr (SeenOfLeaf::has_points)
        return {octants, points()};
    else
        return {octants};
}

/// One constraint on the octants and their corners: those strictly inside, those strictly outside, and octants that it
/// misses or holds.
struct ConstraintSides {
    PointColors points;
    std::uint8_t white, black;
};
template <bool with_points>
ConstraintSides sides_of_constraint(const Program& program, std::uint32_t id, const octree::Cell& parent) {
    if constexpr (with_points) {
        if (ConstraintId::is_cone(id)) {
            const QuadricSides sides = sides_of(program.quadrics[ConstraintId::index(id)], parent);
            return {sides.points, sides.missed,
                    static_cast<std::uint8_t>(~octants_with_corner(~sides.points.inside))};
        }
        const PointColors points = sides_of(program.planes[id], parent);
        return {points, static_cast<std::uint8_t>(~octants_with_corner(points.inside)),
                static_cast<std::uint8_t>(~octants_with_corner(points.outside))};
    } else {
        const OctantColors octants = ConstraintId::is_cone(id)
                                         ? octants_of(program.quadrics[ConstraintId::index(id)], parent)
                                         : octants_of(program.planes[id], parent);
        return {{}, octants.white, octants.black};
    }
}

/// Whether the leaf's box is at most half as wide as an octant, so that it cannot fill one and meets few.
bool is_small(const Leaf& leaf, const octree::Cell& parent) {
    std::int32_t widest = 0;
    for (std::size_t a = 0; a < 3; ++a) widest = std::max(widest, leaf.high[a] - leaf.low[a]);
    return widest <= parent.side() / 4;
}

template <class SeenOfLeaf>
SeenOfLeaf classify_convex(const Program& program, std::span<const std::uint32_t> constraints,
                           const octree::Cell& parent, std::uint8_t needed, const BoxSides& box,
                           Remains& remains) {
    std::uint8_t* const matters = remains.matters.room(constraints.size());
    PointColors points{0, PointColors::all};
    unsigned white = box.white(), black = 0xFF;
    const auto outside = [&] { return PointColors{points.outside | box.outside(), 0}; };
    for (std::size_t i = 0; i < constraints.size(); ++i) {
        const ConstraintSides sides =
            sides_of_constraint<SeenOfLeaf::has_points>(program, constraints[i], parent);
        points = intersect(points, sides.points);
        white |= sides.white;
        black &= sides.black;
        matters[i] = static_cast<std::uint8_t>(~sides.black);
        if ((white & needed) == needed)
            return seen_of<SeenOfLeaf>({static_cast<std::uint8_t>(white), 0}, outside);
    }
    remains.matters.end_at(matters + constraints.size());
    return seen_of<SeenOfLeaf>({static_cast<std::uint8_t>(white), static_cast<std::uint8_t>(black & ~white)},
                               [&] {
                                   return PointColors{outside().outside, points.inside};
                               });
}

OctantColors classify_torus(const LatticeTorus& torus, const octree::Cell& parent, std::uint8_t needed,
                            std::uint8_t white) {
    OctantColors octants{white, 0};
    for (int octant = 0; octant < 8; ++octant)
        if (needed >> octant & ~white >> octant & 1) octants.set(octant, torus.color(parent.child(octant)));
    return octants;
}

OctantColors classify_polyhedron(const LatticePolyhedron& polyhedron, Payload payload,
                                 const octree::Cell& parent, Remains& remains) {
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
    return {static_cast<std::uint8_t>(~met & ~inside), static_cast<std::uint8_t>(~met & inside)};
}

}  // namespace

template <class SeenOfLeaf>
SeenOfLeaf classify(const Program& program, const Leaf& leaf, Payload payload, const octree::Cell& parent,
                    std::uint8_t needed, Remains& remains) {
    remains.whole = false;
    const BoxSides box(leaf, parent);
    const std::uint8_t white = box.white();
    remains.tests += static_cast<std::uint64_t>(std::popcount(static_cast<unsigned>(needed & ~white)));
    if (leaf.kind == LeafKind::box)
        return seen_of<SeenOfLeaf>({white, box.black()}, [&] {
            return PointColors{box.outside(), box.inside()};
        });
    const auto outside = [&] { return PointColors{box.outside(), 0}; };
    if ((white & needed) == needed) return seen_of<SeenOfLeaf>({white, 0}, outside);
    if (leaf.kind == LeafKind::convex && is_small(leaf, parent)) {
        remains.whole = true;
        return seen_of<SeenOfLeaf>({white, 0}, outside);
    }
    switch (leaf.kind) {
        case LeafKind::convex:
            return classify_convex<SeenOfLeaf>(program,
                                               payload.all() ? program.constraints_of(leaf) : payload.items,
                                               parent, needed, box, remains);
        case LeafKind::torus: {
            const LatticeTorus& torus = program.tori[leaf.first];
            return seen_of<SeenOfLeaf>(classify_torus(torus, parent, needed, white),
                                       [&] { return sides_of(torus, parent); });
        }
        default:
            return seen_of<SeenOfLeaf>(
                classify_polyhedron(program.polyhedra[leaf.first], payload, parent, remains), outside);
    }
}

template Seen classify<Seen>(const Program&, const Leaf&, Payload, const octree::Cell&, std::uint8_t,
                             Remains&);
template ColorsSeen classify<ColorsSeen>(const Program&, const Leaf&, Payload, const octree::Cell&,
                                         std::uint8_t, Remains&);

TrianglesInCell triangles_in(const LatticePolyhedron& polyhedron, Payload payload, const octree::Cell& cell,
                             std::vector<std::uint32_t>& all) {
    if (!payload.all()) return {payload.items.subspan(1), winding_of_word(payload.items[0])};
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
