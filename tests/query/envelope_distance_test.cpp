// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <octavo/bp_octree/build.hpp>
#include <octavo/query/envelope_distance.hpp>

#include "bp_octree/solids.hpp"

namespace octavo::query {
namespace {

class Envelopes : public testing::Test {
  protected:
    Envelopes() {
        mesh_ = tests::on_lattice(tests::bumpy_sphere(5));
        bp_octree::BuildOptions options;
        options.leaf_triangles = 8;
        tree_ = std::move(bp_octree::build(mesh_, options)).value();
        exact_.emplace(std::move(ClosestQuery::build(tree_.mesh)).value());
        std::mt19937_64 random(9);
        std::uniform_real_distribution<double> unit(-2.5, 2.5);
        for (int i = 0; i < 3000; ++i) points_.push_back({unit(random), unit(random), unit(random)});
    }

    mesh::LatticeMesh mesh_;
    bp_octree::BpOctree tree_;
    std::optional<ClosestQuery> exact_;
    std::vector<Vec3> points_;
};

TEST_F(Envelopes, BoundsNeverExceedTheDistanceAndGrowWithTheLevel) {
    std::vector<double> before(points_.size(), 0);
    double error_before = 1e300;
    for (int level = 0; level <= tree_.deepest(); ++level) {
        const std::vector<double> bounds = EnvelopeDistance(tree_, level)(points_);
        double error = 0;
        for (std::size_t i = 0; i < points_.size(); ++i) {
            const double distance = std::max(0.0, (*exact_)(points_[i]).distance);
            ASSERT_LE(bounds[i], distance) << "level " << level << ", point " << i;
            ASSERT_GE(bounds[i], before[i] * (1 - 1e-12));
            error += distance - bounds[i];
        }
        EXPECT_LE(error, error_before);
        error_before = error;
        before = bounds;
    }
    EXPECT_LT(error_before / static_cast<double>(points_.size()), 0.03) << "of points 2.5 from the middle";
    EXPECT_TRUE(std::isnan(EnvelopeDistance(tree_, 2)({std::nan(""), 0, 0})));
    EXPECT_TRUE(std::isinf(EnvelopeDistance(tree_, 2)({0, -std::numeric_limits<double>::infinity(), 0})));
}

TEST_F(Envelopes, BoundsNearlyTheDistanceFromAnyFarPoint) {
    const EnvelopeDistance bound(tree_, 2);
    for (const double far : {1e6, 1e100, 1e146, 1e150, 1e270, 1e300, 1.7e308}) {
        EXPECT_LE(bound({far, 0, 0}), far);
        EXPECT_GE(bound({far, 0, 0}), far * (1 - 1e-5));
    }
    const double most = std::numeric_limits<double>::max();
    EXPECT_EQ(bound({most, most, -most}), most);
}

TEST_F(Envelopes, ALeafIsRightWhereItSaysSoAndNeverTooNear) {
    int answers = 0, exact = 0;
    std::mt19937_64 random(10);
    std::normal_distribution<double> near(0, 0.01);
    for (const mesh::Triangle& t : tree_.mesh.triangles) {
        Vec3 point = tree_.mesh.lattice.to_world(tree_.mesh.points[t[0]]);
        point = point + Vec3{near(random), near(random), near(random)};
        const std::optional<LeafDistance> leaf = distance_in_leaf(tree_, point);
        if (!leaf) continue;
        ++answers;
        const Closest closest = (*exact_)(point);
        ASSERT_GE(leaf->distance, std::fabs(closest.distance) * (1 - 1e-12));
        if (!leaf->is_exact) continue;
        ++exact;
        ASSERT_EQ(leaf->distance, std::fabs(closest.distance));
        ASSERT_EQ(leaf->triangle, closest.triangle);
    }
    EXPECT_GT(exact, 1000);
    EXPECT_GT(answers, exact);
    EXPECT_FALSE(distance_in_leaf(tree_, {50, 0, 0}).has_value());
    EXPECT_FALSE(distance_in_leaf(tree_, {std::nan(""), 0, 0}).has_value());
    EXPECT_FALSE(distance_in_leaf(tree_, {0, 0, 0}).has_value()) << "the middle is black";
}

}  // namespace
}  // namespace octavo::query
