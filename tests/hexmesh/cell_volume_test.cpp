// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <octavo/classic/crossing.hpp>
#include <octavo/exact/int128.hpp>
#include <octavo/hexmesh/cell_volume.hpp>

#include "unlimited.hpp"

namespace octavo::hexmesh {
namespace {

using exact::Point;
using octavo::tests::Rational;
using octree::Cell;
using RationalPoint = std::array<Rational, 3>;
using Face = std::vector<RationalPoint>;

/// The part of a closed convex polyhedron with sign · (coordinate − bound) ≥ 0, in exact rationals.
std::vector<Face> cut(const std::vector<Face>& faces, std::size_t axis, const Rational& bound, int sign) {
    std::vector<Face> result;
    std::vector<RationalPoint> cap;
    const auto above = [&](const RationalPoint& p) -> Rational { return sign * (p[axis] - bound); };
    for (const Face& face : faces) {
        Face kept;
        for (std::size_t i = 0; i < face.size(); ++i) {
            const RationalPoint &a = face[i], &b = face[(i + 1) % face.size()];
            const Rational da = above(a), db = above(b);
            if (da >= 0) kept.push_back(a);
            if (da == 0) cap.push_back(a);
            if ((da < 0 && db > 0) || (da > 0 && db < 0)) {
                RationalPoint p;
                for (std::size_t k = 0; k < 3; ++k) p[k] = a[k] + da / (da - db) * (b[k] - a[k]);
                kept.push_back(p);
                cap.push_back(p);
            }
        }
        if (kept.size() >= 3) result.push_back(kept);
    }
    // The volume below is summed from a point of the cap, so that the cap itself need not be built.
    if (!cap.empty()) result.push_back({cap[0]});
    return result;
}

/// Volume by tetrahedra from `apex`, which must lie on every cap that is missing.
Rational volume_from(const std::vector<Face>& faces, const RationalPoint& apex) {
    Rational six = 0;
    for (const Face& face : faces)
        for (std::size_t i = 2; i < face.size(); ++i) {
            std::array<RationalPoint, 3> e;
            for (std::size_t k = 0; k < 3; ++k)
                e[0][k] = face[0][k] - apex[k], e[1][k] = face[i - 1][k] - apex[k],
                e[2][k] = face[i][k] - apex[k];
            six += e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
                   e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
                   e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
        }
    return six / 6;
}

/// Volume of tetrahedron ∩ {low ≤ p ≤ high}: the tetrahedron is the union of signed cones, so inclusion of orthants
/// gives a box: V[low, high] = Σ ± V(orthant), and an orthant's three caps share their corner as apex.
Rational volume_in_orthant(const std::array<Point, 4>& tetrahedron,
                           const std::array<std::int64_t, 3>& corner) {
    constexpr std::array<std::array<std::size_t, 3>, 4> sides{{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
    std::vector<Face> faces;
    for (const auto& side : sides) {
        Face face;
        for (const std::size_t v : side)
            face.push_back({tetrahedron[v].x, tetrahedron[v].y, tetrahedron[v].z});
        faces.push_back(face);
    }
    RationalPoint apex;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        apex[axis] = corner[axis];
        faces = cut(faces, axis, Rational(corner[axis]), 1);
    }
    return volume_from(faces, apex);
}

double expected_part(const std::array<Point, 4>& tetrahedron, const Cell& cell) {
    Rational volume = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const Point low = cell.low, high = cell.high();
        const std::array<std::int64_t, 3> at{corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y,
                                             corner & 4 ? high.z : low.z};
        const Rational part = volume_in_orthant(tetrahedron, at);
        if (std::popcount(static_cast<unsigned>(corner)) % 2)
            volume -= part;
        else
            volume += part;
    }
    const Rational side = cell.side();
    return static_cast<double>(Rational(volume / (side * side * side)));
}

/// The facets that meet the open cell: those with a part of positive area when clipped to it, in exact rationals, that
/// does not lie in a wall.
std::vector<std::uint32_t> met_by(const Cell& cell, const std::vector<classic::Facet>& facets) {
    std::vector<std::uint32_t> met;
    for (std::uint32_t i = 0; i < facets.size(); ++i) {
        Face face;
        for (const auto& corner : facets[i].corner) face.push_back({corner[0], corner[1], corner[2]});
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<int>(axis);
            for (const auto& [bound, sign] : {std::pair(cell.low[a], 1), std::pair(cell.high()[a], -1)}) {
                std::vector<Face> clipped = cut({face}, axis, bound, sign);
                if (!clipped.empty() && clipped.back().size() == 1) clipped.pop_back();
                face = clipped.empty() ? Face{} : clipped[0];
            }
        }
        // A convex piece meets the open cell when the mean of its corners does.
        RationalPoint sum{};
        for (const RationalPoint& p : face)
            for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += p[axis];
        const Rational count(face.size());
        bool inside = !face.empty();
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<int>(axis);
            inside = inside && sum[axis] > count * cell.low[a] && sum[axis] < count * cell.high()[a];
        }
        if (inside) met.push_back(i);
    }
    return met;
}

/// The winding number of the displaced low corner, by stepping there from beyond the universe.
int winding_at(const std::vector<classic::Facet>& facets, Point p) {
    int winding = 0;
    for (const classic::Facet& facet : facets)
        winding += classic::crossing(facet, {-1, p.y, p.z}, 0, p.x + 1);
    return winding;
}

