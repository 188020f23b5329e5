// SPDX-License-Identifier: Apache-2.0
#include <map>
#include <random>

#include <gtest/gtest.h>

#include <octavo/bp_octree/polytope.hpp>

namespace octavo::bp_octree {
namespace {

constexpr double cell_volume = 65536.0 * 65536.0 * 65536.0;

HalfSpace random_half_space(std::mt19937& random) {
    std::normal_distribution<double> normal;
    HalfSpace half;
    half.normal = {normal(random), normal(random), normal(random)};
    const Vec3 centre{32768, 32768, 32768};
    half.offset = dot(half.normal, centre) + 25000 * normal(random) * length(half.normal);
    return half;
}

/// Every edge is used once in each direction.
bool closed(const Polytope& shape) {
    std::map<std::pair<int, int>, int> edges;
    for (std::size_t face = 0; face < shape.face_count(); ++face)
        for (const std::uint32_t* p = shape.begin(face); p != shape.end(face); ++p) {
            const int a = *p, b = p + 1 == shape.end(face) ? *shape.begin(face) : p[1];
            ++edges[{a, b}];
            --edges[{b, a}];
        }
    for (const auto& [edge, balance] : edges)
        if (balance != 0) return false;
    return true;
}

TEST(Polytope, TheCellHasTheVolumeOfTheCell) {
    Polytope cell;
    cell.make_cell();
    EXPECT_DOUBLE_EQ(cell.volume(), cell_volume);
    EXPECT_TRUE(closed(cell));
}

TEST(Polytope, WhatIsRemovedAndWhatRemainsMakeTheWhole) {
    std::mt19937 random(7);
    int cuts = 0;
    for (int i = 0; i < 300; ++i) {
        Polytope shape;
        shape.make_cell();
        for (int k = 0; k < 30 && !shape.empty(); ++k) {
            const HalfSpace half = random_half_space(random);
            const double before = shape.volume(), removed = shape.removed_volume(half);
            const bool cut = shape.clip(half, 6 + k);
            cuts += cut;
            ASSERT_TRUE(closed(shape));
            ASSERT_NEAR(before - removed, shape.volume(), 1e-12 * cell_volume);
            ASSERT_TRUE(cut || removed == 0);
            for (const Vec3& v : shape.vertices()) ASSERT_LE(half.value(v), 1e-6 * 65536);
        }
    }
    EXPECT_GT(cuts, 1000);
}

TEST(Polytope, OctantsFillTheParent) {
    std::mt19937 random(8);
    for (int i = 0; i < 200; ++i) {
        Polytope parent;
        parent.make_cell();
        for (int k = 0; k < 6; ++k) parent.clip(random_half_space(random), 6 + k);
        double sum = 0;
        for (int octant = 0; octant < 8; ++octant) {
            Polytope part;
            part.assign_octant(parent, octant);
            ASSERT_TRUE(closed(part));
            sum += part.volume() / 8;
        }
        EXPECT_NEAR(sum, parent.volume(), 1e-11 * cell_volume);
    }
}

}  // namespace
}  // namespace octavo::bp_octree
