// SPDX-License-Identifier: Apache-2.0
#include <atomic>
#include <random>

#include <gtest/gtest.h>

#include <octavo/bp_octree/build.hpp>
#include <octavo/bp_octree/cell_split.hpp>
#include <octavo/bp_octree/certify.hpp>

#include "bp_octree/rational.hpp"
#include "bp_octree/solids.hpp"
#include "effort.hpp"
#include "models.hpp"

namespace octavo::bp_octree {
namespace {

using octree::Cell;
using octree::Node;
using tests::Rational;
using tests::RationalPoint;

BpOctree built(const mesh::LatticeMesh& mesh, const BuildOptions& options = {}, int threads = 1) {
    Context context;
    context.threads = threads;
    auto tree = build(mesh, options, context);
    EXPECT_TRUE(tree.has_value());
    return std::move(tree).value();
}

/// Calls visit(node, cell) for all nodes.
template <class Visit>
void for_each_node(const BpOctree& tree, const Visit& visit, NodeIndex node = 0,
                   const Cell& cell = Cell::root()) {
    visit(node, cell);
    if (tree.nodes[node] != Node::split) return;
    for (unsigned i = 0; i < 8; ++i)
        for_each_node(tree, visit, tree.link[node] + i, cell.child(static_cast<int>(i)));
}

bool in_box(const CellBox& box, exact::Point p) {
    for (int axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<std::size_t>(axis);
        if (2 * p[axis] < box.low[i] || 2 * p[axis] > box.high[i]) return false;
    }
    return true;
}

/// Calls visit(node, box) for the nodes whose cells hold a point, from the root down.
template <class Visit>
void for_each_node_round(const BpOctree& tree, exact::Point point, const Visit& visit, NodeIndex node = 0,
                         const Cell& cell = Cell::root()) {
    const CellBox box = tree.frame.box(cell);
    if (!in_box(box, point)) return;
    visit(node, box);
    if (tree.nodes[node] != Node::split) return;
    for (unsigned i = 0; i < 8; ++i)
        for_each_node_round(tree, point, visit, tree.link[node] + i, cell.child(static_cast<int>(i)));
}

/// Is the point, in doubled coordinates, within all planes of the node? Rational, hence exact.
bool within_planes(const BpOctree& tree, NodeIndex node, const CellBox& box, const RationalPoint& x) {
    for (const BoundingPlane& plane : tree.planes_of(node)) {
        const Direction u = direction_of(plane.direction);
        Rational value = 0;
        for (int axis = 0; axis < 3; ++axis)
            value += u[axis] * (x[static_cast<std::size_t>(axis)] - box.low[axis]) * 65536 / box.side(axis);
        if (value > plane.reach()) return false;
    }
    return true;
}

/// Every part of every triangle, clipped exactly to every cell, lies within the planes of the cell.
void expect_surface_contained(const BpOctree& tree) {
    for_each_node(tree, [&](NodeIndex node, const Cell& cell) {
        const CellBox box = tree.frame.box(cell);
        for (const mesh::Triangle& t : tree.mesh.triangles) {
            const exact::Point p = tree.mesh.points[t[0]], q = tree.mesh.points[t[1]],
                               r = tree.mesh.points[t[2]];
            if (!TriangleInCells(p, q, r).meets(box)) continue;
            ASSERT_TRUE(tree.nodes[node] == Node::split || tree.nodes[node] == Node::gray);
            for (const RationalPoint& x : tests::clipped(p, q, r, box))
                ASSERT_TRUE(within_planes(tree, node, box, x));
        }
    });
}

TEST(Build, PlanesContainTheSurfaceExactly) {
    BuildOptions options;
    options.leaf_triangles = 6;
    // Rational numbers are slow: 128 triangles, or 512 when there is time.
    const mesh::LatticeMesh mesh = tests::on_lattice(tests::bumpy_sphere(tests::effort() < 5 ? 2 : 3));
    for (const Quality quality : {Quality::fast, Quality::normal}) {
        options.quality = quality;
        const BpOctree tree = built(mesh, options);
        EXPECT_TRUE(tree.is_solid);
        EXPECT_GT(tree.planes.size(), 100U);
        expect_surface_contained(tree);
    }
}

TEST(Build, PlanesContainTheSurfaceOfLongSliversInDeepCells) {
    mesh::Mesh mesh;
    std::mt19937 random(11);
    for (int i = 0; i < 6; ++i) {
        const auto far = [&] { return static_cast<double>(random() % 1000000); };
        const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
        const Vec3 p{far(), far(), far()}, q{far(), far(), far()};
        mesh.vertices.insert(mesh.vertices.end(), {p, q, q + Vec3{3, 0, 2}});
        mesh.triangles.push_back({base, base + 1, base + 2});
    }
    BuildOptions options;
    options.leaf_triangles = 1;
    options.depth = 6;
    const BpOctree tree = built(tests::on_lattice(mesh), options);
    EXPECT_FALSE(tree.is_solid);
    expect_surface_contained(tree);
}

TEST(Build, InteriorPointsLieInBlackCellsOrWithinTheEnvelopesOfAllLevels) {
    mesh::Mesh mesh;
    // Overlapping, touching and nested boxes: winding numbers from 0 to 3, and cell corners on faces.
    tests::add_box(mesh, {0, 0, 0}, {64, 64, 64});
    tests::add_box(mesh, {32, 32, 32}, {96, 80, 72});
    tests::add_box(mesh, {64, 0, 0}, {80, 40, 64});
    tests::add_box(mesh, {40, 40, 40}, {50, 50, 50});
    const std::vector<std::array<Vec3, 2>> boxes{{Vec3{0, 0, 0}, Vec3{64, 64, 64}},
                                                 {Vec3{32, 32, 32}, Vec3{96, 80, 72}},
                                                 {Vec3{64, 0, 0}, Vec3{80, 40, 64}}};
    BuildOptions options;
    options.leaf_triangles = 2;
    options.depth = 6;
    const mesh::LatticeMesh lattice_mesh = tests::on_lattice(mesh);
    const BpOctree tree = built(lattice_mesh, options);
    ASSERT_TRUE(tree.is_solid);
    std::mt19937 random(12);
    std::size_t inside_points = 0, black_points = 0;
    for (int i = 0; i < 1500 * tests::effort(); ++i) {
        exact::Point p;
        Vec3 world;
        const auto coordinate = [&](int axis) {
            return static_cast<int>((tree.frame.low()[static_cast<std::size_t>(axis)] + 1) / 2 +
                                    static_cast<int>(random() % (tree.frame.side(axis, 0) / 2)));
        };
        p = {coordinate(0), coordinate(1), coordinate(2)};
        world = lattice_mesh.lattice.to_world(p);
        bool inside = false;
        for (const auto& [low, high] : boxes)
            inside |= world.x > low.x && world.x < high.x && world.y > low.y && world.y < high.y &&
                      world.z > low.z && world.z < high.z;
        inside_points += inside;
        const RationalPoint x = tests::doubled(p);
        for_each_node_round(tree, p, [&](NodeIndex node, const CellBox& box) {
            const Node kind = tree.nodes[node];
            ASSERT_FALSE(kind == Node::white && inside);
            ASSERT_FALSE(kind == Node::black && !inside);
            black_points += kind == Node::black;
            ASSERT_TRUE(!inside || kind == Node::black || within_planes(tree, node, box, x));
        });
    }
    EXPECT_GT(inside_points, 200U);
    EXPECT_GT(black_points, 40U);
}

TEST(Build, VolumesShrinkFromLevelToLevelTowardsTheSolid) {
    BuildOptions options;
    options.leaf_triangles = 8;
    const BpOctree tree = built(tests::on_lattice(tests::bumpy_sphere(5)), options);
    ASSERT_GE(tree.deepest(), 4);
    for (std::size_t level = 1; level < tree.levels.size(); ++level)
        EXPECT_LT(tree.levels[level].volume, tree.levels[level - 1].volume);
    EXPECT_GE(tree.levels.back().volume, tree.solid_volume);
    EXPECT_LT(tree.levels.back().volume, 1.02 * tree.solid_volume);
}

TEST(Build, ABoxIsItsOwnEnvelope) {
    const BpOctree tree = built(tests::on_lattice(tests::box({1, 2, 3}, {5, 4, 9})));
    EXPECT_EQ(tree.nodes.size(), 1U);
    EXPECT_NEAR(tree.levels[0].volume, 48, 48e-4);
    EXPECT_DOUBLE_EQ(tree.solid_volume, 48);
}

TEST(Build, LeavesHoldAllTrianglesThatMeetTheirCells) {
    BuildOptions options;
    options.leaf_triangles = 10;
    const BpOctree tree = built(tests::on_lattice(tests::bumpy_sphere(4)), options);
    std::size_t leaves = 0;
    for_each_node(tree, [&](NodeIndex node, const Cell& cell) {
        const CellBox box = tree.frame.box(cell);
        std::vector<mesh::FaceIndex> met;
        for (mesh::FaceIndex face = 0; face < tree.mesh.triangles.size(); ++face) {
            const mesh::Triangle& t = tree.mesh.triangles[face];
            if (TriangleInCells(tree.mesh.points[t[0]], tree.mesh.points[t[1]], tree.mesh.points[t[2]])
                    .meets(box))
                met.push_back(face);
        }
        const Node kind = tree.nodes[node];
        if (kind == Node::gray) {
            ++leaves;
            const auto own = tree.triangles_of(node);
            ASSERT_EQ(std::vector<mesh::FaceIndex>(own.begin(), own.end()), met);
            ASSERT_TRUE(met.size() <= options.leaf_triangles || cell.level == options.depth);
        } else {
            ASSERT_EQ(met.empty(), kind != Node::split);
        }
    });
    EXPECT_EQ(leaves, tree.leaf_count());
    EXPECT_GT(leaves, 200U);
}

TEST(Build, AnOpenSurfaceHasNoBlackCells) {
    mesh::Mesh mesh = tests::bumpy_sphere(4);
    mesh.triangles.pop_back();
    const BpOctree tree = built(tests::on_lattice(mesh));
    EXPECT_FALSE(tree.is_solid);
    for (const LevelFigures& level : tree.levels) EXPECT_EQ(level.black, 0U);
    for (const std::int32_t winding : tree.leaf_winding) EXPECT_EQ(winding, 0);
}

TEST(Build, GivesTheSameTreeForAnyNumberOfThreads) {
    BuildOptions options;
    options.leaf_triangles = 12;
    const mesh::LatticeMesh mesh = tests::on_lattice(tests::bumpy_sphere(5));
    const BpOctree one = built(mesh, options, 1), three = built(mesh, options, 3);
    EXPECT_EQ(one.nodes, three.nodes);
    EXPECT_EQ(one.planes, three.planes);
    EXPECT_EQ(one.leaf_triangles, three.leaf_triangles);
    EXPECT_EQ(one.levels, three.levels);
}

TEST(Build, DegenerateInputIsEnveloped) {
    // A point, a segment, and a triangle in a plane of constant x; at the greatest depth.
    for (const mesh::Triangle& t :
         {mesh::Triangle{0, 0, 0}, mesh::Triangle{0, 1, 1}, mesh::Triangle{0, 1, 2}}) {
        mesh::Mesh mesh;
        mesh.vertices = {{1, 1, 1}, {1, 3, 2}, {1, 2, 7}};
        mesh.triangles = {t, t};
        BuildOptions options;
        options.leaf_triangles = 1;
        options.depth = 6;
        const BpOctree tree = built(tests::on_lattice(mesh), options);
        EXPECT_EQ(tree.deepest(), 6);
        expect_surface_contained(tree);
    }
}

TEST(Build, PlanesByKMedoidsAreFewerThanTheirLimitAndCertified) {
    const mesh::LatticeMesh mesh = tests::on_lattice(tests::bumpy_sphere(5));
    BuildOptions options;
    options.planes = PlaneChoice::k_medoids;
    options.k_medoids.part = 0.02;
    auto tree = build(mesh, options);
    ASSERT_TRUE(tree.has_value());
    const Status certified = certify(*tree);
    EXPECT_TRUE(certified.has_value()) << certified.error().sentence;
    // 2 % of the triangles at the root, half as many a node on each level below.
    for (NodeIndex node = 0; node < tree->nodes.size(); ++node) {
        const auto level = std::upper_bound(tree->level_begin.begin(), tree->level_begin.end(), node) -
                           tree->level_begin.begin() - 1;
        const double most =
            0.02 * static_cast<double>(mesh.triangles.size()) / std::ldexp(1.0, static_cast<int>(level));
        EXPECT_LE(static_cast<double>(tree->planes_of(node).size()), std::max(1.0, most));
    }
    EXPECT_GT(tree->planes_of(0).size(), 100U);
    for (std::size_t level = 1; level < tree->levels.size(); ++level)
        EXPECT_LT(tree->levels[level].volume, tree->levels[level - 1].volume);
}

TEST(Build, RefusesAnEmptyMeshAndStopsWhenCancelled) {
    EXPECT_EQ(build(mesh::LatticeMesh{}).error().code, ErrorCode::bad_input);
    std::atomic<bool> cancel{true};
    Context context;
    context.cancel = &cancel;
    EXPECT_EQ(build(tests::on_lattice(tests::bumpy_sphere(5)), {}, context).error().code,
              ErrorCode::cancelled);
}

}  // namespace
}  // namespace octavo::bp_octree
