// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include <octavo/mesh/measure.hpp>
#include <octavo/mesh/moments.hpp>
#include <octavo/mesh/shapes.hpp>

namespace octavo::mesh {
namespace {

void expect_same_bits(const Moments& a, const Moments& b) {
    EXPECT_EQ(a.volume, b.volume);
    EXPECT_EQ(a.area, b.area);
    EXPECT_EQ(a.centroid, b.centroid);
    EXPECT_EQ(a.inertia, b.inertia);
}

TEST(Moments, DoNotDependOnWhoAddsWhichFacetsInWhatOrder) {
    Mesh mesh = displaced_sphere(12);
    Box3 bounds;
    for (const Vec3 vertex : mesh.vertices) bounds.add(vertex);
    const Moments expected = moments(mesh);
    expect_same_bits(measure(mesh), expected);
    std::mt19937 random(3);
    for (int round = 0; round < 5; ++round) {
        std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), random);
        std::vector<MomentSum> parts(7, MomentSum(bounds, mesh.triangles.size()));
        for (const Triangle& t : mesh.triangles) {
            const std::size_t first = random() % 3;
            parts[random() % parts.size()].add(mesh.vertices[t[first]], mesh.vertices[t[(first + 1) % 3]],
                                               mesh.vertices[t[(first + 2) % 3]]);
        }
        MomentSum all(bounds, mesh.triangles.size());
        for (const MomentSum& part : parts) all.add(part);
        expect_same_bits(all.moments(), expected);
    }
}

TEST(Moments, OfNothingAreZero) { expect_same_bits(moments(Mesh{}), Moments{}); }

}  // namespace
}  // namespace octavo::mesh
