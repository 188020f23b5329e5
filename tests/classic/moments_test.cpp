// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <gtest/gtest.h>

#include <octavo/classic/csg_build.hpp>
#include <octavo/classic/moments.hpp>

namespace octavo::classic {
namespace {

using csg::Expr;

octree::Octree octree_of(const Expr& expression, int depth) {
    CsgBuildOptions options;
    options.depth = depth;
    options.universe = Box3{{-3, -5, 1}, {13, 11, 15}};
    return build(expression, options)->octree;
}

/// The unit cube's octants, black where the bit is set.
octree::Octree octants(unsigned black) {
    octree::DfCode code;
    code.append(octree::Node::split);
    for (unsigned i = 0; i < 8; ++i) code.append(black >> i & 1 ? octree::Node::black : octree::Node::white);
    return octree::Octree(*exact::Lattice::from_parts(-26, {0, 0, 0}), 1, code);
}

TEST(Moments, OfABoxOfCellsAreExact) {
    const Moments m = moments(octants(0b00000011));  // 1 × 1/2 × 1/2
    EXPECT_EQ(m.volume, 0.25);
    EXPECT_EQ(m.centroid, (Vec3{0.5, 0.25, 0.25}));
    EXPECT_DOUBLE_EQ(m.inertia[0][0], 0.25 / 12 * (0.25 + 0.25));
    EXPECT_DOUBLE_EQ(m.inertia[1][1], 0.25 / 12 * (1 + 0.25));
    EXPECT_DOUBLE_EQ(m.inertia[2][2], 0.25 / 12 * (1 + 0.25));
    EXPECT_EQ(m.inertia[0][1], 0);
}

TEST(Moments, OfABallLieBetweenBlackAndGray) {
    const double r = 4, mass = 4.0 / 3 * std::acos(-1.0) * r * r * r;
    Affine place;
    place.m[0][3] = 5, place.m[1][3] = 3, place.m[2][3] = 8;
    const octree::Octree tree = octree_of(csg::transform(place, Expr(csg::Ball{r})), 8);
    const Moments lower = moments(tree), upper = moments(tree, CountedLeaves::black_and_gray);
    EXPECT_LT(lower.volume, mass);
    EXPECT_GT(upper.volume, mass);
    EXPECT_NEAR(lower.centroid.x, 5, 1e-3);
    EXPECT_NEAR(lower.centroid.y, 3, 1e-3);
    EXPECT_NEAR(lower.centroid.z, 8, 1e-3);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_LT(lower.inertia[i][i], 0.4 * mass * r * r);
        EXPECT_GT(upper.inertia[i][i], 0.4 * mass * r * r);
    }
}

TEST(Moments, OffDiagonalInertiaHasTheSignOfTheMassesDistribution) {
    // Two equal cubes on the diagonal x = y: the product of inertia is -∫xy < 0.
    const Moments m = moments(octants(0b00001001));
    EXPECT_DOUBLE_EQ(m.inertia[0][1], -2 * 0.125 * 0.25 * 0.25);
    EXPECT_EQ(m.inertia[0][2], 0);
}

TEST(Moments, OfNothingAreZero) {
    const Moments m = moments(octree_of(csg::nothing(), 3));
    EXPECT_EQ(m.volume, 0);
    EXPECT_EQ(m.inertia[0][0], 0);
}

}  // namespace
}  // namespace octavo::classic
