// SPDX-License-Identifier: Apache-2.0
#if defined(__GNUC__) && !defined(__clang__)
// std::sqrt would set errno for negative arguments, which keeps eight of them from being one instruction or two.
#pragma GCC optimize("no-math-errno")
#endif

#include <algorithm>
#include <array>
#include <cmath>

#include <octavo/csg/classify.hpp>

// One half space or one convex quadric against the eight octants of a cell.

namespace octavo::csg {
namespace {

constexpr std::size_t lanes = 8;
using Lanes = std::array<double, lanes>;

// The sign of the offset of octant i's middle from the parent's, by axis.
constexpr std::array<Lanes, 3> octant_sign{
    {{-1, 1, -1, 1, -1, 1, -1, 1}, {-1, -1, 1, 1, -1, -1, 1, 1}, {-1, -1, -1, -1, 1, 1, 1, 1}}};

template <class Test>
std::uint8_t mask_of(const Test& test) {
    unsigned mask = 0;
    for (std::size_t i = 0; i < lanes; ++i) mask |= static_cast<unsigned>(test(i)) << i;
    return static_cast<std::uint8_t>(mask);
}

/// The excess at a corner of the octant: the farthest one along the gradient, or the nearest.
double excess_at_corner(const SecondOrderCone& cone, const std::array<double, 3>& middle, double half,
                        const std::array<double, 3>& sign) {
    return cone.excess(middle[0] + sign[0] * half, middle[1] + sign[1] * half, middle[2] + sign[2] * half);
}

bool all_corners_inside(const SecondOrderCone& cone, const std::array<double, 3>& middle, double half,
                        double error) {
    for (int corner = 0; corner < 8; ++corner) {
        const std::array<double, 3> sign{corner & 1 ? 1.0 : -1.0, corner & 2 ? 1.0 : -1.0,
                                         corner & 4 ? 1.0 : -1.0};
        if (excess_at_corner(cone, middle, half, sign) > -error) return false;
    }
    return true;
}

bool nearest_corner_inside(const SecondOrderCone& cone, const std::array<double, 3>& middle, double half,
                           double error) {
    const Vec3 g = cone.gradient(middle[0], middle[1], middle[2]);
    const std::array<double, 3> sign{g.x > 0 ? -1.0 : 1.0, g.y > 0 ? -1.0 : 1.0, g.z > 0 ? -1.0 : 1.0};
    return excess_at_corner(cone, middle, half, sign) < -error;
}

}  // namespace

ConstraintOnOctants classify(const LatticePlane& plane, const octree::Cell& parent) {
    // In an octant the value is that at its low corner plus the steps of one sign.
    const std::int64_t half = parent.side() / 2;
    const std::int64_t origin = plane.at(parent.low.x, parent.low.y, parent.low.z);
    const std::int64_t x = plane.normal[0] * half, y = plane.normal[1] * half, z = plane.normal[2] * half;
    const std::int64_t rise =
        std::max<std::int64_t>(x, 0) + std::max<std::int64_t>(y, 0) + std::max<std::int64_t>(z, 0);
    const std::int64_t fall = x + y + z - rise;
    const std::array<std::int64_t, lanes> low{origin,     origin + x,     origin + y,     origin + x + y,
                                              origin + z, origin + x + z, origin + y + z, origin + x + y + z};
    ConstraintOnOctants result;
    result.colors.black = mask_of([&](std::size_t i) { return low[i] + fall >= 0; });
    result.meets = mask_of([&](std::size_t i) { return low[i] + rise > 0; });
    result.colors.white = static_cast<std::uint8_t>(~result.meets);
    // The middle: half of the sum of the two extremes, doubled so that it stays an integer. Bits: one more than
    // a value, which `at` leaves room for by staying below 7/8 of the range; halved first to be safe.
    result.middle_inside =
        mask_of([&](std::size_t i) { return (low[i] + fall) / 2 + (low[i] + rise) / 2 > 0; });
    return result;
}

ConstraintOnOctants classify(const SecondOrderCone& cone, const octree::Cell& parent) {
    const double half = 0.25 * parent.side();  // of an octant
    std::array<double, 3> d;                   // the parent's middle
    double distance = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        d[a] = (static_cast<double>(parent.low[axis]) + 2 * half) - cone.origin[a];
        distance = std::fmax(distance, std::fabs(d[a]));
    }
    const double error = cone.error(distance + 2 * half);

    std::array<Lanes, 4> u;
    for (std::size_t r = 0; r < 4; ++r) {
        const double middle = cone.value(r, d[0], d[1], d[2]);
        const double x = cone.row[r][0] * half, y = cone.row[r][1] * half, z = cone.row[r][2] * half;
        for (std::size_t i = 0; i < lanes; ++i)
            u[r][i] = middle + (octant_sign[0][i] * x + octant_sign[1][i] * y + octant_sign[2][i] * z);
    }
    // f at the middle, the most its tangent changes over the octant, and the most f leaves its tangent: the norm
    // bends by |L d|² / 2|L x + l| at most.
    const double step = cone.reach * half;
    const double bend = 0.5 * step * step * (1 + 0x1p-40);
    Lanes excess, slope, curve;
    for (std::size_t i = 0; i < lanes; ++i) {
        const double norm = std::sqrt(u[0][i] * u[0][i] + u[1][i] * u[1][i] + u[2][i] * u[2][i]);
        const double inverse = 1 / (norm + 1e-300);
        excess[i] = norm - u[3][i];
        double sum = 0;
        for (std::size_t a = 0; a < 3; ++a)
            sum += std::fabs(
                inverse * (u[0][i] * cone.row[0][a] + u[1][i] * cone.row[1][a] + u[2][i] * cone.row[2][a]) -
                cone.row[3][a]);
        slope[i] = sum * half;
        curve[i] = bend * inverse;
    }
    ConstraintOnOctants result;
    result.colors.white = mask_of([&](std::size_t i) { return excess[i] - slope[i] > error; });
    result.colors.black = mask_of([&](std::size_t i) { return excess[i] + slope[i] + curve[i] < -error; });
    result.middle_inside = mask_of([&](std::size_t i) { return excess[i] < -error; });
    const std::uint8_t not_black = mask_of([&](std::size_t i) { return excess[i] + slope[i] > error; });
    result.meets = mask_of([&](std::size_t i) { return excess[i] - slope[i] + curve[i] < -error; });
    result.meets |= result.middle_inside;

    // A thin shell is left where the bounds of the bend do not tell; there the corners do.
    const auto middle_of = [&](std::size_t i) {
        return std::array<double, 3>{d[0] + octant_sign[0][i] * half, d[1] + octant_sign[1][i] * half,
                                     d[2] + octant_sign[2][i] * half};
    };
    unsigned open = ~static_cast<unsigned>(result.colors.white | result.colors.black) & 0xFF;
    for (std::size_t i = 0; i < lanes; ++i) {
        if (!(open >> i & 1)) continue;
        const auto bit = static_cast<std::uint8_t>(1U << i);
        if ((result.middle_inside & bit) && !(not_black & bit)) {
            if (all_corners_inside(cone, middle_of(i), half, error)) result.colors.black |= bit;
        } else if (!(result.meets & bit)) {
            if (nearest_corner_inside(cone, middle_of(i), half, error)) result.meets |= bit;
        }
    }
    return result;
}

}  // namespace octavo::csg
