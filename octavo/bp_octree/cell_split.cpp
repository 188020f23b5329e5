// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <octavo/bp_octree/cell_split.hpp>
#include <octavo/bp_octree/crossing.hpp>
#include <octavo/bp_octree/triangle_cell.hpp>

namespace octavo::bp_octree {
namespace {

std::array<exact::Point, 3> corners_of(const mesh::LatticeMesh& mesh, mesh::FaceIndex face) {
    const mesh::Triangle& t = mesh.triangles[face];
    return {mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]};
}

std::int32_t low_of(const std::array<exact::Point, 3>& t, int axis) {
    return 2 * std::min({t[0][axis], t[1][axis], t[2][axis]});
}
std::int32_t high_of(const std::array<exact::Point, 3>& t, int axis) {
    return 2 * std::max({t[0][axis], t[1][axis], t[2][axis]});
}

/// The low, middle and high planes of a cell across each axis.
using Grid = std::array<std::array<std::int32_t, 3>, 3>;

Grid grid_of(const CellBox& cell) {
    Grid grid;
    for (int axis = 0; axis < 3; ++axis)
        grid[axis] = {cell.low[axis], cell.low[axis] + cell.side(axis) / 2, cell.high[axis]};
    return grid;
}

}  // namespace

WindingGrid wind(const mesh::LatticeMesh& mesh, std::span<const mesh::FaceIndex> triangles,
                 const CellBox& cell, std::int32_t at_low) {
    const Grid grid = grid_of(cell);
    // change[axis][line][half]: what is added to the winding number on the way up. All z lines are used, the y
    // lines on the low z side, and one x line: together they reach every point once.
    std::array<std::array<std::array<std::int32_t, 2>, 9>, 3> change{};
    for (const mesh::FaceIndex face : triangles) {
        const std::array<exact::Point, 3> t = corners_of(mesh, face);
        std::array<unsigned, 3> within{};  // bit i: plane i of the axis meets the triangle's bounds
        for (int axis = 0; axis < 3; ++axis)
            for (unsigned i = 0; i < 3; ++i)
                if (low_of(t, axis) < grid[axis][i] && grid[axis][i] < high_of(t, axis))
                    within[axis] |= 1U << i;
        for (int axis = 0; axis < 3; ++axis) {
            const int u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2;
            const unsigned u_planes = within[u] & (axis == 0 ? 1U : 7U);
            const unsigned v_planes = within[v] & (axis == 2 ? 7U : 1U);
            for (unsigned i = 0; i < 3; ++i)
                for (unsigned j = 0; j < 3; ++j) {
                    if (!(u_planes >> i & 1) || !(v_planes >> j & 1)) continue;
                    std::array<std::int32_t, 3> through{};
                    through[u] = grid[u][i];
                    through[v] = grid[v][j];
                    const LineCrossing crossing = cross(t[0], t[1], t[2], axis, through, grid[axis]);
                    for (unsigned half = 0; half < 2; ++half)
                        if ((crossing.above >> half & 1) == 0 && (crossing.above >> (half + 1) & 1) == 1)
                            change[axis][i + 3 * j][half] -= crossing.leaves;
                }
        }
    }
    WindingGrid winding{};
    winding[0] = at_low;
    for (unsigned i = 0; i < 3; ++i) {
        if (i > 0) winding[i] = winding[i - 1] + change[0][0][i - 1];
        for (unsigned j = 0; j < 3; ++j) {
            if (j > 0) winding[i + 3 * j] = winding[i + 3 * (j - 1)] + change[1][i][j - 1];
            for (unsigned k = 1; k < 3; ++k)
                winding[i + 3 * j + 9 * k] = winding[i + 3 * j + 9 * (k - 1)] + change[2][i + 3 * j][k - 1];
        }
    }
    return winding;
}

void distribute(const mesh::LatticeMesh& mesh, std::span<const mesh::FaceIndex> triangles,
                const CellBox& cell, std::array<std::vector<mesh::FaceIndex>, 8>& octants) {
    const Grid grid = grid_of(cell);
    for (const mesh::FaceIndex face : triangles) {
        const std::array<exact::Point, 3> t = corners_of(mesh, face);
        // Octants that the bounds meet: most triangles of most cells lie in one, and need no test.
        constexpr std::array<unsigned, 3> high_octants{0xaa, 0xcc, 0xf0};
        unsigned mask = 0xff;
        for (int axis = 0; axis < 3; ++axis) {
            if (low_of(t, axis) > grid[axis][1]) mask &= high_octants[axis];
            if (high_of(t, axis) < grid[axis][1]) mask &= ~high_octants[axis];
        }
        if ((mask & (mask - 1)) == 0) {
            // One octant, and the triangle meets the cell, so it meets this one.
            for (unsigned i = 0; i < 8; ++i)
                if (mask >> i & 1) octants[i].push_back(face);
            continue;
        }
        const TriangleInCells prepared(t[0], t[1], t[2]);
        for (unsigned i = 0; i < 8; ++i) {
            if (!(mask >> i & 1)) continue;
            CellBox box;
            for (int axis = 0; axis < 3; ++axis) {
                const unsigned high = i >> axis & 1;
                box.low[axis] = grid[axis][high];
                box.high[axis] = grid[axis][high + 1];
            }
            if (prepared.meets(box)) octants[i].push_back(face);
        }
    }
}

}  // namespace octavo::bp_octree
