// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <octavo/csg/lattice_polyhedron.hpp>
#include <octavo/csg/tessellate.hpp>

#include "unlimited.hpp"

namespace octavo::csg {
namespace {

using octavo::tests::Rational;
using Point = std::array<Rational, 3>;

/// Whether a triangle meets the open cube: its part in the closed cube has a mean strictly inside.
bool meets(const std::array<std::array<std::int32_t, 3>, 3>& triangle, const octree::Cell& cell) {
    std::vector<Point> polygon;
    for (const auto& p : triangle) polygon.push_back({p[0], p[1], p[2]});
    for (int axis = 0; axis < 3; ++axis)
        for (const int sign : {1, -1}) {
            const auto a = static_cast<std::size_t>(axis);
            const Rational bound = sign > 0 ? cell.high()[axis] : cell.low[axis];
            std::vector<Point> kept;
            for (std::size_t i = 0; i < polygon.size(); ++i) {
                const Point &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
                const Rational hp = sign * (p[a] - bound), hq = sign * (q[a] - bound);
                if (hp <= 0) kept.push_back(p);
                if ((hp < 0 && hq > 0) || (hp > 0 && hq < 0)) {
                    const Rational t = hp / (hp - hq);
                    kept.push_back(
                        {p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1]), p[2] + t * (q[2] - p[2])});
                }
            }
            polygon = kept;
        }
    if (polygon.empty()) return false;
    for (int axis = 0; axis < 3; ++axis) {
        Rational mean = 0;
        for (const Point& p : polygon) mean += p[static_cast<std::size_t>(axis)];
        mean /= static_cast<int>(polygon.size());
        if (mean <= cell.low[axis] || mean >= cell.high()[axis]) return false;
    }
    return true;
}

TEST(LatticePolyhedron, TrianglesMeetTheOctantsThatRationalsSayTheyMeet) {
    std::mt19937 engine(3);
    int met = 0;
    for (int round = 0; round < 1000; ++round) {
        const octree::Cell parent =
            octree::Cell::root().child(static_cast<int>(engine() % 8)).child(static_cast<int>(engine() % 8));
        // On a coarse grid about the cell, so that corners, edges and planes touch often; or anywhere.
        const bool degenerate = round % 2 == 0;
        LatticePolyhedron polyhedron;
        std::array<std::array<std::int32_t, 3>, 3> corners;
        for (auto& p : corners)
            for (int a = 0; a < 3; ++a)
                p[static_cast<std::size_t>(a)] =
                    parent.low[a] + (degenerate
                                         ? (static_cast<std::int32_t>(engine() % 9) - 2) * (parent.side() / 4)
                                         : static_cast<std::int32_t>(engine() % (2U << 24)) - (1 << 23));
        const auto& [p, q, r] = corners;
        bool flat = true;
        for (std::size_t a = 0; a < 3; ++a) {
            const std::size_t b = (a + 1) % 3;
            flat = flat &&
                   std::int64_t{q[a] - p[a]} * (r[b] - p[b]) == std::int64_t{q[b] - p[b]} * (r[a] - p[a]);
        }
        if (flat) continue;
        polyhedron.points.assign(corners.begin(), corners.end());
        polyhedron.triangles = {{0, 1, 2}};
        const std::uint8_t octants = polyhedron.octants_met(0, parent);
        for (int octant = 0; octant < 8; ++octant) {
            const bool expected = meets(corners, parent.child(octant));
            met += expected;
            ASSERT_EQ((octants >> octant & 1) != 0, expected) << "round " << round << " octant " << octant;
        }
    }
    EXPECT_GT(met, 200);
}

/// A ball of triangles with corners on a coarse grid, so that walks run through edges and corners.
LatticePolyhedron lumpy(int segments, std::int32_t grid) {
    const mesh::Mesh ball = faceted_ball(1, segments);
    LatticePolyhedron polyhedron;
    for (const Vec3& v : ball.vertices) {
        std::array<std::int32_t, 3> p{};
        for (int a = 0; a < 3; ++a)
            p[static_cast<std::size_t>(a)] =
                static_cast<std::int32_t>(std::lround(v[a] * 20)) * grid + exact::universe_side / 2;
        polyhedron.points.push_back(p);
    }
    polyhedron.triangles = ball.triangles;
    return polyhedron;
}

/// The winding number by solid angles, in long double, of a point at odd doubled coordinates.
int winding_about(const LatticePolyhedron& polyhedron, const std::array<std::int64_t, 3>& doubled) {
    long double sum = 0;
    for (const mesh::Triangle& t : polyhedron.triangles) {
        long double v[3][3], l[3];
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t a = 0; a < 3; ++a)
                v[i][a] = static_cast<long double>(polyhedron.points[t[i]][a]) - doubled[a] / 2.0L;
            l[i] = std::sqrt(v[i][0] * v[i][0] + v[i][1] * v[i][1] + v[i][2] * v[i][2]);
        }
        const auto dot3 = [&](int i, int j) {
            return v[i][0] * v[j][0] + v[i][1] * v[j][1] + v[i][2] * v[j][2];
        };
        const long double det = v[0][0] * (v[1][1] * v[2][2] - v[1][2] * v[2][1]) -
                                v[0][1] * (v[1][0] * v[2][2] - v[1][2] * v[2][0]) +
                                v[0][2] * (v[1][0] * v[2][1] - v[1][1] * v[2][0]);
        sum +=
            std::atan2(det, l[0] * l[1] * l[2] + dot3(0, 1) * l[2] + dot3(1, 2) * l[0] + dot3(2, 0) * l[1]);
    }
    return static_cast<int>(std::lround(sum / (2 * std::acos(-1.0L))));
}

TEST(LatticePolyhedron, WindingNumbersFollowTheWalks) {
    for (const int segments : {4, 6, 9}) {
        const LatticePolyhedron polyhedron = lumpy(segments, 1 << 20);
        std::vector<std::uint32_t> all(polyhedron.triangles.size());
        for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
        struct Task {
            octree::Cell cell;
            std::int32_t winding;
            std::vector<std::uint32_t> triangles;
        };
        std::vector<Task> tasks{{octree::Cell::root(), polyhedron.winding_of_universe(), all}};
        int checked = 0;
        while (!tasks.empty()) {
            const Task task = tasks.back();
            tasks.pop_back();
            const std::array<std::int32_t, 8> windings =
                polyhedron.windings(task.cell, task.winding, task.triangles.data(), task.triangles.size());
            for (int octant = 0; octant < 8; ++octant) {
                const octree::Cell child = task.cell.child(octant);
                std::vector<std::uint32_t> inside;
                for (const std::uint32_t t : task.triangles)
                    if (polyhedron.octants_met(t, task.cell) >> octant & 1) inside.push_back(t);
                if (inside.empty()) {
                    // Off the surface the number is that of any point of the octant.
                    std::array<std::int64_t, 3> reference{};
                    for (int a = 0; a < 3; ++a)
                        reference[static_cast<std::size_t>(a)] =
                            2 * std::int64_t{child.low[a]} + child.side() + 1;
                    ++checked;
                    ASSERT_EQ(windings[static_cast<std::size_t>(octant)],
                              winding_about(polyhedron, reference));
                } else if (child.level < 5) {
                    tasks.push_back({child, windings[static_cast<std::size_t>(octant)], inside});
                }
            }
        }
        EXPECT_GT(checked, 200);
    }
}

}  // namespace
}  // namespace octavo::csg
