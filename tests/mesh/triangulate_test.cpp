// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include <octavo/mesh/shapes.hpp>
#include <octavo/mesh/transform.hpp>
#include <octavo/mesh/triangulate.hpp>

#include "unlimited.hpp"

namespace octavo::mesh {
namespace {

using octavo::tests::Rational;

struct Face {
    std::vector<Vec3> vertices;
    std::vector<VertexIndex> corners;
    std::vector<std::uint32_t> contour_begin{0};

    void add(const std::vector<Point2D>& contour) {
        for (const Point2D& p : contour) {
            corners.push_back(static_cast<VertexIndex>(vertices.size()));
            vertices.push_back({p.x, p.y, 0});
        }
        contour_begin.push_back(static_cast<std::uint32_t>(corners.size()));
    }
    Triangulation triangulated(Triangulator& triangulator) const {
        return triangulator(vertices, corners, contour_begin);
    }
};

Rational cross_of(Vec3 a, Vec3 b, Vec3 c) {
    const Rational ax(a.x), ay(a.y);
    return (Rational(b.x) - ax) * (Rational(c.y) - ay) - (Rational(b.y) - ay) * (Rational(c.x) - ax);
}

/// Every edge of the contours is a side of exactly one triangle, in its direction when `forward`, and all
/// other sides cancel.
void expect_edges_used_once(const Face& face, std::span<const Triangle> triangles) {
    std::map<std::pair<VertexIndex, VertexIndex>, int> balance;
    for (const Triangle& t : triangles)
        for (int k = 0; k < 3; ++k) {
            const VertexIndex a = t[k], b = t[(k + 1) % 3];
            balance[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
        }
    for (std::size_t c = 0; c + 1 < face.contour_begin.size(); ++c) {
        const std::uint32_t begin = face.contour_begin[c], end = face.contour_begin[c + 1];
        for (std::uint32_t i = begin; i < end; ++i) {
            const VertexIndex a = face.corners[i], b = face.corners[i + 1 == end ? begin : i + 1];
            if (a != b) balance[{std::min(a, b), std::max(a, b)}] -= a < b ? 1 : -1;
        }
    }
    for (const auto& [edge, count] : balance)
        EXPECT_EQ(count, 0) << "edge " << edge.first << "-" << edge.second;
}

/// The triangulation of a simple polygon: no triangle is turned over or flat, their areas add up exactly to
/// the polygon's, and the edges match. Together that proves it.
void expect_proper(const Face& face) {
    Triangulator triangulator;
    const Triangulation result = face.triangulated(triangulator);
    EXPECT_EQ(result.shape, PolygonShape::simple);
    Rational area = 0, polygon = 0;
    for (const Triangle& t : result.triangles) {
        const Rational twice = cross_of(face.vertices[t[0]], face.vertices[t[1]], face.vertices[t[2]]);
        EXPECT_GT(twice, 0);
        area += twice;
    }
    for (std::size_t c = 0; c + 1 < face.contour_begin.size(); ++c) {
        const std::uint32_t begin = face.contour_begin[c], end = face.contour_begin[c + 1];
        for (std::uint32_t i = begin; i < end; ++i)
            polygon += cross_of({}, face.vertices[face.corners[i]],
                                face.vertices[face.corners[i + 1 == end ? begin : i + 1]]);
    }
    EXPECT_EQ(area, polygon);
    EXPECT_EQ(result.triangles.size(), face.corners.size() - 2 + 2 * (face.contour_begin.size() - 2));
    expect_edges_used_once(face, result.triangles);
}

Face with_contours(std::initializer_list<std::vector<Point2D>> contours) {
    Face face;
    for (const auto& contour : contours) face.add(contour);
    return face;
}

std::vector<Point2D> reversed(std::vector<Point2D> contour) {
    std::reverse(contour.begin(), contour.end());
    return contour;
}

/// A polygon seen whole from the origin, on a small integer grid so that collinear corners are common.
std::vector<Point2D> random_star(std::mt19937& random, int corners, int radius) {
    std::uniform_int_distribution<int> coordinate(-radius, radius);
    std::map<std::pair<double, int>, Point2D> by_angle;
    for (int i = 0; i < corners; ++i) {
        const Point2D p{static_cast<double>(coordinate(random)), static_cast<double>(coordinate(random))};
        if (p.x == 0 && p.y == 0) continue;
        by_angle[{std::atan2(p.y, p.x), 0}] = p;  // one corner a direction
    }
    std::vector<Point2D> star;
    for (const auto& [angle, p] : by_angle) star.push_back(p);
    return star;
}

TEST(Triangulate, KeepsTrianglesAndFansConvexQuads) {
    Triangulator triangulator;
    const std::vector<Vec3> v{{0, 0, 0}, {1, 0, 0}, {1, 1, 0.2}, {0, 1, 0}};
    const auto triangle = triangulator(v, std::vector<VertexIndex>{2, 0, 1});
    EXPECT_EQ(triangle.triangles[0], (Triangle{2, 0, 1}));
    const auto quad = triangulator(v, std::vector<VertexIndex>{1, 2, 3, 0});
    ASSERT_EQ(quad.triangles.size(), 2u);
    EXPECT_EQ(quad.triangles[0], (Triangle{1, 2, 3}));
    EXPECT_EQ(quad.triangles[1], (Triangle{1, 3, 0}));
}

TEST(Triangulate, CutsAConcaveQuadAtItsReflexCorner) {
    expect_proper(with_contours({{{0, 0}, {4, 0}, {1, 1}, {0, 4}}}));
    expect_proper(with_contours({{{4, 0}, {1, 1}, {0, 4}, {0, 0}}}));
}

TEST(Triangulate, UsesEveryCollinearCorner) {
    expect_proper(
        with_contours({{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 1}, {3, 2}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}}));
    expect_proper(with_contours({{{0, 0}, {2, 0}, {4, 0}, {0, 4}}}));
    expect_proper(with_contours({{{0, 0}, {4, 0}, {2, 2}, {0, 4}}}));
}

TEST(Triangulate, CoversRandomStarsExactly) {
    std::mt19937 random(11);
    for (int round = 0; round < 400; ++round) {
        Face face;
        face.add(random_star(random, 4 + round % 120, 2 + round % 50));
        double area = 0;
        for (std::size_t i = 0; i < face.vertices.size(); ++i)
            area += cross(face.vertices[i], face.vertices[(i + 1) % face.vertices.size()]).z;
        // The origin must be inside, or the corners in order of angle may cross.
        bool around = face.vertices.size() >= 3;
        for (std::size_t i = 0; i < face.vertices.size(); ++i)
            around = around && cross(face.vertices[i], face.vertices[(i + 1) % face.vertices.size()]).z > 0;
        if (around && area > 0) expect_proper(face);
    }
}

TEST(Triangulate, CoversPolygonsWithHolesEitherWayRound) {
    const std::vector<Point2D> outer{{0, 0}, {10, 0}, {10, 10}, {0, 10}};
    const std::vector<Point2D> hole{{2, 2}, {4, 2}, {4, 4}, {2, 4}};
    expect_proper(with_contours({outer, reversed(hole)}));
    Triangulator triangulator;
    const Face same_way = with_contours({outer, hole});
    const Triangulation result = same_way.triangulated(triangulator);
    EXPECT_EQ(result.shape, PolygonShape::simple);
    Rational area = 0;
    for (const Triangle& t : result.triangles)
        area += cross_of(same_way.vertices[t[0]], same_way.vertices[t[1]], same_way.vertices[t[2]]);
    EXPECT_EQ(area, 2 * (100 - 4));
}

TEST(Triangulate, CoversManyHolesInRowsAndColumns) {
    // Bridges run along rows of holes whose leftmost corners share heights: the degenerate case of ray
    // casting.
    for (const int shift : {0, 1, 2}) {
        Face face = with_contours({{{0, 0}, {60, 0}, {60, 60}, {0, 60}}});
        for (int i = 0; i < 9; ++i)
            for (int j = 0; j < 9; ++j) {
                const double x = 4 + 6 * i + (j % 2) * shift, y = 4 + 6 * j;
                if ((i + j) % 3 == 0)
                    face.add({{x, y}, {x, y + 3}, {x + 3, y + 3}, {x + 3, y}});
                else
                    face.add({{x, y + 1}, {x + 1, y + 3}, {x + 3, y + 2}, {x + 2, y}});
            }
        expect_proper(face);
    }
}

TEST(Triangulate, CoversRandomHolesInRandomStars) {
    std::mt19937 random(12);
    int covered = 0;
    for (int round = 0; round < 300; ++round) {
        Face face = with_contours({{{-1, -1}, {101, -1}, {101, 101}, {-1, 101}}});
        // One small random star in each cell of a grid, some cells empty.
        for (int i = 0; i < 5; ++i)
            for (int j = 0; j < 5; ++j) {
                std::vector<Point2D> star = random_star(random, 3 + round % 9, 8);
                bool around = star.size() >= 3;
                for (std::size_t k = 0; k < star.size(); ++k) {
                    const Point2D p = star[k], q = star[(k + 1) % star.size()];
                    around = around && p.x * q.y - p.y * q.x > 0;
                }
                if (!around) continue;
                for (Point2D& p : star) p = {p.x + 20 * i + 10, p.y + 20 * j + 10};
                face.add(reversed(star));
                ++covered;
            }
        expect_proper(face);
    }
    EXPECT_GT(covered, 300);
}

TEST(Triangulate, CoversAPolygonWhoseHoleIsAlreadyBridged) {
    // A keyhole, as exporters without holes write it: the bridge's vertices are named twice.
    Face face;
    face.vertices = {{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}, {3, 3, 0}, {3, 6, 0}, {6, 6, 0}, {6, 3, 0}};
    face.corners = {0, 1, 2, 3, 0, 4, 5, 6, 7, 4};
    face.contour_begin = {0, 10};
    Triangulator triangulator;
    const Triangulation result = face.triangulated(triangulator);
    EXPECT_EQ(result.shape, PolygonShape::simple);
    Rational area = 0;
    for (const Triangle& t : result.triangles) {
        EXPECT_GT(cross_of(face.vertices[t[0]], face.vertices[t[1]], face.vertices[t[2]]), 0);
        area += cross_of(face.vertices[t[0]], face.vertices[t[1]], face.vertices[t[2]]);
    }
    EXPECT_EQ(area, 2 * (81 - 9));
    expect_edges_used_once(face, result.triangles);
}

TEST(Triangulate, CoversAnOutlineThatIsPinchedToAPoint) {
    Face face = with_contours({{{0, 0}, {2, 2}, {4, 0}, {4, 4}, {2, 2}, {0, 4}}});
    for (const bool one_vertex : {false, true}) {
        if (one_vertex) face.corners[4] = face.corners[1];
        Triangulator triangulator;
        const Triangulation result = face.triangulated(triangulator);
        EXPECT_EQ(result.shape, one_vertex ? PolygonShape::simple : PolygonShape::degenerate);
        EXPECT_EQ(result.triangles.size(), one_vertex ? 2u : 4u);
        Rational area = 0;
        for (const Triangle& t : result.triangles) {
            const Rational twice = cross_of(face.vertices[t[0]], face.vertices[t[1]], face.vertices[t[2]]);
            EXPECT_GE(twice, 0);
            area += twice;
        }
        EXPECT_EQ(area, 16);
        expect_edges_used_once(face, result.triangles);
    }
}

TEST(Triangulate, TakesWarpedPolygonsAlongTheBestAxis) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> wobble(-0.05, 0.05);
    for (const Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{1, 2, 3}, Vec3{-3, 1, -1}}) {
        Face face;
        face.add(circle(5, 40));
        for (std::size_t i = 0; i < 40; i += 2) face.vertices[i] = 0.5 * face.vertices[i];
        for (Vec3& v : face.vertices) v.z = wobble(random), v = rotation(axis, 107)(v);
        Triangulator triangulator;
        const Triangulation result = face.triangulated(triangulator);
        EXPECT_EQ(result.shape, PolygonShape::simple);
        EXPECT_EQ(result.triangles.size(), 38u);
        expect_edges_used_once(face, result.triangles);
        // All facets look the same way.
        Vec3 normal = rotation(axis, 107)(Vec3{0, 0, 1});
        for (const Triangle& t : result.triangles)
            EXPECT_GT(dot(normal, cross(face.vertices[t[1]] - face.vertices[t[0]],
                                        face.vertices[t[2]] - face.vertices[t[0]])),
                      0);
    }
}

