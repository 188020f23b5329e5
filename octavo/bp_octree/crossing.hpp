// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include <octavo/exact/int128.hpp>
#include <octavo/exact/point.hpp>

// Where a line parallel to an axis goes through a triangle; the winding number of cell corners comes of it.
//
// Problem: parity counted along a line is wrong as soon as the line touches an edge, a vertex, or a face's plane.
// Idea: all corners of all cells are moved by the same infinitesimal vector (e, e², e³), so that none of that
// happens any more, and a corner means the same point for every line that reaches it. When a determinant is zero,
// the first coefficient of its powers of e that is not zero has its sign. Source: H. Edelsbrunner and E. P. Mücke,
// Simulation of simplicity, 1990; here only the corners move, never the triangles.
//
// Widths as in triangle_cell.hpp: two dimensions fit int64, a plane's value int128.

namespace octavo::bp_octree {

struct LineCrossing {
    /// 0: the line misses the triangle. 1: it leaves the solid there, going upwards (the winding number falls by
    /// one). −1: it enters.
    int leaves = 0;
    /// Bit i tells whether point i of the line lies above the triangle's plane.
    unsigned above = 0;
};

namespace crossing_detail {

inline int sign(std::int64_t number) { return (number > 0) - (number < 0); }

/// On which side of the line a → b the moved point (u, v) lies: +1 is left. `u` and `v` are doubled; 0 only when
/// a and b coincide. The axis whose power of e is lower comes first.
inline int side_of_edge(std::int64_t au, std::int64_t av, std::int64_t bu, std::int64_t bv, std::int64_t u,
                        std::int64_t v, bool u_moves_first) {
    const std::int64_t du = bu - au, dv = bv - av;
    const int plain = sign(du * (v - 2 * av) - dv * (u - 2 * au));
    if (plain != 0) return plain;
    // The derivatives along u and v are −dv and du.
    const int along_u = -sign(dv), along_v = sign(du);
    if (u_moves_first) return along_u != 0 ? along_u : along_v;
    return along_v != 0 ? along_v : along_u;
}

}  // namespace crossing_detail

/// The line parallel to `axis` through the moved corner whose other doubled coordinates are those of `through`,
/// against the triangle; `points` are doubled coordinates on that axis.
inline LineCrossing cross(exact::Point p, exact::Point q, exact::Point r, int axis,
                          const std::array<std::int32_t, 3>& through,
                          const std::array<std::int32_t, 3>& points) {
    using crossing_detail::side_of_edge;
    using crossing_detail::sign;
    const int u = axis == 2 ? 0 : axis + 1, v = axis == 0 ? 2 : axis - 1;
    const bool u_first = u < v;
    const int side = side_of_edge(p[u], p[v], q[u], q[v], through[u], through[v], u_first);
    if (side == 0 || side != side_of_edge(q[u], q[v], r[u], r[v], through[u], through[v], u_first) ||
        side != side_of_edge(r[u], r[v], p[u], p[v], through[u], through[v], u_first))
        return {};
    std::array<std::int64_t, 3> normal{};
    for (int k = 0; k < 3; ++k) {
        const int s = k == 2 ? 0 : k + 1, t = k == 0 ? 2 : k - 1;
        normal[k] = std::int64_t{q[s] - p[s]} * (r[t] - p[t]) - std::int64_t{q[t] - p[t]} * (r[s] - p[s]);
    }
    LineCrossing result;
    result.leaves = sign(normal[axis]);
    for (unsigned i = 0; i < 3; ++i) {
        exact::int128 value = exact::wide(normal[axis]) * (points[i] - 2 * p[axis]);
        value += exact::wide(normal[u]) * (through[u] - 2 * p[u]);
        value += exact::wide(normal[v]) * (through[v] - 2 * p[v]);
        int above = (value > 0) - (value < 0);
        for (int k = 0; k < 3 && above == 0; ++k) above = sign(normal[k]);
        if (above == result.leaves) result.above |= 1U << i;
    }
    return result;
}

}  // namespace octavo::bp_octree
