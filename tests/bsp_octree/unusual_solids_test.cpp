// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <map>

#include <octavo/mesh/shapes.hpp>
#include <octavo/mesh/snap.hpp>
#include <octavo/mesh/transform.hpp>

#include "bsp_octree/fingerprint.hpp"
#include "bsp_octree/solid_cases.hpp"
#include "effort.hpp"

// Solids that are hard on octrees or on BSP trees: thousands of faces in one plane, about one point, about one axis,
// and up to the last point of the lattice. Each comes back from its tree, and set operations with it are those of
// boolean/.

namespace octavo::bsp_octree {
namespace {

using boolean::Program;

/// Both engines, on one lattice that holds both; and each solid comes back.
void expect_agreement(const std::string& what, mesh::Mesh first, mesh::Mesh second) {
    Box3 bounds = first.bounds();
    bounds.add(second.bounds());
    const exact::Lattice lattice = *exact::Lattice::fit(bounds);
    std::array<mesh::Mesh, 2> operands{std::move(first), std::move(second)};
    for (mesh::Mesh& mesh : operands)
        for (Vec3& vertex : mesh.vertices) vertex = lattice.to_world(lattice.snap(vertex));
    const Result<Built> built = build(operands[0], lattice);
    ASSERT_TRUE(built) << what << ": " << built.error().describe();
    const BspOctree& solid = built->octree;
    const Result<ToMesh> back = to_mesh(solid);
    ASSERT_TRUE(back) << what << ": " << back.error().describe();
    EXPECT_EQ(tests::manifold_defect(back->mesh), "") << what;
    const Result<Built> again = build(back->mesh, lattice, {}, {}, solid.shared_store());
    ASSERT_TRUE(again) << what;
    if (!built->report.resolved) tests::expect_same(solid, again->octree, what);

    const Result<Built> other = build(operands[1], lattice, {}, {}, solid.shared_store());
    ASSERT_TRUE(other) << what;
    const auto expect = [&](const Result<BspOctree>& ours, const Program& program, const char* operation) {
        ASSERT_TRUE(ours) << what;
        EXPECT_TRUE(tests::fingerprint_of(*ours) == tests::fingerprint_of(operands, program))
            << what << ", " << operation;
    };
    expect(solid.unite(other->octree), Program::union_of(2), "union");
    expect(solid.intersect(other->octree), Program::intersection(2), "intersection");
    expect(solid.subtract(other->octree), Program::difference(2), "difference");
    EXPECT_TRUE(solid.subtract(solid)->is_empty()) << what;
    EXPECT_TRUE(solid.intersect(solid.complement())->is_empty()) << what;
    EXPECT_TRUE(solid.unite(solid.complement())->is_everything()) << what;
}

mesh::Mesh turned(const mesh::Mesh& mesh, double degrees, Vec3 by = {}) {
    return mesh::transform(mesh, compose(mesh::translation(by), mesh::rotation({1, 2, 3}, degrees)));
}

/// Ground of n² squares over a floor: steps of a few heights, so that most facets are coplanar with thousands of
/// others.
mesh::Mesh terraces(int n) {
    mesh::Mesh mesh;
    std::map<std::array<int, 3>, std::uint32_t> numbers;
    const auto vertex = [&](int x, int y, int z) {
        const auto [at, is_new] =
            numbers.try_emplace({x, y, z}, static_cast<std::uint32_t>(mesh.vertices.size()));
        if (is_new) mesh.vertices.push_back({double(x), double(y), double(z)});
        return at->second;
    };
    const auto quad = [&](std::array<std::array<int, 3>, 4> q) {
        std::array<std::uint32_t, 4> v;
        for (std::size_t i = 0; i < 4; ++i) v[i] = vertex(q[i][0], q[i][1], q[i][2]);
        mesh.triangles.insert(mesh.triangles.end(), {{v[0], v[1], v[2]}, {v[0], v[2], v[3]}});
    };
    // Heights of unit cubes; walls are of unit squares, so that everything conforms.
    const auto height = [&](int x, int y) {
        if (x < 0 || y < 0 || x >= n || y >= n) return 0;
        return 1 + static_cast<int>(std::lround(1.5 + 1.5 * std::sin(x * 0.31) * std::cos(y * 0.23)));
    };
    for (int x = 0; x < n; ++x)
        for (int y = 0; y < n; ++y) {
            const int h = height(x, y);
            quad({{{x, y, h}, {x + 1, y, h}, {x + 1, y + 1, h}, {x, y + 1, h}}});
            quad({{{x, y, 0}, {x, y + 1, 0}, {x + 1, y + 1, 0}, {x + 1, y, 0}}});
            for (int z = height(x - 1, y); z < h; ++z)
                quad({{{x, y, z}, {x, y, z + 1}, {x, y + 1, z + 1}, {x, y + 1, z}}});
            for (int z = height(x + 1, y); z < h; ++z)
                quad({{{x + 1, y, z}, {x + 1, y + 1, z}, {x + 1, y + 1, z + 1}, {x + 1, y, z + 1}}});
            for (int z = height(x, y - 1); z < h; ++z)
                quad({{{x, y, z}, {x + 1, y, z}, {x + 1, y, z + 1}, {x, y, z + 1}}});
            for (int z = height(x, y + 1); z < h; ++z)
                quad({{{x, y + 1, z}, {x, y + 1, z + 1}, {x + 1, y + 1, z + 1}, {x + 1, y + 1, z}}});
        }
    return mesh;
}

/// Wedges of a circle, one above the other: all meet in the axis, and each covers a part of the one below.
mesh::Mesh spiral_stairs(int steps) {
    mesh::Mesh mesh;
    constexpr double pi = 3.14159265358979323846, width = 2 * pi / 12;
    for (int i = 0; i < steps; ++i) {
        mesh::Outline wedge{{0, 0}};
        for (int k = 0; k <= 4; ++k) {
            const double angle = i * 0.8 * width + k * width / 4;
            wedge.push_back({2 * std::cos(angle), 2 * std::sin(angle)});
        }
        const mesh::Mesh step =
            mesh::transform(mesh::extrude(wedge, {}, 0.25), mesh::translation({0, 0, 0.25 * i}));
        mesh = i == 0 ? step : tests::joined({mesh, step});
    }
    return mesh;
}

TEST(UnusualSolids, KnotWithFacesSideBySideInOnePlane) {
    const mesh::Mesh knot = mesh::knot_tube(3, 5, 0.2, 240, 4);
    expect_agreement("knot", knot, turned(knot, 20, {0.3, 0.1, 0.2}));
}

TEST(UnusualSolids, Sponge) {
    const mesh::Mesh sponge = mesh::menger_sponge(tests::effort() >= 10 ? 3 : 2);
    // On its own grid, where thousands of faces coincide, and turned.
    expect_agreement("sponge", sponge, mesh::transform(sponge, mesh::translation({1.0 / 3, 1.0 / 9, 0})));
    expect_agreement("turned sponge", turned(sponge, 25), mesh::cube(0.75));
}

TEST(UnusualSolids, TerracesOfFacetsAtOneHeight) {
    const mesh::Mesh ground = terraces(28);
    const mesh::Mesh box = mesh::box({3, 3, 0}, {20, 14.5, 2});  // its upper side at one of the heights
    expect_agreement("terraces", ground, box);
    expect_agreement("turned terraces", turned(ground, 30), turned(box, 30));
}

TEST(UnusualSolids, SpiralStairs) {
    const mesh::Mesh stairs = spiral_stairs(40);
    expect_agreement("stairs", stairs, mesh::cylinder(0.5, 10, 24));
    expect_agreement("turned stairs", turned(stairs, 40), turned(mesh::cylinder(0.5, 10, 24), 40));
}

TEST(UnusualSolids, ConeOfManyFacetsAboutItsApex) {
    const mesh::Mesh cone = mesh::cone(1, 0, 2, tests::effort() >= 10 ? 10'000 : 500);
    expect_agreement("cone", cone, mesh::box({-0.25, -2, 1.5}, {0.25, 2, 2.5}));
}

TEST(UnusualSolids, WhatFillsTheLattice) {
    // All of the lattice but the unit that must stay free, and a point, an edge and a face at its border.
    const exact::Lattice lattice = tests::small_lattice(0);
    const auto at = [&](std::int32_t x, std::int32_t y, std::int32_t z) {
        return lattice.to_world({x, y, z});
    };
    constexpr std::int32_t last = exact::universe_side - 2;
    const mesh::Mesh all = mesh::box(at(1, 1, 1), at(last, last, last));
    mesh::Mesh corner{{at(1, 1, 1), at(last, 1, 1), at(1, last, 1), at(1, 1, last)},
                      {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}},
                      {}};
    const mesh::Mesh sliver{{at(1, 1, 1), at(last, last, last), at(last, last - 1, last), at(1, 2, 1)},
                            {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {0, 2, 3}},
                            {}};
    const std::array<mesh::Mesh, 2> operands{all, corner};
    const BspOctree whole = tests::octree_of(all, {}, lattice), part = tests::octree_of(corner, {}, lattice);
    EXPECT_TRUE(tests::fingerprint_of(*whole.subtract(part)) ==
                tests::fingerprint_of(operands, Program::difference(2)));
    tests::expect_same(*whole.subtract(part)->unite(part), whole, "put back");
    EXPECT_TRUE(part.subtract(whole)->is_empty());
    EXPECT_EQ(whole.classify(at(last, 5, 5)), bsp::Position::on);
    EXPECT_EQ(whole.classify(at(last + 1, 5, 5)), bsp::Position::out);
    EXPECT_EQ(whole.complement().classify(at(0, 0, 0)), bsp::Position::in);
    for (const mesh::Mesh& one : {all, corner, sliver}) {
        const mesh::Mesh outwards = tests::volume_of(one) < 0 ? mesh::flipped(one) : one;
        const BspOctree solid = tests::octree_of(outwards, {}, lattice);
        const Result<ToMesh> back = to_mesh(solid);
        ASSERT_TRUE(back);
        tests::expect_same(solid, tests::octree_of(back->mesh, {}, lattice), "back");
    }
}

TEST(UnusualSolids, NothingAndEverything) {
    const BspOctree cube = tests::octree_of(mesh::cube());
    const BspOctree nothing(cube.lattice()), everything = nothing.complement();
    EXPECT_TRUE(cube.intersect(nothing)->is_empty());
    EXPECT_TRUE(nothing.intersect(cube)->is_empty());
    EXPECT_TRUE(cube.subtract(everything)->is_empty());
    EXPECT_TRUE(cube.unite(everything)->is_everything());
    EXPECT_TRUE(nothing.subtract(nothing)->is_empty());
    tests::expect_same(*nothing.unite(cube), cube, "nothing and a cube");
    tests::expect_same(*everything.intersect(cube), cube, "a cube of everything");
    tests::expect_same(*everything.subtract(cube), cube.complement(), "everything but a cube");
    tests::expect_same(*cube.subtract(cube.complement()), cube, "a cube without what is not in it");
    EXPECT_EQ(measure(nothing).volume, 0);
    EXPECT_TRUE(to_mesh(nothing)->mesh.triangles.empty());
}

}  // namespace
}  // namespace octavo::bsp_octree
