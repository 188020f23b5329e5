// SPDX-License-Identifier: Apache-2.0

#include <octavo/csg/float_lanes.hpp>
#include <octavo/csg/point_sides.hpp>
#include <octavo/csg/surface_steps.hpp>

namespace octavo::csg {
namespace {

// Three registers hold eight of the nine corners of a layer each, the fourth the ninth corners, the fifth the
// middles of the octants. Steps are halves of the cell.
constexpr Floats layer_x{0, 1, 2, 0, 1, 2, 0, 1}, layer_y{0, 0, 0, 1, 1, 1, 2, 2};
constexpr Floats ninth_z{0, 1, 2, 0, 0, 0, 0, 0};
constexpr Floats middle_x{0.5F, 1.5F, 0.5F, 1.5F, 0.5F, 1.5F, 0.5F, 1.5F},
    middle_y{0.5F, 0.5F, 1.5F, 1.5F, 0.5F, 0.5F, 1.5F, 1.5F},
    middle_z{0.5F, 0.5F, 0.5F, 0.5F, 1.5F, 1.5F, 1.5F, 1.5F};

/// One bit a lane.
std::uint32_t bits_of(Flags flags) {
#ifdef __AVX__
    return static_cast<std::uint32_t>(_mm256_movemask_ps(std::bit_cast<Floats>(flags)));
#else
    using Half = std::int32_t __attribute__((vector_size(16)));
    flags &= Flags{1, 2, 4, 8, 16, 32, 64, 128};
    Half half =
        __builtin_shufflevector(flags, flags, 0, 1, 2, 3) | __builtin_shufflevector(flags, flags, 4, 5, 6, 7);
    half |= __builtin_shufflevector(half, half, 2, 3, 0, 1);
    return static_cast<std::uint32_t>(half[0] | half[1]);
#endif
}

/// Values of a surface at the 35 points, negative inside.
struct Values {
    std::array<Floats, 3> layer;
    Floats ninth, middle;

    /// Points beyond the error on either side.
    PointColors sides(float error) const {
        return {points([&](Floats v) -> Flags { return v > error; }),
                points([&](Floats v) -> Flags { return v < -error; })};
    }