exact::int128 volume6(const std::array<Point, 4>& t) {
    const auto d = [&](std::size_t i, int axis) { return exact::wide(t[i][axis]) - t[0][axis]; };
    return d(1, 0) * (d(2, 1) * d(3, 2) - d(2, 2) * d(3, 1)) -
           d(1, 1) * (d(2, 0) * d(3, 2) - d(2, 2) * d(3, 0)) +
           d(1, 2) * (d(2, 0) * d(3, 1) - d(2, 1) * d(3, 0));
}

std::vector<classic::Facet> facets_of_tetrahedron(const std::array<Point, 4>& t) {
    mesh::LatticeMesh mesh;
    mesh.points.assign(t.begin(), t.end());
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    return *classic::facets_of(mesh);
}

/// Coordinates of a coarse grid, so that corners, edges and facets lie in walls and edges of cells all the time.
TEST(FilledPart, IsTheExactPartOfTetrahedraOnTheWallsOfCells) {
    std::mt19937 random(1);
    constexpr std::int32_t step = 32;
    int partly = 0;
    for (int round = 0; round < 800; ++round) {
        std::array<Point, 4> t;
        const auto coordinate = [&] {
            return static_cast<std::int32_t>(random() % 9) * step / (1 + round % 2);
        };
        for (Point& p : t) p = {coordinate(), coordinate(), coordinate()};
        if (volume6(t) == 0) continue;
        if (volume6(t) < 0) std::swap(t[0], t[1]);
        const std::vector<classic::Facet> facets = facets_of_tetrahedron(t);
        const int level = octree::max_level - 2 + round % 2;
        const std::int32_t side = octree::cell_side(level);
        const Cell cell{
            {static_cast<std::int32_t>(random() % 3) * side, static_cast<std::int32_t>(random() % 3) * side,
             static_cast<std::int32_t>(random() % 3) * side},
            level};
        const double expected = expected_part(t, cell);
        partly += expected > 0 && expected < 1;
        const std::vector<std::uint32_t> list = met_by(cell, facets);
        ASSERT_NEAR(filled_part(facets, list, cell, winding_at(facets, cell.low)), expected, 1e-13) << round;
    }
    EXPECT_GT(partly, 130);
}

TEST(FilledPart, IsTheExactPartOfTetrahedraInGeneralPosition) {
    std::mt19937 random(2);
    for (int round = 0; round < 400; ++round) {
        std::uniform_int_distribution<std::int32_t> place(0, round % 2 ? 3000 : exact::universe_side - 1);
        std::array<Point, 4> t;
        for (Point& p : t) p = {place(random), place(random), place(random)};
        const std::vector<classic::Facet> forwards = facets_of_tetrahedron(t);
        const int level = round % 2 ? octree::max_level - 5 : 3;
        const Cell cell =
            octree::Cell::of(octree::CellKey::at({place(random), place(random), place(random)}, level));
        const double part =
            filled_part(forwards, met_by(cell, forwards), cell, winding_at(forwards, cell.low));
        // A tetrahedron inside out counts negatively.
        ASSERT_NEAR(part, expected_part(t, cell), 1e-11) << round;
    }
}

/// Facets many times larger than the cell, so that each is nearly always alone; thin slopes included.
TEST(FilledPart, IsTheExactPartBehindASingleFacet) {
    std::mt19937 random(3);
    int alone = 0;
    for (int round = 0; round < 320; ++round) {
        constexpr std::int32_t middle = exact::universe_side / 2;
        const int level = 4 + round % 16;
        const std::int32_t side = octree::cell_side(level);
        // Three corners whose plane passes near the cell, at slopes from 1 to 2^−24, and an apex behind them.
        std::uniform_int_distribution<std::int32_t> small(-(side >> random() % 8) - 1,
                                                          (side >> random() % 8) + 1);
        const std::int32_t far = std::min(middle / 2, 64 * side);
        std::array<Point, 4> t{{{middle - far, middle - far, middle + small(random)},
                                {middle + far, middle - far + small(random), middle + small(random)},
                                {middle + small(random), middle + far, middle + small(random)},
                                {middle, middle, random() % 2 ? middle - far : middle + far}}};
        const auto turn = random() % 3;
        for (Point& p : t) p = turn == 0 ? p : turn == 1 ? Point{p.y, p.z, p.x} : Point{p.z, p.x, p.y};
        if (volume6(t) == 0) continue;
        if (volume6(t) < 0) std::swap(t[0], t[1]);
        const std::vector<classic::Facet> facets = facets_of_tetrahedron(t);
        const Cell cell =
            octree::Cell::of(octree::CellKey::at({middle - static_cast<std::int32_t>(random() % 2),
                                                  middle - static_cast<std::int32_t>(random() % 2),
                                                  middle - static_cast<std::int32_t>(random() % 2)},
                                                 level));
        const std::vector<std::uint32_t> list = met_by(cell, facets);
        alone += list.size() == 1;
        ASSERT_NEAR(filled_part(facets, list, cell, winding_at(facets, cell.low)), expected_part(t, cell),
                    1e-14)
            << round;
    }
    EXPECT_GT(alone, 100);
}

}  // namespace
}  // namespace octavo::hexmesh
