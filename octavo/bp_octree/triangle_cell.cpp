// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <octavo/bp_octree/triangle_cell.hpp>

namespace octavo::bp_octree {

TriangleInCells::TriangleInCells(exact::Point p, exact::Point q, exact::Point r)
    : corner_{2 * p.x, 2 * p.y, 2 * p.z} {
    const std::array<exact::Point, 3> corners{p, q, r};
    for (int axis = 0; axis < 3; ++axis) {
        low_[axis] = 2 * std::min({p[axis], q[axis], r[axis]});
        high_[axis] = 2 * std::max({p[axis], q[axis], r[axis]});
        const int u = axis == 2 ? 0 : axis + 1, v = axis == 0 ? 2 : axis - 1;
        const std::int64_t pu = q[u] - p[u], pv = q[v] - p[v], ru = r[u] - p[u], rv = r[v] - p[v];
        normal_[axis] = pu * rv - pv * ru;
        // The inner side of an edge depends on which way round the projection runs.
        const std::int64_t turn = normal_[axis] >= 0 ? 1 : -1;
        for (std::size_t k = 0; k < 3; ++k) {
            const exact::Point a = corners[k], b = corners[(k + 1) % 3];
            EdgeFunction& edge = edges_[axis][k];
            edge.first = -turn * (b[v] - a[v]);
            edge.second = turn * (b[u] - a[u]);
            edge.value = -2 * (edge.first * a[u] + edge.second * a[v]);
        }
    }
}

}  // namespace octavo::bp_octree
