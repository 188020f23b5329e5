// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include <octavo/classic/facet.hpp>

// How the winding number changes along an axis-parallel step between lattice points.
//
// Problem: a step may run through an edge or a corner of the surface, along a facet, or end on one. Idea (simulation
// of simplicity): move both ends by the same symbolic displacement (ε₁, ε₂, ε₃) with 1 ≫ ε₁ ≫ ε₂ ≫ ε₃ > 0. Then no
// end lies on a facet, no step meets an edge, and every sign below is that of a polynomial in the ε whose terms are
// looked at in order: the value at the lattice point, then the coefficient of x, of y, of z. No case is special.
//
// The displaced point of a cell's low corner lies inside the cell, so its winding number is that of the cell's
// interior wherever no facet meets the interior; and a step between low corners of octants stays inside the parent,
// so only facets that touch the parent's interior can be crossed.
//
// Source: H. Edelsbrunner and E. P. Mücke, Simulation of Simplicity, 1990; here one displacement is shared by all
// query points instead of one for each input vertex, so that two coefficients decide and the input stays as it is.

namespace octavo::classic {

namespace crossing_detail {

__extension__ using Wide = __int128;

// Normal 55 bits, differences 27 + sign, three products: the value of a plane at a lattice point.
static_assert((2 * exact::coordinate_bits + 3) + (exact::coordinate_bits + 1) + 2 < 127);

/// On which side of the facet's plane the displaced lattice point lies: true on the side of the normal.
inline bool is_above(const Facet& facet, const Normal& n, const std::array<std::int32_t, 3>& p) {
    const std::array<std::int32_t, 3>& a = facet.corner[0];
    const Wide value = Wide{n.x} * (p[0] - a[0]) + Wide{n.y} * (p[1] - a[1]) + Wide{n.z} * (p[2] - a[2]);
    if (value != 0) return value > 0;
    return n.x != 0 ? n.x > 0 : n.y != 0 ? n.y > 0 : n.z > 0;
}

/// Whether the displaced point (u, v) lies left of the projected edge from `a` to `b`; `first` < `second` are the
/// axes of the projection, so that the coefficient of u decides ties before that of v. Products of 27-bit
/// differences: 54 bits.
inline bool is_left(const std::array<std::int32_t, 3>& a, const std::array<std::int32_t, 3>& b,
                    std::size_t first, std::size_t second, std::int64_t u, std::int64_t v) {
    const std::int64_t du = b[first] - a[first], dv = b[second] - a[second];
    const std::int64_t value = du * (v - a[second]) - dv * (u - a[first]);
    if (value != 0) return value > 0;
    return dv != 0 ? dv < 0 : du > 0;
}

}  // namespace crossing_detail

/// The change of the winding number of `facet`'s surface from `start` to the point `length` further along `axis`,
/// both displaced: −1 when the step leaves through the facet, +1 when it enters, 0 when it does not meet it.
/// Coordinates are those of the universe; one step beyond its sides is allowed.
inline int crossing(const Facet& facet, const std::array<std::int32_t, 3>& start, int axis,
                    std::int32_t length) {
    using namespace crossing_detail;
    const Normal n = normal_of(facet);
    if (n[axis] == 0) return 0;
    const std::size_t first = axis == 0 ? 1 : 0, second = axis == 2 ? 1 : 2;
    const std::int64_t u = start[first], v = start[second];
    const auto& [a, b, c] = facet.corner;
    const bool left = is_left(a, b, first, second, u, v);
    if (left != is_left(b, c, first, second, u, v) || left != is_left(c, a, first, second, u, v)) return 0;
    std::array<std::int32_t, 3> end = start;
    end[static_cast<std::size_t>(axis)] += length;
    const bool above = is_above(facet, n, start);
    if (above == is_above(facet, n, end)) return 0;
    return above ? 1 : -1;
}

}  // namespace octavo::classic
