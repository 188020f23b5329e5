// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <span>
#include <vector>

// Convex polygons in the picture, cut by lines.
//
// Doubles are good enough: corners nearer to a line than `on_line` count as on it, so that cuts along one edge by the
// faces on both its sides leave no slivers. The line of an edge is computed from its ends in one order, whichever way
// the edge runs: faces that share the edge cut exactly alike.

namespace octavo::render {

struct Point2 {
    double x = 0, y = 0;
    friend bool operator==(const Point2&, const Point2&) = default;
};

/// In pixels; rounding is a thousand times less.
inline constexpr double on_line = 1e-8;

/// Positive to the left of where the edge runs, in pixels. (With y down, that is on the right as displayed.)
struct Line2 {
    double nx = 0, ny = 0, offset = 0;

    double operator()(Point2 p) const { return nx * p.x + ny * p.y - offset; }
    Line2 reversed() const { return {-nx, -ny, -offset}; }

    static Line2 through(Point2 from, Point2 to) {
        if (to.x < from.x || (to.x == from.x && to.y < from.y)) return through(to, from).reversed();
        const double dx = to.x - from.x, dy = to.y - from.y, size = std::hypot(dx, dy);
        if (size == 0) return {};
        return {-dy / size, dx / size, (-dy * from.x + dx * from.y) / size};
    }
};

inline double twice_area(std::span<const Point2> polygon) {
    double sum = 0;
    for (std::size_t i = 2; i < polygon.size(); ++i) {
        const Point2 a = polygon[0], b = polygon[i - 1], c = polygon[i];
        sum += (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
    }
    return sum;
}

/// Cuts a convex polygon: what lies left of the line goes to `left`, the rest to `right`; parts without area are empty.
inline void cut(std::span<const Point2> polygon, const Line2& line, std::vector<Point2>& left,
                std::vector<Point2>& right) {
    left.clear(), right.clear();
    bool has_left = false, has_right = false;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point2 p = polygon[i], q = polygon[i + 1 == polygon.size() ? 0 : i + 1];
        const double at_p = line(p), at_q = line(q);
        const bool p_left = at_p > on_line, p_right = at_p < -on_line;
        has_left |= p_left, has_right |= p_right;
        if (!p_right) left.push_back(p);
        if (!p_left) right.push_back(p);
        if (!(p_left && at_q < -on_line) && !(p_right && at_q > on_line)) continue;
        const double t = at_p / (at_p - at_q);
        const Point2 meet{p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)};
        left.push_back(meet), right.push_back(meet);
    }
    if (!has_left) left.clear();
    if (!has_right) right.clear();
}

}  // namespace octavo::render
