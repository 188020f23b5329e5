// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include <octavo/exact/homogeneous_point.hpp>
#include <octavo/exact/plane.hpp>

// Where lattice edges, lines and planes meet; the widths are proved in bit_budget.hpp.

namespace octavo::exact {

/// The point where the line through p and q meets a plane on which they have the values `at_p` and `at_q`
/// (Plane::value_at), for callers that have them already. The values must differ.
constexpr EdgePoint intersect_edge(Point p, Point q, int128 at_p, int128 at_q) {
    // p + (q - p) at_p / (at_p - at_q), times the denominator.
    static_assert(budget::edge_numerator < 127 && budget::edge_weight < 127);
    const int128 w = at_p - at_q;
    return {w * p.x + at_p * (q.x - p.x), w * p.y + at_p * (q.y - p.y), w * p.z + at_p * (q.z - p.z), w};
}

/// The point where the line through p and q meets the plane; none when it is parallel to the plane or lies in
/// it.
constexpr std::optional<EdgePoint> intersect(Point p, Point q, const Plane& plane) {
    const int128 at_p = plane.value_at(p), at_q = plane.value_at(q);
    if (at_p == at_q) return std::nullopt;
    return intersect_edge(p, q, at_p, at_q);
}

/// The line of two planes: direction m = n1 x n2 and moment k = d1 n2 - d2 n1. On the first
/// plane, seen from its positive side, the second plane's positive side is to the right of the line.
class Line {
  public:
    Line(const Plane& first, const Plane& second);

    int128 direction(int axis) const { return direction_[axis]; }
    const Int192& moment(int axis) const { return moment_[axis]; }

    /// The planes were parallel: there is no line.
    bool degenerate() const { return (direction_[0] | direction_[1] | direction_[2]) == 0; }

  private:
    std::array<int128, 3> direction_;
    std::array<Int192, 3> moment_;
};

/// The point where a line meets a plane; none when they are parallel.
std::optional<TriplePoint> intersect(const Line& line, const Plane& plane);

/// The point that three planes have in common; none when there is no single one. To cut the line of two
/// planes with many others, keep the Line.
std::optional<TriplePoint> intersect(const Plane& first, const Plane& second, const Plane& third);

/// The same where one plane is across an axis, in two thirds of the time: two lines in that plane meet. Here `twice`
/// may be -1 too.
std::optional<TriplePoint> intersect(const Plane& first, const Plane& second, const AxisPlane& third);

}  // namespace octavo::exact