TEST(Triangulate, TellsDegenerateAndCrossingPolygonsAndStillUsesTheirEdges) {
    Triangulator triangulator;
    const auto shape_of = [&](const Face& face) {
        const Triangulation result = face.triangulated(triangulator);
        expect_edges_used_once(face, result.triangles);
        return result.shape;
    };
    EXPECT_EQ(shape_of(with_contours({{{0, 0}, {1, 0}, {2, 0}, {3, 0}}})), PolygonShape::degenerate);
    EXPECT_EQ(shape_of(with_contours({{{1, 1}, {1, 1}, {1, 1}, {1, 1}, {1, 1}}})), PolygonShape::degenerate);
    EXPECT_EQ(shape_of(with_contours({{{0, 0}, {4, 0}, {6, 0}, {4, 0}, {4, 4}, {0, 4}}})),
              PolygonShape::degenerate);
    EXPECT_EQ(shape_of(with_contours({{{0, 0}, {4, 0}, {4, 0}, {4, 4}, {0, 4}}})), PolygonShape::degenerate);
    EXPECT_EQ(shape_of(with_contours({{{0, 0}, {4, 4}, {4, 0}, {1, 5}, {0, 4}}})), PolygonShape::crossing);
    EXPECT_EQ(shape_of(with_contours({{{0, 0}, {NAN, 4}, {4, 0}, {1, 5}}})), PolygonShape::crossing);
    EXPECT_EQ(shape_of(with_contours({{{0, 0}, {1, 0}}})), PolygonShape::degenerate);
}

