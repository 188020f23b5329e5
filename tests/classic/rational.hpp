// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <octavo/mesh/mesh.hpp>

#include "unlimited.hpp"

// Slow and obviously right geometry in unlimited numbers: the oracle of octrees and inside answers. It shares no
// formula with the library: overlap is by clipping in rationals, winding numbers are by rays in oblique directions
// among points that are all scaled to integers.

namespace octavo::tests {

using RationalPoint = std::array<Rational, 3>;

inline RationalPoint rational(exact::Point p) { return {p.x, p.y, p.z}; }

/// The part of a convex polygon where coordinate `axis` times `sense` is at least `bound` times `sense`.
inline std::vector<RationalPoint> clipped(const std::vector<RationalPoint>& polygon, std::size_t axis,
                                          const Rational& bound, int sense) {
    std::vector<RationalPoint> result;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const RationalPoint &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
        const Rational a = sense * (p[axis] - bound), b = sense * (q[axis] - bound);
        if (a >= 0) result.push_back(p);
        if ((a > 0 && b < 0) || (a < 0 && b > 0)) {
            const Rational t = a / (a - b);
            RationalPoint cut;
            for (std::size_t k = 0; k < 3; ++k) cut[k] = p[k] + t * (q[k] - p[k]);
            cut[axis] = bound;
            result.push_back(cut);
        }
    }
    return result;
}

/// The closed triangle's part in the closed box, as a polygon that may be degenerate; empty when there is none.
inline std::vector<RationalPoint> part_in_box(const std::array<exact::Point, 3>& triangle, exact::Point low,
                                              exact::Point high) {
    for (int axis = 0; axis < 3; ++axis) {
        const auto [least, greatest] = std::minmax({triangle[0][axis], triangle[1][axis], triangle[2][axis]});
        if (greatest < low[axis] || least > high[axis]) return {};
    }
    std::vector<RationalPoint> polygon{rational(triangle[0]), rational(triangle[1]), rational(triangle[2])};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        polygon = clipped(polygon, axis, low[static_cast<int>(axis)], 1);
        polygon = clipped(polygon, axis, high[static_cast<int>(axis)], -1);
    }
    return polygon;
}

/// True when the triangle meets the open box: the mean of the part in the closed box is then a point of it.
inline bool meets_open_box(const std::array<exact::Point, 3>& triangle, exact::Point low, exact::Point high) {
    const std::vector<RationalPoint> part = part_in_box(triangle, low, high);
    if (part.empty()) return false;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        Rational mean = 0;
        for (const RationalPoint& p : part) mean += p[axis];
        mean /= part.size();
        if (mean <= low[static_cast<int>(axis)] || mean >= high[static_cast<int>(axis)]) return false;
    }
    return true;
}

/// True when the triangle meets the box without its high sides: the mean of the part in the closed box lies below
/// every high side that does not hold the whole part.
inline bool meets_half_open_box(const std::array<exact::Point, 3>& triangle, exact::Point low,
                                exact::Point high) {
    const std::vector<RationalPoint> part = part_in_box(triangle, low, high);
    if (part.empty()) return false;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        Rational mean = 0;
        for (const RationalPoint& p : part) mean += p[axis];
        if (mean / part.size() >= high[static_cast<int>(axis)]) return false;
    }
    return true;
}

using IntegerPoint = std::array<Integer, 3>;

/// A surface whose coordinates are multiplied by `scale`, so that points with that denominator are integers.
struct ScaledSurface {
    std::vector<std::array<IntegerPoint, 3>> triangles;

    ScaledSurface(const mesh::LatticeMesh& mesh, const Integer& scale) {
        const auto scaled = [&](mesh::VertexIndex vertex) {
            const exact::Point p = mesh.points[vertex];
            return IntegerPoint{p.x * scale, p.y * scale, p.z * scale};
        };
        for (const mesh::Triangle& t : mesh.triangles)
            triangles.push_back({scaled(t[0]), scaled(t[1]), scaled(t[2])});
    }
};

/// Where a point is: on a facet, or else its winding number.
struct Place {
    bool on_facet = false;
    int winding = 0;
};

/// The directions of rays, all oblique.
inline std::array<int, 3> ray_direction(int attempt) {
    return {1000003 + 7919 * attempt, 777767 - 104729 * attempt, 500009 + 31 * attempt * attempt};
}

/// By a ray in this direction among `triangles`, of which there are at least all that meet the ray's line; none when it
/// meets an edge.
template <class Triangles>
std::optional<Place> place_by_ray(const Triangles& triangles, const IntegerPoint& p,
                                  const std::array<int, 3>& direction) {
    const auto minus = [](const IntegerPoint& a, const IntegerPoint& b) {
        return IntegerPoint{a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    };
    const auto cross = [](const IntegerPoint& a, const IntegerPoint& b) {
        return IntegerPoint{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    };
    const auto dot = [](const IntegerPoint& a, const IntegerPoint& b) -> Integer {
        return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    };
    const IntegerPoint d{direction[0], direction[1], direction[2]};
    int winding = 0;
    bool meets_edge = false;
    for (const std::array<IntegerPoint, 3>& triangle : triangles) {
        const IntegerPoint a = minus(triangle[0], p), b = minus(triangle[1], p), c = minus(triangle[2], p);
        const IntegerPoint n = cross(minus(b, a), minus(c, a));
        if (n[0] == 0 && n[1] == 0 && n[2] == 0) continue;
        const int height = dot(a, n).sign();
        if (height == 0) {
            // In the plane: on the facet iff on the inner side of each edge.
            if (dot(n, cross(a, b)).sign() >= 0 && dot(n, cross(b, c)).sign() >= 0 &&
                dot(n, cross(c, a)).sign() >= 0)
                return Place{true, 0};
            continue;
        }
        const int along = dot(d, n).sign();
        const int ab = dot(d, cross(a, b)).sign(), bc = dot(d, cross(b, c)).sign(),
                  ca = dot(d, cross(c, a)).sign();
        const bool hit = along != 0 && ab * along >= 0 && bc * along >= 0 && ca * along >= 0;
        if (along == 0) meets_edge = true;
        if (!hit || along != height) continue;  // beside it, or behind the start
        if (ab == 0 || bc == 0 || ca == 0) meets_edge = true;
        winding += along;
    }
    if (meets_edge) return std::nullopt;
    return Place{false, winding};
}

/// By the first ray that meets no edge.
inline Place place_of(const ScaledSurface& surface, const IntegerPoint& p) {
    for (int attempt = 0;; ++attempt)
        if (const auto place = place_by_ray(surface.triangles, p, ray_direction(attempt))) return *place;
}

/// Whether a point lies between two corners of some facet: what there is of one without area.
template <class Triangles>
bool is_between_corners(const Triangles& triangles, const IntegerPoint& p) {
    for (const std::array<IntegerPoint, 3>& triangle : triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            IntegerPoint u, v;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                u[axis] = triangle[k][axis] - p[axis];
                v[axis] = triangle[(k + 1) % 3][axis] - p[axis];
            }
            const bool on_line =
                u[1] * v[2] == u[2] * v[1] && u[2] * v[0] == u[0] * v[2] && u[0] * v[1] == u[1] * v[0];
            if (on_line && u[0] * v[0] + u[1] * v[1] + u[2] * v[2] <= 0) return true;
        }
    return false;
}

}  // namespace octavo::tests
