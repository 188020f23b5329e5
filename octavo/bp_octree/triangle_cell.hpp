// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include <octavo/bp_octree/frame.hpp>
#include <octavo/exact/int128.hpp>

// Which cells a triangle meets, exactly.
//
// A triangle and a box are apart when one of 13 axes separates them: the box's three, the triangle's normal, and
// the nine products of an edge and a box axis. Everything of the triangle is prepared once, in the form of M.
// Schwarz and H.-P. Seidel, Fast parallel surface and solid voxelization on GPUs, 2010: per projection three edge
// functions that are evaluated at the corner of the box that lies farthest in. One-sided edge functions suffice:
// the projections of a triangle that is seen edge-on run back along the line they went, so they test both sides.
//
// Widths (doubled coordinates below 2^27 + 2^20, differences below 2^28): an edge function is a sum of two
// products of an edge below 2^27 and a difference below 2^28, so it fits int64; the plane's value is a sum of
// three products of a normal below 2^53 and a difference, below 2^83, which is decided in doubles unless it is
// within their error, and then in 128 bits.

namespace octavo::bp_octree {

class TriangleInCells {
  public:
    TriangleInCells(exact::Point p, exact::Point q, exact::Point r);

    /// Whether the closed triangle and the closed box have a common point. Degenerate triangles are segments or
    /// points.
    bool meets(const CellBox& box) const;

    std::int32_t low(int axis) const { return low_[axis]; }    ///< doubled
    std::int32_t high(int axis) const { return high_[axis]; }  ///< doubled

  private:
    struct EdgeFunction {
        std::int64_t first = 0, second = 0;  ///< gradient along the two axes of the projection
        std::int64_t value = 0;              ///< at the origin
    };
    bool plane_meets(const CellBox& box) const;

    std::array<std::int32_t, 3> low_, high_;
    std::array<std::array<EdgeFunction, 3>, 3> edges_;  ///< [projection axis][edge]
    std::array<std::int64_t, 3> normal_;
    std::array<std::int32_t, 3> corner_;  ///< a doubled vertex
    static_assert(2 + 27 + 28 < 63, "edge functions fit int64");
    static_assert(2 + 53 + 28 < 127, "plane values fit int128");
};

inline bool TriangleInCells::plane_meets(const CellBox& box) const {
    // The box's corners that lie farthest along and against the normal must be on different sides.
    double along = 0, against = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double n = static_cast<double>(normal_[axis]);
        const double low = box.low[axis] - corner_[axis], high = box.high[axis] - corner_[axis];
        along += n * (n > 0 ? high : low);
        against += n * (n > 0 ? low : high);
    }
    // Inputs are exact doubles; five roundings of numbers below 2^83 err by less than 5 · 2^30.
    constexpr double error = 8589934592.0;  // 2^33
    if (along > error && against < -error) return true;
    if (along < -error || against > error) return false;
    exact::int128 exact_along = 0, exact_against = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const exact::int128 n = exact::wide(normal_[axis]);
        const std::int64_t low = std::int64_t{box.low[axis]} - corner_[axis];
        const std::int64_t high = std::int64_t{box.high[axis]} - corner_[axis];
        exact_along += n * (n > 0 ? high : low);
        exact_against += n * (n > 0 ? low : high);
    }
    return exact_along >= 0 && exact_against <= 0;
}

inline bool TriangleInCells::meets(const CellBox& box) const {
    for (int axis = 0; axis < 3; ++axis)
        if (low_[axis] > box.high[axis] || high_[axis] < box.low[axis]) return false;
    for (int axis = 0; axis < 3; ++axis) {
        const int u = axis == 2 ? 0 : axis + 1, v = axis == 0 ? 2 : axis - 1;
        for (const EdgeFunction& edge : edges_[axis]) {
            const std::int64_t at_u = edge.first > 0 ? box.high[u] : box.low[u];
            const std::int64_t at_v = edge.second > 0 ? box.high[v] : box.low[v];
            if (edge.first * at_u + edge.second * at_v + edge.value < 0) return false;
        }
    }
    return plane_meets(box);
}

}  // namespace octavo::bp_octree
