// SPDX-License-Identifier: Apache-2.0
#include <atomic>
#include <cmath>

#include <octavo/boolean/evaluate.hpp>
#include <octavo/bsp_octree/mill.hpp>
#include <octavo/mesh/shapes.hpp>
#include <octavo/mesh/transform.hpp>

#include "bsp_octree/solid_cases.hpp"

namespace octavo::bsp_octree {
namespace {

/// A spiral over the top of a unit ball, the tool turning on the way.
std::vector<Affine> spiral(int steps) {
    std::vector<Affine> poses;
    for (int i = 0; i < steps; ++i) {
        const double angle = 0.2 * i, polar = 1.2 * i / steps;
        const Vec3 at{std::sin(polar) * std::cos(angle), std::sin(polar) * std::sin(angle), std::cos(polar)};
        poses.push_back(compose(mesh::translation(at), mesh::rotation({1, 2, 3}, 11.0 * i)));
    }
    return poses;
}

TEST(Mill, TakesAwayWhatTheToolCoversAtAllPoses) {
    const mesh::Mesh work = mesh::icosphere(1, 12), tool = mesh::icosphere(0.15, 2);
    const std::vector<Affine> poses = spiral(60);
    const Result<Milled> milled = mill(work, tool, poses);
    ASSERT_TRUE(milled);
    EXPECT_EQ(milled->report.steps, 60U);
    EXPECT_EQ(milled->report.cutting_steps, 60U);
    EXPECT_EQ(milled->report.step_seconds.size(), 60U);
    // The same in one pass over all tools.
    std::vector<mesh::Mesh> operands{work};
    for (const Affine& pose : poses) operands.push_back(mesh::transform(tool, pose));
    const Result<boolean::Evaluated> expected = boolean::subtract(operands);
    ASSERT_TRUE(expected);
    tests::expect_solid(milled->solid, tests::volume_of(expected->mesh), "milled");
    EXPECT_NEAR(measure(milled->solid).area, mesh::measure(expected->mesh).area, 1e-6);
}

TEST(Mill, KeepsMemoryWithinBounds) {
    const mesh::Mesh work = mesh::icosphere(1, 12), tool = mesh::icosphere(0.1, 3);
    std::size_t most = 0;
    double least_volume = 10;
    const Result<Milled> milled = mill(work, tool, spiral(400), {}, {}, [&](const MillStep& step) {
        most = std::max(most, step.solid.store().bytes());
        if (step.number % 100 == 99) {
            const double volume = measure(step.solid).volume;
            EXPECT_LT(volume, least_volume);
            least_volume = volume;
        }
        EXPECT_FALSE(step.changed.empty());
    });
    ASSERT_TRUE(milled);
    EXPECT_GT(milled->report.collections, 0U);
    EXPECT_LT(most, 8 * milled->solid.compacted().store().bytes());
}

TEST(Mill, LeavesAWorkpieceAloneThatTheToolMisses) {
    const mesh::Mesh work = mesh::cube(1), tool = mesh::cube(0.25);
    const std::vector<Affine> poses{mesh::translation({3, 0, 0}), mesh::translation({0, -4, 0})};
    const Result<Milled> milled = mill(work, tool, poses);
    ASSERT_TRUE(milled);
    EXPECT_EQ(milled->report.cutting_steps, 0U);
    tests::expect_solid(milled->solid, 1, "untouched");
}

TEST(Mill, StopsWhenAskedTo) {
    std::atomic<bool> cancel{false};
    Context context;
    context.cancel = &cancel;
    const Result<Milled> milled = mill(mesh::icosphere(1, 8), mesh::cube(0.1), spiral(100), {}, context,
                                       [&](const MillStep& step) { cancel = step.number == 3; });
    ASSERT_FALSE(milled);
    EXPECT_EQ(milled.error().code, ErrorCode::cancelled);
}

TEST(Mill, RefusesAnOpenTool) {
    mesh::Mesh tool = mesh::cube(0.1);
    tool.triangles.pop_back();
    const Result<Milled> milled = mill(mesh::cube(), tool, spiral(3));
    ASSERT_FALSE(milled);
    EXPECT_EQ(milled.error().code, ErrorCode::not_a_solid);
}

}  // namespace
}  // namespace octavo::bsp_octree
