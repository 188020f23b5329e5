// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <octavo/base/check.hpp>
#include <octavo/boolean/about_edge.hpp>
#include <octavo/exact/bit_budget.hpp>

namespace octavo::boolean {

using exact::int128;
using exact::Sign;
using exact::wide;

void sort_about_edge(const PointTable& points, PointId low, PointId high, std::span<AboutEdge> triangles) {
    static_assert(exact::budget::sum(3, 2 * exact::budget::normal) < 127);
    int axis = 0;  // one in which the edge is not level
    Sign direction = points.compare_coordinate(axis, high, low);
    while (direction == Sign::zero && axis < 2) direction = points.compare_coordinate(++axis, high, low);
    OCTAVO_CHECK(direction != Sign::zero, "an edge joins a point with itself");
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;

    const auto turn = [i, j, direction](const AboutEdge& a, const AboutEdge& b) {
        return exact::sign_of(wide(a.normal[i]) * b.normal[j] - wide(a.normal[j]) * b.normal[i]) * direction;
    };
    const AboutEdge first = triangles[0];
    for (AboutEdge& each : triangles) {
        const Sign side = turn(first, each);
        const int128 along = wide(first.normal[0]) * each.normal[0] + wide(first.normal[1]) * each.normal[1] +
                             wide(first.normal[2]) * each.normal[2];
        each.half = side == Sign::negative || (side == Sign::zero && along < 0) ? 1 : 0;
    }
    std::sort(triangles.begin() + 1, triangles.end(), [&](const AboutEdge& a, const AboutEdge& b) {
        if (a.half != b.half) return a.half < b.half;
        const Sign order = turn(a, b);
        return order != Sign::zero ? order == Sign::positive : a.entry < b.entry;
    });
}

}  // namespace octavo::boolean
