// SPDX-License-Identifier: Apache-2.0
#pragma GCC diagnostic ignored "-Wpsabi"  // vectors do not leave this file

#include <array>
#include <cstring>

#include <octavo/csg/float_lanes.hpp>
#include <octavo/csg/pair_in_cell.hpp>
#include <octavo/csg/point_sides.hpp>
#include <octavo/csg/surface_steps.hpp>

namespace octavo::csg {
namespace {

// Lane n is corner n of the cell, as octants are numbered.
constexpr Floats corner_x{0, 1, 0, 1, 0, 1, 0, 1}, corner_y{0, 0, 1, 1, 0, 0, 1, 1},
    corner_z{0, 0, 0, 0, 1, 1, 1, 1};

/// Two surfaces such that the solid, or its complement, is where either is negative.
struct Pair {
    std::array<std::uint32_t, 2> constraints;
    std::array<bool, 2> flipped;  // negative outside the body
    bool complemented;            // it is the complement

    bool of_bodies() const { return !flipped[0] && !flipped[1]; }
};

std::optional<Pair> pair_of(const Program& program, std::span<const std::uint32_t> words) {
    std::size_t at = 0;
    while (!word::is_leaf(words[at]) && word::operation(words[at]) == word::skip) ++at;
    const auto is_convex = [&](std::size_t leaf) {
        return leaf + 2 < words.size() && word::is_leaf(words[leaf]) && (words[leaf] & word::payload_bit) &&
               program.leaves[word::leaf(words[leaf])].kind == LeafKind::convex;
    };
    const auto complemented = [&](std::size_t leaf) { return (words[leaf] & word::complement_bit) != 0; };
    if (word::is_leaf(words[at])) {
        if (!is_convex(at) || words[at + 1] != 2) return {};
        return Pair{{words[at + 2], words[at + 3]}, {true, true}, !complemented(at)};
    }
    const word::Operation operation = word::operation(words[at]);
    if (operation == word::symmetric_difference || words.size() != at + 7) return {};
    const std::size_t first = at + 1, second = at + 4;
    if (!is_convex(first) || words[first + 1] != 1 || !is_convex(second)) return {};
    const bool intersects = operation == word::intersection;
    return Pair{{words[first + 2], words[second + 2]},
                {complemented(first) != intersects, complemented(second) != intersects},
                intersects};
}

/// The points of the cell on either side of a surface, and the octants that its negative side holds; none are named
/// where that is the outside of a body.
struct Sides {
    PointColors points;
    std::uint8_t black;
};
Sides sides_in(const Program& program, std::uint32_t constraint, bool flipped, const octree::Cell& cell) {
    if (!ConstraintId::is_cone(constraint)) {
        const PointColors points = sides_of(program.planes[constraint], cell);
        if (flipped) return {complement(points), 0};
        return {points, static_cast<std::uint8_t>(~octants_with_corner(points.outside))};
    }
    const PointColors points = sides_of(program.quadrics[ConstraintId::index(constraint)], cell).points;
    if (flipped) return {complement(points), 0};
    return {points, static_cast<std::uint8_t>(~octants_with_corner(~points.inside))};
}

/// Values of a surface at the corners, its square terms, and what bounds the rounding of a value on an edge.
struct OnCorners {
    Floats at;
    std::array<float, 3> square{};
    float error;