TEST(Triangulate, SurvivesRandomGarbage) {
    std::mt19937 random(6);
    std::uniform_int_distribution<int> coordinate(0, 4), corners(3, 14), contours(1, 3);
    Triangulator triangulator;
    for (int round = 0; round < 5000; ++round) {
        Face face;
        for (int c = contours(random); c > 0; --c) {
            std::vector<Point2D> contour;
            for (int i = corners(random); i > 0; --i)
                contour.push_back(
                    {static_cast<double>(coordinate(random)), static_cast<double>(coordinate(random))});
            face.add(contour);
        }
        const Triangulation result = face.triangulated(triangulator);
        EXPECT_LE(result.triangles.size(), face.corners.size() - 2 + 2 * (face.contour_begin.size() - 2));
        // Which way a hole runs that crosses itself is anybody's guess, so only outlines are checked.
        if (face.contour_begin.size() == 2) expect_edges_used_once(face, result.triangles);
    }
}

TEST(Triangulate, IsExactAtTheEdgesOfTheDoubles) {
    // Corners one unit in the last place off a line, far from the origin, tiny and huge.
    for (const double unit : {1.0, 0x1p-1000, 0x1p900}) {
        const double x = 0x1p52;
        Face face = with_contours({{{x, x}, {x + 2, x + 1}, {x + 4, x + 2}, {x + 6, x + 4}, {x + 3, x + 2}}});
        for (Vec3& v : face.vertices) v = unit * v;
        Triangulator triangulator;
        const Triangulation result = face.triangulated(triangulator);
        EXPECT_EQ(result.shape, PolygonShape::simple) << unit;
        for (const Triangle& t : result.triangles)
            EXPECT_GT(cross_of(face.vertices[t[0]], face.vertices[t[1]], face.vertices[t[2]]), 0);
    }
}

