// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include <octavo/mesh/measure.hpp>
#include <octavo/mesh/snap.hpp>
#include <octavo/mesh/transform.hpp>

#include "surfaces.hpp"
#include "unlimited.hpp"

namespace octavo::mesh {
namespace {

using octavo::tests::Integer;
using octavo::tests::Rational;

TEST(Measure, OfABoxIsTheTextbook) {
    const Measures m = measure(box({1, 2, 3}, {3, 5, 7}));
    EXPECT_DOUBLE_EQ(m.volume, 24);
    EXPECT_DOUBLE_EQ(m.area, 2 * (6 + 12 + 8));
    EXPECT_EQ(m.centroid, (Vec3{2, 3.5, 5}));
    EXPECT_DOUBLE_EQ(m.inertia[0][0], 24.0 / 12 * (9 + 16));
    EXPECT_DOUBLE_EQ(m.inertia[1][1], 24.0 / 12 * (4 + 16));
    EXPECT_DOUBLE_EQ(m.inertia[2][2], 24.0 / 12 * (4 + 9));
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (i != j) {
                EXPECT_NEAR(m.inertia[i][j], 0, 1e-13);
            }
    EXPECT_EQ(m.euler_number, 2);
    EXPECT_EQ(m.edges, 18);
    EXPECT_EQ(m.genus, 0);
    EXPECT_EQ(m.bounds.low, (Vec3{1, 2, 3}));
}

/// Volume and second moments by rational arithmetic, from another decomposition (tetrahedra with the origin).
struct RationalMoments {
    Rational volume, x, xx, xy;
};

RationalMoments rational_moments(const Mesh& mesh) {
    RationalMoments sum;
    for (const Triangle& t : mesh.triangles) {
        std::array<std::array<Rational, 3>, 3> p;
        for (int i = 0; i < 3; ++i)
            for (int axis = 0; axis < 3; ++axis) p[i][axis] = Rational(mesh.vertices[t[i]][axis]);
        const Rational det = p[0][0] * (p[1][1] * p[2][2] - p[1][2] * p[2][1]) -
                             p[0][1] * (p[1][0] * p[2][2] - p[1][2] * p[2][0]) +
                             p[0][2] * (p[1][0] * p[2][1] - p[1][1] * p[2][0]);
        sum.volume += det / 6;
        sum.x += det * (p[0][0] + p[1][0] + p[2][0]) / 24;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) {
                const int twice = i == j ? 2 : 1;
                sum.xx += det * twice * p[i][0] * p[j][0] / 120;
                sum.xy += det * twice * p[i][0] * p[j][1] / 120;
            }
    }
    return sum;
}

TEST(Measure, AgreesWithRationalArithmetic) {
    for (auto [name, mesh, genus] : tests::generated_solids()) {
        SCOPED_TRACE(name);
        if (mesh.triangles.size() > 3000) continue;
        mesh = transform(mesh, compose(translation({5, -3, 2}), rotation({1, 2, 3}, 33)));
        const RationalMoments exact = rational_moments(mesh);
        const Measures m = measure(mesh);
        const double volume = static_cast<double>(exact.volume);
        EXPECT_NEAR(m.volume, volume, 1e-12 * volume);
        EXPECT_NEAR(m.centroid.x, static_cast<double>(exact.x / exact.volume), 1e-12 * 5);
        const Rational xy = exact.xy;
        const double off = m.inertia[0][1] - m.volume * m.centroid.x * m.centroid.y;
        EXPECT_NEAR(-off, static_cast<double>(xy), 1e-10 * std::max(1.0, std::fabs(static_cast<double>(xy))));
        const double half_trace = (m.inertia[1][1] + m.inertia[2][2] - m.inertia[0][0]) / 2;
        EXPECT_NEAR(half_trace + m.volume * m.centroid.x * m.centroid.x, static_cast<double>(exact.xx),
                    1e-10 * std::fabs(static_cast<double>(exact.xx)));
    }
}

TEST(Measure, DoesNotDependOnTheOrderOfFacetsOrCorners) {
    std::mt19937 random(7);
    for (auto [name, mesh, genus] : tests::generated_solids()) {
        SCOPED_TRACE(name);
        const Measures before = measure(mesh);
        std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), random);
        for (Triangle& t : mesh.triangles)
            std::rotate(t.begin(), t.begin() + std::uniform_int_distribution<>(0, 2)(random), t.end());
        const Measures after = measure(mesh);
        EXPECT_EQ(before.volume, after.volume);
        EXPECT_EQ(before.area, after.area);
        EXPECT_EQ(before.centroid, after.centroid);
        EXPECT_EQ(before.inertia, after.inertia);
    }
}

