// SPDX-License-Identifier: Apache-2.0
#include <atomic>
#include <cmath>

#include <octavo/boolean/evaluate.hpp>
#include <octavo/bsp_octree/bso_format.hpp>
#include <octavo/bsp_octree/mill.hpp>
#include <octavo/mesh/shapes.hpp>
#include <octavo/mesh/transform.hpp>

#include "bsp_octree/fingerprint.hpp"
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

/// With vertices on multiples of 2^-12, which every lattice here has.
mesh::Mesh on_grid(mesh::Mesh mesh) {
    for (Vec3& vertex : mesh.vertices)
        for (int axis = 0; axis < 3; ++axis) vertex[axis] = std::nearbyint(vertex[axis] * 4096) / 4096;
    return mesh;
}
std::vector<Affine> on_grid(std::vector<Affine> poses) {
    for (Affine& pose : poses) {
        const Vec3 at = pose({0, 0, 0});
        pose = mesh::translation({std::nearbyint(at.x * 4096) / 4096, std::nearbyint(at.y * 4096) / 4096,
                                  std::nearbyint(at.z * 4096) / 4096});
    }
    return poses;
}

TEST(Mill, GivesExactlyWhatOneDifferenceGives) {
    const mesh::Mesh work = on_grid(mesh::icosphere(1, 12));
    for (const mesh::Mesh& tool : {on_grid(mesh::icosphere(0.15, 2)), on_grid(mesh::icosphere(3, 1)), work,
                                   mesh::cube(0.25), mesh::cube(2)}) {
        const std::vector<Affine> poses = on_grid(spiral(40));
        const Result<Milled> milled = mill(work, tool, poses);
        ASSERT_TRUE(milled);
        std::vector<mesh::Mesh> operands{work};
        for (const Affine& pose : poses) operands.push_back(mesh::transform(tool, pose));
        const auto program = boolean::Program::difference(static_cast<std::uint32_t>(operands.size()));
        EXPECT_TRUE(tests::fingerprint_of(milled->solid) == tests::fingerprint_of(operands, program));
    }
}

TEST(Mill, IsNoCoarserForPosesFarAway) {
    // The tool is parked between cuts; the lattice need not reach that far.
    const mesh::Mesh work = mesh::icosphere(1, 12), tool = mesh::icosphere(0.15, 2);
    std::vector<Affine> poses = spiral(10);
    const Result<Milled> near = mill(work, tool, poses);
    ASSERT_TRUE(near);
    for (const double far : {1e3, 1e9, 1e250}) {
        poses.push_back(mesh::translation({far, 0, -far}));
        poses.push_back(mesh::rotation({1, 2, 3}, 30));
        poses.back().m[0][3] = -far;
    }
    const Result<Milled> milled = mill(work, tool, poses);
    ASSERT_TRUE(milled) << milled.error().describe();
    EXPECT_EQ(milled->report.steps, poses.size());
    EXPECT_EQ(milled->report.cutting_steps, 10U);
    EXPECT_EQ(milled->solid.lattice(), near->solid.lattice());
    tests::expect_same(milled->solid, near->solid, "far away");
}

TEST(Mill, TakesAnOctreeAsItIs) {
    const mesh::Mesh work = mesh::icosphere(1, 12), tool = mesh::icosphere(0.15, 2);
    const std::vector<Affine> poses = spiral(40);
    const std::span all(poses);
    const BspOctree whole = tests::octree_of(work, {}, tests::small_lattice(20));
    ASSERT_TRUE(has_room(whole, tool, poses));
    // In one session or in two with a file between them: the same solid, exactly.
    const Result<Milled> at_once = mill(whole, tool, poses);
    const Result<Milled> first = mill(whole, tool, all.first(25));
    ASSERT_TRUE(at_once && first);
    const Result<BspOctree> stored = decode(encode(first->solid));
    ASSERT_TRUE(stored);
    const Result<Milled> second = mill(*stored, tool, all.subspan(25));
    ASSERT_TRUE(second);
    EXPECT_EQ(second->solid.lattice(), whole.lattice());
    tests::expect_same(second->solid, at_once->solid, "two sessions");
    // An octree on the lattice that holds it just so has no room beside it, but far away needs none.
    const BspOctree tight = build(work)->octree;
    const Affine beside = mesh::translation({1.1, 0, 0}), far = mesh::translation({50, 0, 0});
    EXPECT_FALSE(has_room(tight, mesh::icosphere(2, 2), {&beside, 1}));
    EXPECT_TRUE(has_room(tight, tool, {&far, 1}));
    const Result<Milled> refused = mill(tight, mesh::icosphere(2, 2), {&beside, 1});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::limit);
}

TEST(Mill, RefusesPosesThatLeadNowhere) {
    Affine huge = mesh::scaling({1e200, 1, 1});
    huge.m[0][0] = 1e308, huge.m[0][1] = 1e308;
    const std::vector<Affine> poses{mesh::translation({1, 0, 0}), huge};
    const Result<Milled> milled = mill(mesh::icosphere(1, 4), mesh::cube(100), poses);
    ASSERT_FALSE(milled);
    EXPECT_EQ(milled.error().code, ErrorCode::bad_input);
    EXPECT_NE(milled.error().sentence.find("pose 1"), std::string::npos) << milled.error().sentence;
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
    const std::vector<Affine> poses = spiral(3), far{mesh::translation({9, 9, 9})};
    for (const std::vector<Affine>& path : {poses, far}) {
        const Result<Milled> milled = mill(mesh::cube(), tool, path);
        ASSERT_FALSE(milled);
        EXPECT_EQ(milled.error().code, ErrorCode::not_a_solid);
        EXPECT_EQ(milled.error().place.operand, 1U);
    }
    EXPECT_EQ(mill(tool, mesh::cube(), poses).error().place.operand, 0U);
}

}  // namespace
}  // namespace octavo::bsp_octree