TEST(Triangulate, DoesNotTakeQuadraticTime) {
    // Deterministic work, not time: the suite's timeout would catch minutes. A comb, a spiral, a rough disc.
    const int n = 100000;
    std::vector<Point2D> comb, disc;
    for (int i = 0; i < n / 2; ++i) comb.push_back({i + 0.0, i % 2 ? 0.5 : 1000.0});
    comb.push_back({n / 2.0, -1}), comb.push_back({-1, -1});
    std::reverse(comb.begin(), comb.end());
    std::mt19937 random(8);
    std::uniform_real_distribution<double> radius(0.5, 1);
    for (int i = 0; i < n; ++i) {
        const double angle = 2 * std::numbers::pi * i / n, r = radius(random);
        disc.push_back({r * std::cos(angle), r * std::sin(angle)});
    }
    std::vector<Point2D> spiral;
    for (int i = 0; i < n / 2; ++i) {
        const double angle = 0.01 * i;
        spiral.push_back({(1 + angle) * std::cos(angle), (1 + angle) * std::sin(angle)});
    }
    for (int i = n / 2; i-- > 0;) {
        const double angle = 0.01 * i;
        spiral.push_back({(0.5 + angle) * std::cos(angle), (0.5 + angle) * std::sin(angle)});
    }
    std::reverse(spiral.begin(), spiral.end());
    // Spikes down to near the centre: triangles are long and thin, and blocked from afar.
    std::vector<Point2D> spikes;
    std::uniform_real_distribution<double> any_radius(0.01, 1);
    for (int i = 0; i < n; ++i) {
        const double angle = 2 * std::numbers::pi * i / n, r = any_radius(random);
        spikes.push_back({r * std::cos(angle), r * std::sin(angle)});
    }
    // A rack at an angle, with gaps between its teeth that lie on one line.
    std::vector<Point2D> rack{{3, -4}, {n * 4 + 3, n * 3 - 4}};
    for (int i = n / 4; i-- > 0;)
        for (const auto& [x, y] :
             {Point2D{4.0 * i + 3, 0}, {4.0 * i + 3, 1e3}, {4.0 * i + 2, 1e3}, {4.0 * i + 2, 0}})
            rack.push_back({4 * x - 3 * y, 3 * x + 4 * y});
    for (const auto* contour : {&comb, &disc, &spiral, &spikes, &rack}) {
        Face face;
        face.add(*contour);
        Triangulator triangulator;
        const Triangulation result = face.triangulated(triangulator);
        EXPECT_EQ(result.shape, PolygonShape::simple);
        EXPECT_EQ(result.triangles.size(), face.corners.size() - 2);
    }
}

