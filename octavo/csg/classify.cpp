// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>

#include <octavo/csg/classify.hpp>
#include <octavo/csg/convex_overlap.hpp>

namespace octavo::csg {
namespace {

constexpr std::array<std::array<std::uint8_t, 2>, 3> halves{{{0x55, 0xAA}, {0x33, 0xCC}, {0x0F, 0xF0}}};

/// Octants that keep off the leaf's box, and octants that lie in it.
OctantColors classify_box(const Leaf& leaf, const octree::Cell& parent) {
    const std::int32_t half = parent.side() / 2;
    unsigned white = 0, black = 0xFF;
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        const std::int32_t begin = parent.low[axis], middle = begin + half, end = middle + half;
        const std::int32_t low = leaf.low[a], high = leaf.high[a];
        white |= (middle <= low || begin >= high ? halves[a][0] : 0U) |
                 (end <= low || middle >= high ? halves[a][1] : 0U);
        black &= (low <= begin && middle <= high ? halves[a][0] : 0U) |
                 (low <= middle && end <= high ? halves[a][1] : 0U);
    }
    return {static_cast<std::uint8_t>(white), static_cast<std::uint8_t>(black)};
}

/// The octant that holds the point, if one does.
unsigned octant_with(const std::array<std::int32_t, 3>& p, const octree::Cell& parent) {
    const exact::Point point{p[0], p[1], p[2]}, middle = parent.centre();
    if (!parent.contains(point)) return 0;
    return 1U << ((point.x >= middle.x) + 2 * (point.y >= middle.y) + 4 * (point.z >= middle.z));
}

/// Whether a corner of the octant is strictly inside all constraints that the octant leaves undecided; then their
/// common interior reaches into it. Cheap beside `overlap`, and enough for most octants at an edge of a body.
bool corner_inside(const Program& program, std::span<const std::uint32_t> constraints,
                   std::span<const std::uint8_t> matters, const octree::Cell& octant, int index) {
    const std::int32_t side = octant.side();
    unsigned inside = 0xFF;
    for (std::size_t i = 0; i < constraints.size() && inside != 0; ++i) {
        if (!(matters[i] >> index & 1)) continue;
        unsigned here = 0;
        if (ConstraintId::is_cone(constraints[i])) {
            const SecondOrderCone& cone = program.cones[ConstraintId::index(constraints[i])];
            std::array<double, 3> d;
            double distance = 0;
            for (int axis = 0; axis < 3; ++axis) {
                const auto a = static_cast<std::size_t>(axis);
                d[a] = static_cast<double>(octant.low[axis]) - cone.origin[a];
                distance = std::max(distance, std::abs(d[a]));
            }
            const double error = cone.error(distance + side);
            for (unsigned corner = 0; corner < 8; ++corner) {
                const double excess =
                    cone.excess(d[0] + (corner & 1 ? side : 0), d[1] + (corner & 2 ? side : 0),
                                d[2] + (corner & 4 ? side : 0));
                here |= static_cast<unsigned>(excess < -error) << corner;
            }
        } else {
            const LatticePlane& plane = program.planes[constraints[i]];
            const std::int64_t low = plane.at(octant.low.x, octant.low.y, octant.low.z);
            for (unsigned corner = 0; corner < 8; ++corner) {
                const std::int64_t value = low + (corner & 1 ? plane.normal[0] * side : 0) +
                                           (corner & 2 ? plane.normal[1] * side : 0) +
                                           (corner & 4 ? plane.normal[2] * side : 0);
                here |= static_cast<unsigned>(value > 0) << corner;
            }
        }
        inside &= here;
    }
    return inside != 0;
}

/// Collects the constraints that an octant leaves undecided and asks whether their common interior meets it.
Overlap overlap_of(const Program& program, std::span<const std::uint32_t> constraints,
                   std::span<const std::uint8_t> matters, const octree::Cell& octant, int index) {
    std::array<LatticePlane, most_constraints> planes;
    std::array<const SecondOrderCone*, most_constraints> cones;
    std::size_t plane_count = 0, cone_count = 0;
    for (std::size_t i = 0; i < constraints.size(); ++i) {
        if (!(matters[i] >> index & 1)) continue;
        if (plane_count + cone_count == most_constraints) break;
        const std::uint32_t id = constraints[i];
        if (ConstraintId::is_cone(id))
            cones[cone_count++] = &program.cones[ConstraintId::index(id)];
        else
            planes[plane_count++] = program.planes[id];
    }
    return overlap(octant, {planes.data(), plane_count}, {cones.data(), cone_count});
}

OctantColors classify_convex(const Program& program, const Leaf& leaf,
                             std::span<const std::uint32_t> constraints, const octree::Cell& parent,
                             std::uint8_t needed, unsigned white, Remains& remains) {
    unsigned black = 0xFF, middle = 0xFF, meets = 0xFF;
    unsigned once = 0, twice = 0;  // octants that one, and that more constraints leave undecided
    const std::size_t first = remains.matters.size();
    for (const std::uint32_t id : constraints) {
        const ConstraintOnOctants on = ConstraintId::is_cone(id)
                                           ? classify(program.cones[ConstraintId::index(id)], parent)
                                           : classify(program.planes[id], parent);
        white |= on.colors.white;
        if ((white & needed) == needed) {
            remains.matters.resize(first);
            return {static_cast<std::uint8_t>(white), 0};
        }
        const unsigned open = ~static_cast<unsigned>(on.colors.black) & 0xFF;
        black &= on.colors.black;
        middle &= on.middle_inside | on.colors.black;
        meets &= on.meets | on.colors.black;
        twice |= once & open;
        once |= open;
        remains.matters.push_back(static_cast<std::uint8_t>(open));
    }
    black &= ~white;
    // One constraint that surely meets the octant leaves it gray; so does a common point in its middle. The rest
    // may be near an edge of the body.
    unsigned unclear =
        needed & ~(white | black) & ~((meets & ~twice) | middle | octant_with(leaf.witness, parent));
    for (; unclear != 0; unclear &= unclear - 1) {
        const int octant = std::countr_zero(unclear);
        const std::span<const std::uint8_t> matters(remains.matters.data() + first, constraints.size());
        const octree::Cell cell = parent.child(octant);
        if (corner_inside(program, constraints, matters, cell, octant)) continue;
        if (overlap_of(program, constraints, matters, cell, octant) == Overlap::apart) white |= 1U << octant;
    }
    return {static_cast<std::uint8_t>(white), static_cast<std::uint8_t>(black)};
}

OctantColors classify_torus(const LatticeTorus& torus, const octree::Cell& parent, std::uint8_t needed,
                            std::uint8_t white) {
    OctantColors colors{white, 0};
    for (int octant = 0; octant < 8; ++octant)
        if (needed >> octant & ~white >> octant & 1) colors.set(octant, torus.color(parent.child(octant)));
    return colors;
}

OctantColors classify_polyhedron(const LatticePolyhedron& polyhedron, Payload payload,
                                 const octree::Cell& parent, Remains& remains) {
    std::int32_t winding = 0;
    std::vector<std::uint32_t> all;  // only at the first cell of a descent
    std::span<const std::uint32_t> triangles = payload.items;
    if (payload.all) {
        all.resize(polyhedron.triangles.size());
        for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
        triangles = all;
        winding = polyhedron.winding_of_universe();
        if (!(parent == octree::Cell::root())) {
            // A walk from the universe's reference point to this cell's, level by level.
            for (octree::Cell cell = octree::Cell::root(); cell.level < parent.level;) {
                const int octant = parent.key().ancestor(cell.level + 1).child_index();
                winding = polyhedron.windings(cell, winding, all.data(),
                                              all.size())[static_cast<std::size_t>(octant)];
                cell = cell.child(octant);
            }
        }
    } else {
        winding = winding_of_word(triangles[0]);
        triangles = triangles.subspan(1);
    }
    unsigned met = 0;
    for (const std::uint32_t triangle : triangles) {
        const std::uint8_t octants = polyhedron.octants_met(triangle, parent);
        met |= octants;
        remains.matters.push_back(octants);
    }
    const std::array<std::int32_t, 8> windings =
        polyhedron.windings(parent, winding, triangles.data(), triangles.size());
    remains.windings.insert(remains.windings.end(), windings.begin(), windings.end());
    unsigned inside = 0;
    for (std::size_t i = 0; i < 8; ++i) inside |= static_cast<unsigned>(windings[i] > 0) << i;
    return {static_cast<std::uint8_t>(~met & ~inside), static_cast<std::uint8_t>(~met & inside)};
}

}  // namespace

OctantColors classify(const Program& program, const Leaf& leaf, Payload payload, const octree::Cell& parent,
                      std::uint8_t needed, Remains& remains) {
    const OctantColors box = classify_box(leaf, parent);
    remains.tests +=
        static_cast<std::uint64_t>(std::popcount(static_cast<std::uint8_t>(needed & ~box.white)));
    if (leaf.kind == LeafKind::box) return box;
    if ((box.white & needed) == needed) return {box.white, 0};
    switch (leaf.kind) {
        case LeafKind::convex:
            return classify_convex(program, leaf, payload.all ? program.constraints_of(leaf) : payload.items,
                                   parent, needed, box.white, remains);
        case LeafKind::torus:
            return classify_torus(program.tori[leaf.first], parent, needed, box.white);
        default:
            return classify_polyhedron(program.polyhedra[leaf.first], payload, parent, remains);
    }
}

}  // namespace octavo::csg
