// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <octavo/csg/convex_hull.hpp>
#include <octavo/csg/convex_pieces.hpp>
#include <octavo/csg/extrude.hpp>
#include <octavo/csg/revolve.hpp>
#include <octavo/csg/solid_mesh.hpp>
#include <octavo/csg/tessellate.hpp>

namespace octavo::csg {
namespace {

constexpr double pi = 3.14159265358979323846;

double volume(const mesh::Mesh& mesh) { return six_volumes(mesh) / 6; }

void expect_hull(const std::vector<Vec3>& points, const mesh::Mesh& hull) {
    EXPECT_TRUE(is_closed(hull));
    EXPECT_GT(volume(hull), 0);
    Box3 box;
    for (const Vec3& p : points) box.add(p);
    const double tolerance = length(box.extents()) * 0x1p-24;
    for (const mesh::Triangle& t : hull.triangles) {
        const Vec3 a = hull.vertices[t[0]];
        const Vec3 normal = cross(hull.vertices[t[1]] - a, hull.vertices[t[2]] - a);
        if (length(normal) < tolerance * tolerance) continue;
        for (const Vec3& p : points) ASSERT_LE(dot(normal, p - a), tolerance * length(normal) + 1e-12);
    }
}

Affine diagonal(double x, double y, double z) { return {{{{x, 0, 0, 0}, {0, y, 0, 0}, {0, 0, z, 0}}}}; }

TEST(Singular, IsWhatSqueezesSpaceFlatWhateverTheScale) {
    const Affine turn{{{{0.6, -0.8, 0, 0}, {0.48, 0.36, -0.8, 0}, {0.64, 0.48, 0.6, 0}}}};
    for (const double size : {1.0, 1e-120, 1e-300, 1e110, 1e300}) {
        EXPECT_FALSE(is_singular(diagonal(size, size, size))) << size;
        EXPECT_FALSE(is_singular(diagonal(size, -1, 1 / size))) << size;
        EXPECT_FALSE(is_singular(compose(turn, diagonal(size, size, size)))) << size;
        EXPECT_TRUE(is_singular(diagonal(size, size, 0))) << size;
        // Decimals that are singular, doubles that are nearly so.
        EXPECT_TRUE(is_singular({{{{0.1 * size, 0.2 * size, 0.3 * size, 0},
                                   {0.4 * size, 0.5 * size, 0.6 * size, 0},
                                   {0.7 * size, 0.8 * size, 0.9 * size, 0}}}}))
            << size;
    }
    EXPECT_TRUE(is_singular(compose(turn, compose(diagonal(1, 1, 1e-17), turn))));
    for (const double size : {1.0, 1e-60, 1e-200, 1e60, 1e200}) {
        const Affine scale = diagonal(size, size, size);
        EXPECT_FALSE(is_singular(compose(turn, compose(diagonal(1, 1, 1e-17), scale)))) << size;
        EXPECT_FALSE(is_singular(compose(turn, compose(diagonal(1e-30, 1e-30, 1), scale)))) << size;
        EXPECT_FALSE(is_singular(compose(diagonal(1e-30, 1e-30, 1), compose(turn, scale)))) << size;
    }
}

TEST(SolidMesh, KnowsOutsideAndConvexityWhateverTheScale) {
    // A cube with a dent in its top.
    mesh::Mesh dented = cuboid_mesh({-1, -1, -1}, {1, 1, 1});
    dented.triangles.erase(dented.triangles.begin() + 2, dented.triangles.begin() + 4);
    dented.vertices.push_back({0, 0, 0.5});
    for (const auto& [a, b] : {std::pair{4, 5}, {5, 7}, {7, 6}, {6, 4}})
        dented.triangles.push_back({static_cast<mesh::VertexIndex>(a), static_cast<mesh::VertexIndex>(b), 8});
    for (const double size : {1.0, 1e-90, 1e-290, 1e110, 1e270}) {
        mesh::Mesh scaled = dented;
        for (Vec3& vertex : scaled.vertices) vertex = size * vertex;
        EXPECT_EQ(volume_sign(scaled), 1) << size;
        EXPECT_EQ(as_polyhedron(scaled).convexity, Convexity::any) << size;
        for (mesh::Triangle& t : scaled.triangles) std::swap(t[1], t[2]);
        EXPECT_EQ(volume_sign(scaled), -1) << size;
        const mesh::Mesh cube = cuboid_mesh({-size, -size, -size}, {size, size, size});
        EXPECT_EQ(as_polyhedron(cube).convexity, Convexity::convex) << size;
        EXPECT_LT(area(transform(diagonal(-size, 1, 1), Region{{{{0, 0}, {0, 1}, {1, 0}}}})), 0)
            << "a hole stays a hole";
    }
}

TEST(ConvexHull, HoldsAllPointsWhateverTheirPosition) {
    std::mt19937_64 engine(5);
    const auto uniform = [&] { return static_cast<double>(engine() >> 11) * 0x1p-52 - 1; };
    for (int round = 0; round < 60; ++round) {
        std::vector<Vec3> points;
        for (int i = 4 + static_cast<int>(engine() % 200); i > 0; --i) switch (round % 3) {
                case 0:
                    points.push_back({uniform(), uniform(), uniform()});
                    break;
                case 1:  // a grid: most points are coplanar, many doubled
                    points.push_back(
                        {std::round(2 * uniform()), std::round(2 * uniform()), std::round(2 * uniform())});
                    break;
                default: {  // on a ball: all are corners
                    const Vec3 p{uniform(), uniform(), uniform()};
                    points.push_back((1 / length(p)) * p);
                }
            }
        if (const std::optional<mesh::Mesh> hull = convex_hull(points)) expect_hull(points, *hull);
    }
}

TEST(ConvexHull, IsFoundAtAnyScale) {
    const std::vector<Vec3> unit{{-1, -1, -1}, {1, -1, 0.5}, {0, 1, 0.25}, {0.5, 0.5, 1}, {0, 0, 0.125}};
    const Contour corners{{-1, -1}, {1, -1}, {0, 1}, {0.5, 0.5}, {0, 0}};
    for (const double size : {1.0, 0x1p-1060, 0x1p-990, 0x1p-600, 0x1p600, 0x1p1023}) {
        std::vector<Vec3> points;
        for (const Vec3& p : unit) points.push_back(size * p);
        const std::optional<mesh::Mesh> hull = convex_hull(points);
        ASSERT_TRUE(hull) << size;
        EXPECT_EQ(hull->vertices.size(), 4u) << size;
        Contour flat;
        for (const Vec2& p : corners) flat.push_back({size * p.x, size * p.y});
        const Region around = convex_hull(flat);
        ASSERT_EQ(around.contours.size(), 1u) << size;
        EXPECT_EQ(around.contours[0].size(), 4u) << size;
    }
}

TEST(ConvexHull, FlatAndSmallSetsHaveNone) {
    EXPECT_FALSE(convex_hull(std::vector<Vec3>{}));
    EXPECT_FALSE(convex_hull(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    EXPECT_FALSE(convex_hull(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {3, 4, 0}}));
    EXPECT_FALSE(convex_hull(std::vector<Vec3>{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}));
    EXPECT_TRUE(convex_hull(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1e-5}}));
}

TEST(Regions, AreMadeAtAnyScale) {
    const Contour square{{0, 0}, {2, 0}, {2, 2}, {0, 2}}, moved{{1, 1}, {3, 1}, {3, 3}, {1, 3}};
    for (const double size : {1.0, 0x1p-1060, 0x1p-990, 0x1p-600, 0x1p600, 0x1p1021}) {
        const auto scaled = [&](Contour contour) {
            for (Vec2& p : contour) p = {size * p.x, size * p.y};
            return contour;
        };
        const Region a = make_region({scaled(square)}, FillRule::even_odd),
                     b = make_region({scaled(moved)}, FillRule::non_zero);
        ASSERT_EQ(a.contours.size(), 1u) << size;
        EXPECT_EQ(a.contours[0].size(), 4u) << size;
        const Region both = unite(std::vector{a, b}), common = intersect(std::vector{a, b});
        ASSERT_EQ(both.contours.size(), 1u) << size;
        EXPECT_EQ(both.contours[0].size(), 8u) << size;
        EXPECT_EQ(bounds(both).high, (Vec3{3 * size, 3 * size, 0})) << size;
        EXPECT_EQ(bounds(common).low, (Vec3{size, size, 0})) << size;
        EXPECT_EQ(bounds(minkowski_sum(a, b)).high.x, 5 * size) << size;
    }
}

TEST(Regions, HolesAndIslandsKeepTheirAreas) {
    const auto square = [](double low, double high) {
        return Contour{{low, low}, {high, low}, {high, high}, {low, high}};
    };
    const Region nested =
        make_region({square(0, 10), square(1, 9), square(2, 8), square(3, 7)}, FillRule::even_odd);
    EXPECT_NEAR(area(nested), 100 - 64 + 36 - 16, 1e-9);
    const Region a = make_region({square(0, 4)}, FillRule::non_zero),
                 b = make_region({square(2, 6)}, FillRule::non_zero);
    EXPECT_NEAR(area(unite(std::vector{a, b})), 28, 1e-9);
    EXPECT_NEAR(area(intersect(std::vector{a, b})), 4, 1e-9);
    EXPECT_NEAR(area(subtract(std::vector{a, b})), 12, 1e-9);
    EXPECT_NEAR(area(unite(std::vector{nested, make_region({square(1.5, 1.7)}, FillRule::non_zero)})),
                100 - 64 + 36 - 16 + 0.04, 1e-9);
    EXPECT_NEAR(area(offset(a, 1)), 16 + 16 + pi, 0.03);
    EXPECT_TRUE(offset(a, -3).empty());
    // An extrusion has the area of its profile times its height, holes or not.
    LinearExtrude options;
    options.height = 2;
    const mesh::Mesh solid = linear_extrude(nested, options);
    EXPECT_TRUE(is_closed(solid));
    EXPECT_NEAR(volume(solid), 2 * area(nested), 1e-9);
}

TEST(Extrusions, AreClosedForAnyProfileTwistAndTaper) {
    std::mt19937_64 engine(9);
    const auto uniform = [&] { return static_cast<double>(engine() >> 11) * 0x1p-52 - 1; };
    for (int round = 0; round < 100; ++round) {
        std::vector<Contour> contours(1 + engine() % 3);
        for (Contour& contour : contours)
            for (int i = 3 + static_cast<int>(engine() % 8); i > 0; --i)
                contour.push_back({uniform() + 1.5, uniform()});
        const Region region = make_region(contours, FillRule::even_odd);  // crossing itself, with holes
        LinearExtrude options;
        options.twist = round % 2 ? 200 * uniform() : 0;
        options.slices = 1 + static_cast<int>(engine() % 6);
        options.scale = round % 3 ? Vec2{uniform() + 1, uniform() + 1} : Vec2{0, 0};
        EXPECT_TRUE(is_closed(linear_extrude(region, options)));
        const Result<mesh::Mesh> ring = rotate_extrude(region, {round % 2 ? 360 : 350 * uniform(), 7});
        ASSERT_TRUE(ring);
        EXPECT_TRUE(is_closed(*ring));
        EXPECT_GE(six_volumes(*ring), 0);
    }
}

TEST(Revolve, RoundBodiesAreTheLimitOfFacetedOnes) {
    const Region profile = make_region({{{1, 0}, {3, 0}, {2, 1}, {3, 2}, {1, 2}}}, FillRule::non_zero);
    EXPECT_TRUE(revolve(profile, 360));
    EXPECT_FALSE(revolve(make_region({{{-1, 0}, {1, 0}, {0, 1}}}, FillRule::non_zero)));
    // Membership around the axis: inside between the radii, outside elsewhere.
    const Result<mesh::Mesh> faceted = rotate_extrude(profile, {360, 3000});
    ASSERT_TRUE(faceted);
    // Pappus: 2π · centroid · area, the profile being a 2 × 2 square without a triangle of area 1 at x = 8/3.
    EXPECT_NEAR(volume(*faceted), 2 * pi * (4 * 2 - 1 * 8.0 / 3), 1e-3);
}

TEST(ConvexPieces, AddUpToTheSolid) {
    const auto total = [](const Expr& expression) {
        const Result<std::vector<ConvexPiece>> pieces = convex_pieces(expression);
        EXPECT_TRUE(pieces);
        double sum = 0;
        for (const ConvexPiece& piece : *pieces)
            for (const auto& face : piece.faces)
                for (std::size_t i = 1; i + 1 < face.size(); ++i)
                    sum += dot(piece.corners[face[0]],
                               cross(piece.corners[face[i]], piece.corners[face[i + 1]])) /
                           6;
        return sum;
    };
    const Expr cube(Cuboid{{0, 0, 0}, {4, 4, 4}}), hole(Cuboid{{1, 1, -1}, {3, 3, 5}});
    EXPECT_NEAR(total(cube), 64, 1e-9);
    EXPECT_NEAR(total(subtract({cube, hole})), 48, 1e-9);
    EXPECT_NEAR(total(intersect({cube, hole})), 16, 1e-9);
    // A mesh that is not convex: an L and a ring, by the BSP.
    LinearExtrude options;
    options.height = 3;
    const Region l = make_region({{{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {0, 4}}}, FillRule::non_zero);
    EXPECT_NEAR(total(Expr(as_polyhedron(linear_extrude(l, options)))), 21, 1e-6);
    const Region ring =
        make_region({{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{1, 1}, {3, 1}, {3, 3}, {1, 3}}}, FillRule::even_odd);
    EXPECT_NEAR(total(Expr(as_polyhedron(linear_extrude(ring, options)))), 36, 1e-6);
    EXPECT_EQ(convex_pieces(Expr(Ball{1})).error().code, ErrorCode::unsupported);
    EXPECT_NEAR(area(*shadow(subtract({cube, hole}))), 12, 1e-6);
    EXPECT_NEAR(area(*section(transform(Affine{{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, -2}}}},
                                        subtract({cube, hole})))),
                12, 1e-6);
}

TEST(SolidMesh, OpenMeshesAreFoundAndSeamsWelded) {
    mesh::Mesh box = cuboid_mesh({0, 0, 0}, {1, 1, 1});
    EXPECT_TRUE(is_closed(box));
    EXPECT_EQ(as_polyhedron(box).convexity, Convexity::convex);
    mesh::Mesh open = box;
    open.triangles.pop_back();
    EXPECT_FALSE(is_closed(open));
    // A seam with rounding in it: the last facets get corners of their own, a little off.
    mesh::Mesh seam = box;
    for (const mesh::VertexIndex v : {1U, 3U, 5U, 7U}) {
        seam.vertices.push_back(seam.vertices[v] + Vec3{1e-9, -1e-9, 0});
        for (std::size_t t = 10; t < 12; ++t)
            for (mesh::VertexIndex& corner : seam.triangles[t])
                if (corner == v) corner = static_cast<mesh::VertexIndex>(seam.vertices.size() - 1);
    }
    EXPECT_FALSE(is_closed(seam));
    EXPECT_TRUE(is_closed(weld_near(seam, 0x1p-20)));
}

}  // namespace
}  // namespace octavo::csg