TEST(Triangulate, DoesNotTakeQuadraticTimeForManyHoles) {
    constexpr int side = 150;
    Face face;
    face.add({{-1, -1}, {side, -1}, {side, side}, {-1, side}});
    for (int i = 0; i < side; ++i)
        for (int j = 0; j < side; ++j)
            face.add({{i + 0.0, j + 0.0}, {i + 0.0, j + 0.5}, {i + 0.5, j + 0.5}, {i + 0.5, j + 0.0}});
    expect_proper(face);
}

TEST(Triangulate, DoesNotTakeQuadraticTimeForWhatIsNoPolygon) {
    const int n = 100000;
    std::vector<Point2D> there_and_back, garbage, twice;
    std::mt19937 random(9);
    std::uniform_real_distribution<double> anywhere(0, 1);
    for (int i = 0; i < n; ++i) {
        there_and_back.push_back({static_cast<double>(std::min(i, n - i)), 0});
        garbage.push_back({anywhere(random), anywhere(random)});
        const double angle = 2 * std::numbers::pi * (i / 2) / (n / 2);
        twice.push_back({std::cos(angle), std::sin(angle)});
    }
    for (const auto& [contour, shape] : {std::pair{&there_and_back, PolygonShape::degenerate},
                                         {&garbage, PolygonShape::crossing},
                                         {&twice, PolygonShape::degenerate}}) {
        Face face;
        face.add(*contour);
        Triangulator triangulator;
        const Triangulation result = face.triangulated(triangulator);
        EXPECT_EQ(result.shape, shape);
        expect_edges_used_once(face, result.triangles);
    }
}