TEST(Measure, IsAdditiveAndChangesSignWithTheOrientation) {
    const Mesh a = gear(), b = transform(torus(3, 1, 24, 12), translation({100, 0, 0}));
    const Mesh both = join(std::array{a, b});
    EXPECT_NEAR(measure(both).volume, measure(a).volume + measure(b).volume, 1e-9);
    EXPECT_EQ(measure(both).components, 2u);
    EXPECT_EQ(measure(both).genus, 8);
    EXPECT_EQ(measure(flipped(a)).volume, -measure(a).volume);
}

TEST(Measure, ScalesByPowersOfTheUnit) {
    const Mesh a = bearing_housing();
    for (const double unit : {0x1p-300, 0x1p180, 0x1p-10}) {
        const Mesh b = transform(a, scaling({unit, unit, unit}));
        EXPECT_EQ(measure(b).volume, measure(a).volume * unit * unit * unit);
        EXPECT_EQ(measure(b).area, measure(a).area * unit * unit);
    }
}

TEST(Measure, OfTouchingSurfacesCountsEachItsOwnGenus) {
    // Two tetrahedra with one vertex in common: a surface of two spheres.
    Mesh mesh = tetrahedron();
    mesh.vertices.push_back({2, 2, 2}), mesh.vertices.push_back({3, 1, 1}),
        mesh.vertices.push_back({1, 3, 2});
    mesh.triangles.insert(mesh.triangles.end(), {{0, 4, 5}, {0, 6, 4}, {0, 5, 6}, {4, 6, 5}});
    const Measures m = measure(mesh);
    EXPECT_EQ(m.components, 1u);
    EXPECT_EQ(m.genus, 0);
    EXPECT_EQ(m.euler_number, 3);
}

TEST(Measure, OfNothingIsZero) {
    const Measures m = measure(Mesh{});
    EXPECT_EQ(m.volume, 0);
    EXPECT_TRUE(m.bounds.empty());
    EXPECT_FALSE(m.genus.has_value());
}

TEST(ExactVolume, IsTheIntegerThatRationalsGive) {
    for (const auto& [name, mesh, genus] : tests::generated_solids()) {
        SCOPED_TRACE(name);
        const auto snapped = snap(mesh);
        ASSERT_TRUE(snapped);
        const LatticeMesh& lattice = snapped->mesh;
        Integer sum = 0;
        for (const Triangle& t : lattice.triangles) {
            // A different formula: a · ((b − a) × (c − a)).
            const exact::Point a = lattice.points[t[0]], b = lattice.points[t[1]], c = lattice.points[t[2]];
            const Integer ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z;
            const Integer vx = c.x - a.x, vy = c.y - a.y, vz = c.z - a.z;
            sum += a.x * (uy * vz - uz * vy) + a.y * (uz * vx - ux * vz) + a.z * (ux * vy - uy * vx);
        }
        const exact::int128 found = exact_volume6(lattice);
        EXPECT_EQ(Integer(found), sum);
        const double unit = lattice.lattice.unit();
        EXPECT_NEAR(static_cast<double>(found) / 6 * unit * unit * unit, measure(mesh).volume,
                    1e-5 * measure(mesh).volume);
    }
}

TEST(Transform, ThatMirrorsTurnsFacetsOver) {
    const Mesh mesh = gear();
    const Mesh mirrored = transform(mesh, scaling({-1, 1, 1}));
    EXPECT_DOUBLE_EQ(measure(mirrored).volume, measure(mesh).volume);
    EXPECT_EQ(tests::count_edges(mirrored), tests::EdgeCounts{});
}

TEST(Rotation, ByQuarterTurnsIsExact) {
    const Affine quarter = rotation({0, 0, 1}, 90);
    EXPECT_EQ(quarter(Vec3{1, 2, 3}), (Vec3{-2, 1, 3}));
    EXPECT_EQ(rotation({1, 0, 0}, -270)(Vec3{1, 2, 3}), (Vec3{1, -3, 2}));
    EXPECT_EQ(rotation({0, 2, 0}, 180)(Vec3{1, 2, 3}), (Vec3{-1, 2, -3}));
    const Vec3 turned = rotation({0, 0, 1}, 30)(Vec3{1, 0, 0});
    EXPECT_NEAR(turned.x, std::sqrt(0.75), 1e-15);
    EXPECT_NEAR(turned.y, 0.5, 1e-15);
}

TEST(Join, RemembersWhereFacetsCameFrom) {
    Mesh second = tetrahedron();
    second.sources = {{7, 3}, {7, 2}, {7, 1}, {7, 0}};
    const Mesh both = join(std::array{cube(), second});
    ASSERT_EQ(both.sources.size(), 16u);
    EXPECT_EQ(both.sources[11], (Source{0, 11}));
    EXPECT_EQ(both.sources[12], (Source{7, 3}));
    EXPECT_EQ(both.triangles[12], (Triangle{8, 9, 10}));
}

}  // namespace
}  // namespace octavo::mesh