    /// On the edge along an axis from each corner to `far`, at `t` of its length.
    Floats on_edge(Floats far, Floats t, std::size_t axis) const {
        return at + t * (far - at) - t * (1.0F - t) * square[axis];
    }
};

/// From a corner to a point of an edge eight more roundings are added to those of `single_error`, of sums of at most
/// three times the surface's size: twice the error has room for both. None where the other nappe of a cone is near.
std::optional<OnCorners> on_corners(const Program& program, std::uint32_t constraint, bool flipped,
                                    const octree::Cell& cell) {
    OnCorners result;
    const float sign = flipped ? -1.0F : 1.0F;
    if (!ConstraintId::is_cone(constraint)) {
        const PlaneSteps p(program.planes[constraint], cell, cell.side());
        const float scale = sign / (std::fabs(p.sx) + std::fabs(p.sy) + std::fabs(p.sz));
        result.at = scale * (p.at_low + corner_x * p.sx + corner_y * p.sy + corner_z * p.sz);
        result.error = 2 * std::fabs(scale) * p.error(1);
        return result;
    }
    const Quadric& quadric = program.quadrics[ConstraintId::index(constraint)];
    const Offset offset(quadric.origin, cell);
    const double side = cell.side();
    if (quadric.axis_reach != 0 && !NappeSteps(quadric, offset, side).all_positive(1)) return {};
    const QuadricSteps q(quadric, QuadricAtCorner(quadric, offset.low), side, 1);
    // About as steep as a plane: near the surface its values are the ends of a linear function.
    const float scale =
        sign / (std::fabs(q.x + q.xx) + std::fabs(q.y + q.yy) + std::fabs(q.z + q.zz) + q.size * 0x1p-20F);
    result.at = scale * (q.low + corner_x * (q.x + q.xx + corner_y * q.xy + corner_z * q.xz) +
                         corner_y * (q.y + q.yy + corner_z * q.yz) + corner_z * (q.z + q.zz));
    result.square = {scale * q.xx, scale * q.yy, scale * q.zz};
    result.error =
        2 * std::fabs(scale) *
        (single_error * q.size + (static_cast<float>(quadric.error(offset.farthest)) * 1.0001F + underflow));
    return result;
}

bool any(Flags flags) {
    std::array<std::uint64_t, 4> words;
    static_assert(sizeof words == sizeof flags);
    std::memcpy(words.data(), &flags, sizeof words);
    return (words[0] | words[1] | words[2] | words[3]) != 0;
}

/// Each corner's neighbour along an axis.
template <std::size_t axis>
Floats neighbours(Floats v) {
    if constexpr (axis == 0) return __builtin_shufflevector(v, v, 1, 0, 3, 2, 5, 4, 7, 6);
    if constexpr (axis == 1) return __builtin_shufflevector(v, v, 2, 3, 0, 1, 6, 7, 4, 5);
    return __builtin_shufflevector(v, v, 4, 5, 6, 7, 0, 1, 2, 3);
}

/// Where both are positive, beyond their errors, as they cross.
template <std::size_t axis>
Flags both_positive(const OnCorners& a, const OnCorners& b) {
    const Floats far_a = neighbours<axis>(a.at), far_b = neighbours<axis>(b.at), lead = a.at - b.at;
    // Not a number becomes zero.
    const Floats t = smaller(larger(lead / (lead - (far_a - far_b)), Floats{}), Floats{} + 1);
    return (a.on_edge(far_a, t, axis) > a.error) & (b.on_edge(far_b, t, axis) > b.error);
}

/// Whether some point of an edge is on the positive side of both. None where that cannot be seen.
std::optional<bool> meet_on_edges(const Program& program, const Pair& pair, const octree::Cell& cell) {
    const std::optional<OnCorners> a = on_corners(program, pair.constraints[0], pair.flipped[0], cell);
    const std::optional<OnCorners> b = on_corners(program, pair.constraints[1], pair.flipped[1], cell);
    if (!a || !b) return {};
    return any(both_positive<0>(*a, *b) | both_positive<1>(*a, *b) | both_positive<2>(*a, *b));
}

/// Whether an arrangement of the two leaves the cell gray because it does not look for points outside a quadric.
bool stays_gray(const Program& program, const Pair& pair) {
    const std::array<std::uint32_t, 2>& ids = pair.constraints;
    const bool first = ConstraintId::is_cone(ids[0]), second = ConstraintId::is_cone(ids[1]);
    if (!pair.of_bodies() || (!first && !second)) return false;
    return first != second || (ids[0] != ids[1] && !same_cone(program.cones[ConstraintId::index(ids[0])],
                                                              program.cones[ConstraintId::index(ids[1])]));
}

}  // namespace

std::optional<octree::Color> color_of_pair(const Program& program, std::span<const std::uint32_t> words,
                                           const octree::Cell& cell) {
    const std::optional<Pair> pair = pair_of(program, words);
    if (!pair) return {};
    const Sides a = sides_in(program, pair->constraints[0], pair->flipped[0], cell),
                b = sides_in(program, pair->constraints[1], pair->flipped[1], cell);
    const PointColors points = unite(a.points, b.points);
    if (points.inside != 0 && points.outside != 0) return octree::Color::gray;
    if ((a.black | b.black) == 0xFF) return pair->complemented ? octree::Color::white : octree::Color::black;
    // Further on it is known that there are points inside, and looked for one outside.
    if (points.inside == 0) return {};
    const std::optional<bool> outside = meet_on_edges(program, *pair, cell);
    if (!outside) return {};
    if (*outside || (a.points.inside != 0 && b.points.inside != 0 && stays_gray(program, *pair)))
        return octree::Color::gray;
    return {};
}

}  // namespace octavo::csg