  private:
    template <class Test>
    std::uint64_t points(const Test& test) const {
        const std::uint32_t ninths = bits_of(test(ninth));
        const std::uint32_t corners = bits_of(test(layer[0])) | bits_of(test(layer[1])) << 9 |
                                      bits_of(test(layer[2])) << 18 | (ninths & 1) << 8 | (ninths & 2) << 16 |
                                      (ninths & 4) << 24;
        return corners | std::uint64_t{bits_of(test(middle))} << PointColors::corners;
    }
};

bool all_known(PointColors points) { return (points.inside | points.outside) == PointColors::all; }

/// The points one by one, in quarters of a cell from its low corner, for the slow ways.
template <class Value>
PointColors sides_one_by_one(const Value& value, decltype(value(0, 0, 0)) error) {
    PointColors points;
    const auto add = [&](int point, auto at) {
        points.inside |= static_cast<std::uint64_t>(at < -error) << point;
        points.outside |= static_cast<std::uint64_t>(at > error) << point;
    };
    for (int p = 0; p < PointColors::corners; ++p) add(p, value(2 * (p % 3), 2 * (p / 3 % 3), 2 * (p / 9)));
    for (int n = 0; n < 8; ++n)
        add(PointColors::corners + n, value(n & 1 ? 3 : 1, n & 2 ? 3 : 1, n & 4 ? 3 : 1));
    return points;
}

Values values_of(const QuadricSteps& q) {
    Values v;
    v.layer[0] = q.low + layer_x * (q.x + layer_x * q.xx + layer_y * q.xy) + layer_y * (q.y + layer_y * q.yy);
    const Floats rise = q.z + layer_x * q.xz + layer_y * q.yz;
    v.layer[1] = v.layer[0] + (rise + q.zz);
    v.layer[2] = v.layer[0] + 2 * (rise + 2 * q.zz);
    const float ninth = q.low + 2 * (q.x + 2 * q.xx + 2 * q.xy) + 2 * (q.y + 2 * q.yy);
    v.ninth = ninth + ninth_z * ((q.z + 2 * q.xz + 2 * q.yz) + ninth_z * q.zz);
    v.middle = q.low + middle_x * (q.x + middle_x * q.xx + middle_y * q.xy + middle_z * q.xz) +
               middle_y * (q.y + middle_y * q.yy + middle_z * q.yz) + middle_z * (q.z + middle_z * q.zz);
    return v;
}

/// Octants in which the tangent at the middle, less `bend`, stays positive. Its rounding is that of a value and three
/// components of a gradient with six roundings each: 33 units of `size`, below four single errors, which `bend` has.
std::uint8_t above_tangent(const QuadricSteps& q, Floats middle, float bend) {
    const Floats gx = q.x + 2 * middle_x * q.xx + middle_y * q.xy + middle_z * q.xz;
    const Floats gy = q.y + middle_x * q.xy + 2 * middle_y * q.yy + middle_z * q.yz;
    const Floats gz = q.z + middle_x * q.xz + middle_y * q.yz + 2 * middle_z * q.zz;
    const Floats least = middle - 0.5F * (absolute(gx) + absolute(gy) + absolute(gz));
    return static_cast<std::uint8_t>(bits_of(least > bend));
}

void leave_other_nappe(const NappeSteps& nappe, QuadricSides& sides) {
    if (nappe.all_positive(4)) return;
    const auto value = [&](int i, int j, int k) { return nappe.at(i, j, k); };
    const std::uint64_t negative = sides_one_by_one(value, 0.0).inside;
    sides.points.outside |= sides.points.inside & negative;
    sides.points.inside &= ~negative;
    for (int n = 0; n < 8; ++n)
        if (nappe.at(n & 1 ? 3 : 1, n & 2 ? 3 : 1, n & 4 ? 3 : 1) + 2 * nappe.reach < -nappe.error)
            sides.missed = static_cast<std::uint8_t>(sides.missed | 1 << n);
}

}  // namespace

PointColors sides_of(const LatticePlane& plane, const octree::Cell& cell) {
    const PlaneSteps p(plane, cell, cell.side() / 2);
    Values v;
    v.layer[0] = p.at_low + layer_x * p.sx + layer_y * p.sy;
    v.layer[1] = v.layer[0] + p.sz;
    v.layer[2] = v.layer[0] + 2 * p.sz;
    v.ninth = (p.at_low + 2 * p.sx + 2 * p.sy) + ninth_z * p.sz;
    v.middle = p.at_low + middle_x * p.sx + middle_y * p.sy + middle_z * p.sz;
    const PointColors points = v.sides(p.error(2));
    if (all_known(points)) return points;
    return sides_one_by_one(
        [&](int i, int j, int k) { return -p.low - i * (p.x / 2) - j * (p.y / 2) - k * (p.z / 2); },
        std::int64_t{0});
}

OctantColors octants_of(const LatticePlane& plane, const octree::Cell& cell) {
    // From the middle of an octant to its corner farthest inside and outside.
    const PlaneSteps p(plane, cell, cell.side() / 2);
    const Floats middle = p.at_low + middle_x * p.sx + middle_y * p.sy + middle_z * p.sz;
    const float reach = 0.5F * (std::fabs(p.sx) + std::fabs(p.sy) + std::fabs(p.sz)), error = p.error(2);
    const auto octants = [](Flags flags) { return static_cast<std::uint8_t>(bits_of(flags)); };
    const OctantColors colors{octants(middle - reach > error), octants(middle + reach < -error)};
    if ((octants(middle - reach >= -error) == colors.white) &&
        (octants(middle + reach <= error) == colors.black))
        return colors;
    const PointColors points = sides_of(plane, cell);
    return {static_cast<std::uint8_t>(~octants_with_corner(points.inside)),
            static_cast<std::uint8_t>(~octants_with_corner(points.outside))};
}

QuadricSides sides_of(const Quadric& quadric, const octree::Cell& cell) {
    const Offset offset(quadric.origin, cell);
    const double side = cell.side(), quarter = 0.25 * side, error = quadric.error(offset.farthest);
    const QuadricAtCorner corner(quadric, offset.low);
    const QuadricSteps q(quadric, corner, 0.5 * side, 2);
    const float rounding = single_error * q.size + (static_cast<float>(error) * 1.0001F + underflow);
    const Values values = values_of(q);
    QuadricSides sides;
    sides.points = values.sides(rounding);
    if (!all_known(sides.points))
        sides.points = sides_one_by_one(
            [&](int i, int j, int k) { return corner.at(quadric, i * quarter, j * quarter, k * quarter); },
            error);
    const auto drop = static_cast<float>(quarter * quadric.axis_reach);
    sides.missed = above_tangent(q, values.middle, 4 * rounding + drop * drop * 1.0001F);
    if (quadric.axis_reach != 0) leave_other_nappe(NappeSteps(quadric, offset, quarter), sides);
    return sides;
}

OctantColors octants_of(const Quadric& quadric, const octree::Cell& cell) {
    const Offset offset(quadric.origin, cell);
    const double side = cell.side();
    if (quadric.axis_reach != 0 && !NappeSteps(quadric, offset, 0.25 * side).all_positive(4)) {
        const QuadricSides sides = sides_of(quadric, cell);
        return {sides.missed, static_cast<std::uint8_t>(~octants_with_corner(~sides.points.inside))};
    }
    const QuadricSteps q(quadric, QuadricAtCorner(quadric, offset.low), 0.5 * side, 2);
    const float rounding = 4 * (single_error * q.size +
                                (static_cast<float>(quadric.error(offset.farthest)) * 1.0001F + underflow));
    // From the middle of an octant as far as the quadric can rise or fall.
    const Floats gx = q.x + 2 * middle_x * q.xx + middle_y * q.xy + middle_z * q.xz;
    const Floats gy = q.y + middle_x * q.xy + 2 * middle_y * q.yy + middle_z * q.yz;
    const Floats gz = q.z + middle_x * q.xz + middle_y * q.yz + 2 * middle_z * q.zz;
    const Floats middle =
        q.low + 0.5F * (middle_x * (gx + q.x) + middle_y * (gy + q.y) + middle_z * (gz + q.z));
    const Floats slope = 0.5F * (absolute(gx) + absolute(gy) + absolute(gz));
    const auto drop = static_cast<float>(0.25 * side * quadric.axis_reach);
    const float rise = 0.25F * (std::max(q.xx, 0.0F) + std::max(q.yy, 0.0F) + std::max(q.zz, 0.0F) +
                                std::fabs(q.xy) + std::fabs(q.xz) + std::fabs(q.yz));
    const auto octants = [](Flags flags) { return static_cast<std::uint8_t>(bits_of(flags)); };
    return {octants(middle - slope > rounding + drop * drop * 1.0001F),
            octants(middle + slope < -rounding - rise)};
}

PointColors sides_of(const LatticeTorus& torus, const octree::Cell& cell) {
    const Offset offset(torus.origin, cell);
    const double quarter = 0.25 * cell.side();
    return sides_one_by_one(
        [&](int i, int j, int k) {
            return torus.distance(offset.low[0] + i * quarter, offset.low[1] + j * quarter,
                                  offset.low[2] + k * quarter);
        },
        torus.error(offset.farthest));
}

}  // namespace octavo::csg