TEST(Triangulate, StopsSoonWhenCancelled) {
    Face face;
    std::vector<Point2D> disc;
    for (int i = 0; i < 100000; ++i) disc.push_back({std::cos(i * 6e-5), std::sin(i * 6e-5)});
    face.add(disc);
    std::atomic<bool> cancel{true};
    Context context;
    context.cancel = &cancel;
    Triangulator triangulator(context);
    EXPECT_LT(face.triangulated(triangulator).triangles.size(), 10000u);
    cancel = false;
    EXPECT_EQ(face.triangulated(triangulator).triangles.size(), disc.size() - 2);
}

TEST(Triangulate, MakesAClosedMeshOfAClosedPolygonMesh) {
    // A box with a square hole through it: two faces with holes, eight without.
    PolygonMesh polygons;
    polygons.vertices = {{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}, {1, 1, 0}, {2, 1, 0},
                         {2, 2, 0}, {1, 2, 0}, {0, 0, 1}, {3, 0, 1}, {3, 3, 1}, {0, 3, 1},
                         {1, 1, 1}, {2, 1, 1}, {2, 2, 1}, {1, 2, 1}};
    const auto contour = [&](std::initializer_list<VertexIndex> corners) {
        polygons.corners.insert(polygons.corners.end(), corners);
        polygons.contour_begin.push_back(static_cast<std::uint32_t>(polygons.corners.size()));
    };
    const auto end_face = [&] {
        polygons.face_begin.push_back(static_cast<std::uint32_t>(polygons.contour_begin.size() - 1));
    };
    contour({0, 3, 2, 1}), contour({4, 5, 6, 7}), end_face();
    contour({8, 9, 10, 11}), contour({12, 15, 14, 13}), end_face();
    for (VertexIndex i = 0; i < 4; ++i) {
        const VertexIndex j = (i + 1) % 4;
        contour({i, j, j + 8, i + 8}), end_face();
        contour({i + 4, i + 12, j + 12, j + 4}), end_face();
    }
    const TriangulatedMesh result = triangulate(polygons);
    EXPECT_TRUE(result.degenerate.empty());
    EXPECT_TRUE(result.crossing.empty());
    EXPECT_EQ(result.mesh.triangles.size(), 8u + 8 + 16);
    EXPECT_EQ(result.mesh.sources.back(), (Source{0, 9}));
    std::map<std::pair<VertexIndex, VertexIndex>, int> balance;
    for (const Triangle& t : result.mesh.triangles)
        for (int k = 0; k < 3; ++k) ++balance[{t[k], t[(k + 1) % 3]}], --balance[{t[(k + 1) % 3], t[k]}];
    for (const auto& [edge, count] : balance) EXPECT_EQ(count, 0);
}

TEST(Orient2d, AgreesWithRationals) {
    std::mt19937_64 random(9);
    std::uniform_int_distribution<int> small(-3, 3);
    std::uniform_real_distribution<double> real(-1, 1);
    for (int round = 0; round < 100000; ++round) {
        const double x = real(random), y = real(random), dx = real(random), dy = real(random);
        const auto nudged = [&](double v) { return v + small(random) * std::ldexp(std::fabs(v), -52); };
        const Point2 a{x, y}, b{nudged(x + dx), nudged(y + dy)}, c{nudged(x + 2 * dx), nudged(y + 2 * dy)};
        const Rational exact = cross_of({a.x, a.y, 0}, {b.x, b.y, 0}, {c.x, c.y, 0});
        ASSERT_EQ(orient2d(a, b, c), exact.sign());
        ASSERT_EQ(orient2d_exact(a, b, c), exact.sign());
    }
}

}  // namespace
}  // namespace octavo::mesh
