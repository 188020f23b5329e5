// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <octavo/bsp/boundary.hpp>
#include <octavo/bsp/build.hpp>
#include <octavo/bsp/classify.hpp>
#include <octavo/bsp/clip.hpp>

#include "boolean/solids.hpp"
#include "bsp/sliver_cap.hpp"

namespace octavo::bsp {
namespace {

using octree::Cell;
using tests::Convex;

constexpr std::int32_t unit = 1 << 10;  // lattice units a grid step

/// A small solid on the lattice, as a mesh and as the faces of a tree whose cell is the universe.
struct Solid {
    std::vector<exact::Point> points;
    std::vector<mesh::Triangle> triangles;
    PlaneTable planes;

    explicit Solid(const mesh::Mesh& mesh) : triangles(mesh.triangles) {
        for (const Vec3& v : mesh.vertices) points.push_back({at(v.x), at(v.y), at(v.z)});
    }
    static std::int32_t at(double grid) { return static_cast<std::int32_t>((grid + 16) * unit); }

    std::vector<Fragment> fragments(FragmentPool& pool) {
        std::vector<Fragment> all;
        for (std::uint32_t i = 0; i < triangles.size(); ++i) {
            const mesh::Triangle& t = triangles[i];
            all.push_back(pool.triangle(i, planes.add(points[t[0]], points[t[1]], points[t[2]])));
        }
        return all;
    }
};

Vec3 area_vector(const FragmentPool& pool, const Fragment& fragment) {
    const std::span<const Corner> ring = pool.corners(fragment);
    Vec3 sum;
    for (std::size_t i = 2; i < ring.size(); ++i)
        sum = sum + 0.5 * cross(pool.approximation(ring[i - 1].vertex) - pool.approximation(ring[0].vertex),
                                pool.approximation(ring[i].vertex) - pool.approximation(ring[0].vertex));
    return fragment.facing.reversed() ? -sum : sum;
}

double area(const FragmentPool& pool, std::span<const Fragment> fragments) {
    double sum = 0;
    for (const Fragment& fragment : fragments) sum += length(area_vector(pool, fragment));
    return sum;
}

Position classify_at(const Tree& tree, const PlaneTable& planes, exact::Point p) {
    return classify(tree, [&](PlaneId plane) { return exact::side_of(planes[plane], p); });
}

class Partitions : public testing::TestWithParam<Partition> {};

TEST_P(Partitions, TreesKnowInsideOutsideAndOnOfConvexBodies) {
    TreeBuilder builder({.partition = GetParam()});
    for (int run = 0; run < 200; ++run) {
        std::mt19937 random(static_cast<unsigned>(run));
        const Convex body = tests::random_convex(random, 5);
        Solid solid(body.mesh);
        FragmentPool pool(solid.planes, solid.points, solid.triangles);
        const std::vector<Fragment> faces = solid.fragments(pool);
        std::vector<Node> nodes;
        builder.build(pool, solid.planes, faces, nodes);
        const Tree tree{nodes}, complement{nodes, true};
        for (int x = -1; x <= 6; ++x)
            for (int y = -1; y <= 6; ++y)
                for (int z = -1; z <= 6; ++z) {
                    Position expected = Position::in;
                    for (const tests::HalfSpace& half : body.sides) {
                        const int value = tests::dot(half.n, {x, y, z}) - half.d;
                        if (value > 0) expected = Position::out;
                        if (value == 0 && expected == Position::in) expected = Position::on;
                    }
                    const exact::Point p{Solid::at(x), Solid::at(y), Solid::at(z)};
                    ASSERT_EQ(classify_at(tree, solid.planes, p), expected) << "run " << run;
                    const Position opposite = expected == Position::on   ? Position::on
                                              : expected == Position::in ? Position::out
                                                                         : Position::in;
                    ASSERT_EQ(classify_at(complement, solid.planes, p), opposite) << "run " << run;
                }
    }
}

TEST_P(Partitions, BoundariesComeBackFromTrees) {
    TreeBuilder builder({.partition = GetParam()});
    BoundaryExtractor extractor;
    for (int run = 0; run < 200; ++run) {
        std::mt19937 random(static_cast<unsigned>(run));
        // Two bodies apart, so that the solid is not convex.
        const Convex first = tests::random_convex(random, 4);
        mesh::Mesh both = tests::random_convex(random, 4).mesh;
        for (Vec3& v : both.vertices) v.x += 5;
        const auto count = static_cast<std::uint32_t>(both.vertices.size());
        both.vertices.insert(both.vertices.end(), first.mesh.vertices.begin(), first.mesh.vertices.end());
        for (const mesh::Triangle& t : first.mesh.triangles)
            both.triangles.push_back({t[0] + count, t[1] + count, t[2] + count});
        Solid solid(both);
        FragmentPool pool(solid.planes, solid.points, solid.triangles);
        const std::vector<Fragment> faces = solid.fragments(pool);
        std::vector<Node> nodes;
        builder.build(pool, solid.planes, faces, nodes);
        for (const bool complemented : {false, true}) {
            std::vector<Fragment> found;
            extractor.extract(pool, Cell::root(), {nodes, complemented}, found);
            EXPECT_NEAR(area(pool, found), area(pool, faces), 1e-6 * area(pool, faces)) << "run " << run;
            // The boundary is closed, and each face looks where it looked before, by plane.
            Vec3 sum;
            for (const Fragment& fragment : found) sum = sum + area_vector(pool, fragment);
            EXPECT_NEAR(length(sum), 0, 1e-6 * area(pool, faces));
            for (const Fragment& fragment : found) {
                const Facing facing = complemented ? fragment.facing.opposite() : fragment.facing;
                EXPECT_TRUE(std::any_of(faces.begin(), faces.end(),
                                        [&](const Fragment& face) { return face.facing == facing; }));
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(All, Partitions,
                         testing::Values(Partition::fewest_splits, Partition::random, Partition::first));

TEST(Tree, OfAConvexBodyHasANodeAPlane) {
    Solid solid(tests::box({0, 0, 0}, {3, 2, 1}).mesh);
    FragmentPool pool(solid.planes, solid.points, solid.triangles);
    const std::vector<Fragment> faces = solid.fragments(pool);
    TreeBuilder builder;
    std::vector<Node> nodes;
    builder.build(pool, solid.planes, faces, nodes);
    EXPECT_EQ(nodes.size(), 6U);
    EXPECT_EQ(builder.splits(), 0U);
}

TEST(Tree, OfManyFacesRoundOneVertexCutsNone) {
    // A fan that is not convex: the faces touch one another's planes in the apex and in shared edges.
    mesh::Mesh cone;
    constexpr std::uint32_t count = 24;
    cone.vertices.push_back({0, 0, 8});
    cone.vertices.push_back({0, 0, 0});
    for (std::uint32_t i = 0; i < count; ++i) {
        const double angle = 2 * 3.14159265358979 * i / count;
        cone.vertices.push_back({std::round(4 * unit * std::cos(angle)) / unit,
                                 std::round(4 * unit * std::sin(angle)) / unit, 0});
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t a = 2 + i, b = 2 + (i + 1) % count;
        cone.triangles.push_back({0, a, b});
        cone.triangles.push_back({1, b, a});
    }
    Solid solid(cone);
    FragmentPool pool(solid.planes, solid.points, solid.triangles);
    const std::vector<Fragment> faces = solid.fragments(pool);
    TreeBuilder builder;
    std::vector<Node> nodes;
    builder.build(pool, solid.planes, faces, nodes);
    EXPECT_EQ(builder.splits(), 0U);
    EXPECT_EQ(nodes.size(), count + 1U);
}

TEST(Tree, OfSliversSideBySideIsSmall) {
    // Each of the slivers' planes cuts many others. Trees of faces taken at random know no separators.
    mesh::Mesh cap = tests::sliver_cap(200, 1.0 / unit);
    for (Vec3& v : cap.vertices) v = v - Vec3{16, 16, 16};
    Solid solid(cap);
    FragmentPool pool(solid.planes, solid.points, solid.triangles);
    const std::vector<Fragment> faces = solid.fragments(pool);
    std::vector<Node> nodes, expected;
    TreeBuilder builder, without({.partition = Partition::random});
    without.build(pool, solid.planes, faces, expected);
    builder.build(pool, solid.planes, faces, nodes);
    EXPECT_GT(without.splits(), faces.size());
    EXPECT_LT(builder.splits(), faces.size() / 8);
    EXPECT_LT(nodes.size(), faces.size());

    // Around slivers, near the apex of the fan and far from it.
    std::mt19937 random(1);
    int on = 0, in = 0;
    for (int i = 0; i < 20000; ++i) {
        const mesh::Triangle& t = solid.triangles[random() % solid.triangles.size()];
        const exact::Point a = solid.points[t[0]], b = solid.points[t[random() % 3]];
        const std::int64_t part = i % 4 == 0 ? 0 : random() % 1000;
        const auto between = [&](std::int32_t from, std::int32_t to) {
            return static_cast<std::int32_t>(from + (std::int64_t{to} - from) * part / 1000 + random() % 3 -
                                             1);
        };
        const exact::Point p{between(a.x, b.x), between(a.y, b.y), between(a.z, b.z)};
        const Position position = classify_at({nodes}, solid.planes, p);
        ASSERT_EQ(position, classify_at({expected}, solid.planes, p)) << "point " << i;
        on += position == Position::on;
        in += position == Position::in;
    }
    EXPECT_GT(on, 500);
    EXPECT_GT(in, 500);

    std::vector<Fragment> found;
    BoundaryExtractor().extract(pool, Cell::root(), {nodes}, found);
    EXPECT_NEAR(area(pool, found), area(pool, faces), 1e-9 * area(pool, faces));
    for (const Fragment& fragment : found)
        ASSERT_TRUE(std::any_of(faces.begin(), faces.end(),
                                [&](const Fragment& face) { return face.facing == fragment.facing; }));
}

TEST(Fragments, StayExactHoweverOftenTheyAreCut) {
    // Every corner lies, in wide integers, in the fragment's plane and on both its edges; parts lie on their sides.
    std::mt19937 random(3);
    std::uniform_int_distribution<std::int32_t> at(1, exact::universe_side - 2);
    const auto any = [&] { return exact::Point{at(random), at(random), at(random)}; };
    PlaneTable planes;
    std::vector<exact::Point> points{any(), any(), any()};
    const std::vector<mesh::Triangle> triangles{{0, 1, 2}};
    const Facing facing = planes.add(points[0], points[1], points[2]);
    std::vector<PlaneId> cuts;
    for (int i = 0; i < 40; ++i) cuts.push_back(planes.add(any(), any(), any()).plane());
    FragmentPool pool(planes, points, triangles);
    std::vector<Fragment> fragments{pool.triangle(0, facing)};
    const double whole = area(pool, fragments);
    for (const PlaneId cut : cuts) {
        std::vector<Fragment> next;
        pool.begin_cut(Bound::plane(cut));
        for (const Fragment& fragment : fragments) {
            if (pool.place(fragment) != FragmentPool::Place::both) {
                next.push_back(fragment);
                continue;
            }
            Fragment front, back;
            pool.split(fragment, front, back);
            for (const auto& [part, side] :
                 {std::pair(front, exact::Sign::positive), std::pair(back, exact::Sign::negative)}) {
                EXPECT_GE(part.count, 3U);
                for (const Corner& corner : pool.corners(part))
                    EXPECT_NE(pool.side_of(planes[cut], corner.vertex), -side);
                next.push_back(part);
            }
        }
        fragments = next;
    }
    EXPECT_GT(fragments.size(), 50U);
    EXPECT_NEAR(area(pool, fragments), whole, 1e-6 * whole);
    for (const Fragment& fragment : fragments) {
        const std::span<const Corner> ring = pool.corners(fragment);
        for (std::size_t i = 0; i < ring.size(); ++i) {
            EXPECT_EQ(pool.side_of(planes[facing.plane()], ring[i].vertex), exact::Sign::zero);
            const Bound edge = ring[i].edge;
            if (!edge.is_plane()) continue;
            EXPECT_EQ(pool.side_of(planes[edge.plane_id()], ring[i].vertex), exact::Sign::zero);
            EXPECT_EQ(pool.side_of(planes[edge.plane_id()], ring[(i + 1) % ring.size()].vertex),
                      exact::Sign::zero);
        }
    }
}

TEST(Fragments, OfNeighboursShareTheVerticesOfACut) {
    Solid solid(tests::box({0, 0, 0}, {4, 4, 4}).mesh);
    FragmentPool pool(solid.planes, solid.points, solid.triangles);
    const std::vector<Fragment> faces = solid.fragments(pool);
    pool.begin_cut(Bound::wall(0, 2 * Solid::at(1) + 1));
    std::vector<VertexId> made;
    for (const Fragment& face : faces) {
        if (pool.place(face) != FragmentPool::Place::both) continue;
        Fragment front, back;
        pool.split(face, front, back);
        for (const Corner& corner : pool.corners(front))
            if (!pool.is_lattice(corner.vertex)) made.push_back(corner.vertex);
    }
    // Four edges of the box and four diagonals cross the wall; each vertex is that of two facets.
    EXPECT_EQ(made.size(), 16U);
    std::sort(made.begin(), made.end());
    made.erase(std::unique(made.begin(), made.end()), made.end());
    EXPECT_EQ(made.size(), 8U);
}

TEST(Fragments, SectionsOfCellsHaveTheAreaThatTheyShould) {
    PlaneTable planes;
    const Cell cell{{1 << 20, 1 << 20, 1 << 20}, 8};  // side 2^18
    const double side = cell.side();
    const exact::Point middle = cell.centre();
    // The diagonal plane through the centre is a regular hexagon but for the half unit that walls are off.
    const PlaneId diagonal =
        planes
            .add({middle.x, middle.y, middle.z}, {middle.x + 100, middle.y - 100, middle.z},
                 {middle.x, middle.y + 100, middle.z - 100})
            .plane();
    const PlaneId level = planes.add({5, 5, middle.z}, {9, 5, middle.z}, {5, 9, middle.z}).plane();
    const PlaneId away = planes.add({5, 5, 7}, {9, 5, 7}, {5, 9, 7}).plane();
    FragmentPool pool(planes);
    const Fragment hexagon = pool.section(diagonal, cell), square = pool.section(level, cell);
    EXPECT_EQ(hexagon.count, 6U);
    EXPECT_NEAR(length(area_vector(pool, hexagon)), 3 * std::sqrt(3.0) / 4 * side * side, 4 * side);
    EXPECT_EQ(square.count, 4U);
    EXPECT_NEAR(length(area_vector(pool, square)), side * side, 1e-3);
    EXPECT_EQ(pool.section(away, cell).count, 0U);
    // Counter-clockwise seen from the front of the plane.
    const exact::Plane& plane = planes[diagonal];
    EXPECT_GT(dot(area_vector(pool, hexagon), {static_cast<double>(plane.a()), static_cast<double>(plane.b()),
                                               static_cast<double>(plane.c())}),
              0);
}

}  // namespace
}  // namespace octavo::bsp
