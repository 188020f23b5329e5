// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include <octavo/boolean/point_table.hpp>
#include <octavo/exact/plane.hpp>

// The cyclic order of triangles about a common edge, exact even when the edge's ends are constructed points.
//
// Idea: a triangle's plane contains the edge, so its normal is perpendicular to it and turns about it as the
// triangle does. Angles between triangles are angles between normals. The cross product of two such normals is
// parallel to the edge, so the sign of one coordinate of it says which comes first. Nothing constructed is
// multiplied: 53 + 53 + 1 bits suffice.

namespace octavo::boolean {

struct AboutEdge {
    std::int64_t normal[3];  ///< of the triangle's plane, seen so that it runs from the low to the high end
    std::uint32_t entry;     ///< the caller's name for it
    int half = 0;            ///< 1: half a turn or more after the first
};

inline AboutEdge turned(const exact::Plane& plane, bool upward, std::uint32_t entry) {
    const std::int64_t sign = upward ? 1 : -1;
    return {{sign * plane.a(), sign * plane.b(), sign * plane.c()}, entry};
}

/// Sorts counter-clockwise seen from the high end, beginning with the first. No two may point the same way.
void sort_about_edge(const PointTable& points, PointId low, PointId high, std::span<AboutEdge> triangles);

}  // namespace octavo::boolean
