// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <octavo/hexmesh/build.hpp>
#include <octavo/hexmesh/size_field.hpp>
#include <octavo/mesh/shapes.hpp>

namespace octavo::hexmesh {
namespace {

using mesh::Mesh;

TEST(GridLattice, HoldsContentBesideTheLastOriginThereIs) {
    // The unit must grow once more than the size asks for: the aligned corner before the content is out of range.
    for (const double sign : {1.0, -1.0})
        for (double low = 0x1p53 - 0x1p28; low < 0x1p53 - 2000; low += 0x1p22) {
            Box3 content;
            content.add(Vec3{sign * low, 0, 0});
            content.add(Vec3{sign * (low + 1000), 1000, 1000});
            const Result<exact::Lattice> lattice = grid_lattice(content);
            ASSERT_TRUE(lattice) << low << ": " << lattice.error().describe();
            EXPECT_LE(lattice->unit(), 2);
            const exact::Point p = lattice->snap(content.low), q = lattice->snap(content.high);
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_GE(std::min(p[axis], q[axis]), 1);
                EXPECT_LT(std::max(p[axis], q[axis]), exact::universe_side - 1);
            }
        }
    for (const double reach : {0x1p900, 0x1p922, 0x1p924}) {
        Box3 huge;
        huge.add(Vec3{-reach, 0, 0});
        huge.add(Vec3{reach, 0, 0});
        const Result<exact::Lattice> lattice = grid_lattice(huge);
        ASSERT_TRUE(lattice || lattice.error().code == ErrorCode::limit);
        EXPECT_TRUE(lattice || reach > 0x1p923);
    }
}

Mesh in_another_order(Mesh solid, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::shuffle(solid.triangles.begin(), solid.triangles.end(), random);
    for (mesh::Triangle& t : solid.triangles)
        std::rotate(t.begin(), t.begin() + static_cast<std::ptrdiff_t>(random() % 3), t.end());
    return solid;
}

TEST(SizeField, RefinesAThinPlateByProximityEverywhereInWhateverOrderItsFacetsCome) {
    const Mesh plate = mesh::box({0.01, 0.02, 0.03}, {15.9, 15.8, 0.33});
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
        const Mesh shuffled = in_another_order(plate, seed);
        const Result<Built> built =
            build(std::span(&shuffled, 1), {.precision = 4, .proximity = {.smallest = 0.25}});
        ASSERT_TRUE(built);
        EXPECT_EQ(built->report.boundary_cells, 64u * 64 * 2) << "seed " << seed;
        EXPECT_EQ(built->report.largest_cell, 0.25) << "corners too";
    }
}

TEST(SizeField, GivesTheSameCellsInWhateverOrderFacetsCome) {
    for (const Mesh& solid : {mesh::gear(), mesh::torus(3, 1, 24, 12), mesh::displaced_sphere(12)}) {
        const Vec3 extents = solid.bounds().extents();
        const double size = std::max({extents.x, extents.y, extents.z});
        Options options{.precision = size / 4};
        options.curvature.smallest = size / 40;
        options.proximity.smallest = size / 80;
        const Result<Built> built = build(std::span(&solid, 1), options);
        ASSERT_TRUE(built);
        for (std::uint32_t seed = 0; seed < 4; ++seed) {
            const Mesh shuffled = in_another_order(solid, seed);
            const Result<Built> again = build(std::span(&shuffled, 1), options);
            ASSERT_TRUE(again);
            EXPECT_EQ(again->mesh.cells, built->mesh.cells);
        }
    }
}

TEST(SizeField, FindsTheTwoFacetsThatAreWidestApart) {
    // Against all pairs, for directions in caps of many widths and for pairs just on either side of the limit.
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    Box3 content;
    content.add(Vec3{0, 0, 0});
    content.add(Vec3{100, 100, 100});
    const exact::Lattice lattice = *grid_lattice(content);
    int split = 0, whole = 0;
    for (int round = 0; round < 400; ++round) {
        const double spread = 0.02 * std::exp(0.013 * round);
        std::vector<classic::Facet> facets;
        std::vector<std::uint32_t> list;
        std::vector<Vec3> directions;
        for (std::uint32_t i = 0; i < 40; ++i) {
            classic::Facet facet;
            const auto step = [&](double along) {
                return std::array<std::int32_t, 3>{
                    static_cast<std::int32_t>(1000 * (along + spread * normal(random))),
                    static_cast<std::int32_t>(1000 * (1 - along + spread * normal(random))),
                    static_cast<std::int32_t>(1000 * spread * normal(random))};
            };
            facet.corner = {std::array<std::int32_t, 3>{0, 0, 0}, step(1), step(0)};
            const classic::Normal n = normal_of(facet);
            if (n.is_zero()) continue;
            const Vec3 v{static_cast<double>(n.x), static_cast<double>(n.y), static_cast<double>(n.z)};
            directions.push_back((1 / length(v)) * v);
            list.push_back(static_cast<std::uint32_t>(facets.size()));
            facets.push_back(facet);
        }
        double least = 1;
        for (const Vec3& a : directions)
            for (const Vec3& b : directions) least = std::min(least, dot(a, b));
        const double widest = std::acos(std::clamp(least, -1.0, 1.0)) * 180 / 3.14159265358979323846;
        for (const double angle : {30.0, 90.0, widest * (1 - 1e-6), widest * (1 + 1e-6)}) {
            if (!(angle > 0.01 && angle < 179.9)) continue;
            Options options{.precision = 50};
            options.curvature = {.smallest = 1, .angle_degrees = angle};
            const Result<SizeField> field = SizeField::from(options, 1, content, lattice);
            ASSERT_TRUE(field);
            const bool is_split = field->is_too_coarse_for(0, facets, list);
            EXPECT_EQ(is_split, widest > angle) << round << ": " << widest << " and " << angle;
            (is_split ? split : whole) += 1;
        }
    }
    EXPECT_GT(split, 100);
    EXPECT_GT(whole, 100);
}

}  // namespace
}  // namespace octavo::hexmesh
