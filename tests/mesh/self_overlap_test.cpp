// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <atomic>

#include <gtest/gtest.h>

#include <octavo/mesh/self_overlap.hpp>
#include <octavo/mesh/snap.hpp>
#include <octavo/mesh/transform.hpp>

#include "surfaces.hpp"

namespace octavo::mesh {
namespace {

Mesh both(const Mesh& a, const Mesh& b) { return join(std::array{a, b}); }

Mesh reversed(Mesh mesh) {
    for (Triangle& t : mesh.triangles) std::swap(t[0], t[1]);
    return mesh;
}

/// The facets that are found, and that there are such facets.
std::vector<FaceIndex> overlap_of(const Mesh& mesh) {
    const Result<Snapped> snapped = snap(mesh);
    EXPECT_TRUE(snapped);
    const Result<std::vector<FaceIndex>> found = find_self_overlap(snapped->mesh);
    EXPECT_TRUE(found);
    for (const FaceIndex face : *found) EXPECT_LT(face, mesh.triangles.size());
    return *found;
}

bool overlaps(const Mesh& mesh) { return !overlap_of(mesh).empty(); }

TEST(SelfOverlap, IsInNoSolidThatIsSound) {
    for (const tests::NamedMesh& named : tests::generated_solids()) {
        EXPECT_FALSE(overlaps(named.mesh)) << named.name;
        EXPECT_TRUE(overlaps(reversed(named.mesh))) << named.name;
    }
    EXPECT_FALSE(overlaps(Mesh{}));
}

TEST(SelfOverlap, IsSeenHoweverThinItIs) {
    const Mesh cube = box({0, 0, 0}, {4, 4, 4});
    for (const double depth : {1.0, 1e-3, 1e-6}) {
        const Mesh beside = box({4 - depth, 0.5, 0.5}, {8, 3.5, 3.5});
        const std::vector<FaceIndex> faces = overlap_of(both(cube, beside));
        ASSERT_EQ(faces.size(), 2u) << depth;
        EXPECT_LT(std::min(faces[0], faces[1]), cube.triangles.size());
        EXPECT_GE(std::max(faces[0], faces[1]), cube.triangles.size());
    }
    EXPECT_TRUE(overlaps(both(cube, box({4 - 1e-6, 0, 0}, {8, 4, 4})))) << "faces in common planes";
}

TEST(SelfOverlap, IsWhereAWholeShellCountsTwiceOrLessThanNothing) {
    const Mesh cube = box({0, 0, 0}, {4, 4, 4}), small = box({1, 1, 1}, {1.001, 1.001, 1.001});
    EXPECT_TRUE(overlaps(both(cube, small))) << "a body within a body";
    EXPECT_FALSE(overlaps(both(cube, reversed(small)))) << "a cavity";
    EXPECT_FALSE(overlaps(
        join(std::array{cube, reversed(box({1, 1, 1}, {3, 3, 3})), box({2, 2, 2}, {2.5, 2.5, 2.5})})))
        << "a body in a cavity";
    const Mesh aside = box({5, 5, 5}, {5.001, 5.001, 5.001});
    EXPECT_FALSE(overlaps(both(cube, aside)));
    EXPECT_TRUE(overlaps(both(cube, reversed(aside)))) << "less than nothing";
    EXPECT_TRUE(overlaps(both(cube, cube))) << "twice the same";
    EXPECT_FALSE(overlaps(join(std::array{cube, cube, reversed(cube)}))) << "twice, and once taken away";
    EXPECT_FALSE(overlaps(both(cube, reversed(cube)))) << "nothing";
}

TEST(SelfOverlap, IsNotContact) {
    const Mesh cube = box({0, 0, 0}, {4, 4, 4});
    EXPECT_FALSE(overlaps(both(cube, box({4, 0, 0}, {8, 4, 4})))) << "a common face";
    EXPECT_FALSE(overlaps(both(cube, box({4, 1, 1}, {8, 3, 3})))) << "a face in a face";
    EXPECT_FALSE(overlaps(both(cube, box({4, 2, 2}, {8, 6, 6})))) << "faces in part";
    EXPECT_FALSE(overlaps(both(cube, box({4, 4, 0}, {8, 8, 4})))) << "a common edge";
    EXPECT_FALSE(overlaps(both(cube, box({4, 4, 2}, {8, 8, 6})))) << "edges in part";
    EXPECT_FALSE(overlaps(both(cube, box({4, 4, 4}, {8, 8, 8})))) << "a common corner";
    EXPECT_FALSE(
        overlaps(join(std::array{cube, reversed(box({1, 1, 1}, {3, 3, 3})), box({1, 1, 1}, {3, 2, 2})})))
        << "a body against the walls of a cavity";
    EXPECT_FALSE(
        overlaps(join(std::array{cube, reversed(box({1, 1, 1}, {3, 3, 3})), box({1, 1, 1}, {3, 3, 3})})))
        << "a filled cavity";
}

TEST(SelfOverlap, IsInABodyThatHangsInsideOutAtAnEdge) {
    const Mesh large = box({0, 0, 0}, {4, 4, 4}), small = box({4, 4, 0}, {5, 5, 4});
    EXPECT_FALSE(overlaps(both(large, small)));
    EXPECT_TRUE(overlaps(both(large, reversed(small))));
    EXPECT_TRUE(overlaps(both(reversed(large), small)));
}

TEST(SelfOverlap, IsNotAPatchThatIsFoldedFlat) {
    // The middle of the upper face is pushed past its rim within the plane.
    Mesh mesh = box({0, 0, 0}, {4, 4, 4});
    const auto middle = static_cast<VertexIndex>(mesh.vertices.size());
    mesh.vertices.push_back({5, 2, 4});
    std::vector<Triangle> triangles;
    for (const Triangle& t : mesh.triangles) {
        const auto is_on_top = [&](VertexIndex v) { return mesh.vertices[v].z == 4; };
        if (!std::all_of(t.begin(), t.end(), is_on_top)) {
            triangles.push_back(t);
            continue;
        }
        for (std::size_t k = 0; k < 3; ++k) triangles.push_back({t[k], t[(k + 1) % 3], middle});
    }
    mesh.triangles = triangles;
    EXPECT_FALSE(overlaps(mesh));
}

TEST(SelfOverlap, IsCrossingAloneWhereTheSurfaceIsOpen) {
    Mesh open = box({0, 0, 0}, {4, 4, 4});
    open.triangles.pop_back();
    EXPECT_FALSE(overlaps(open));
    EXPECT_FALSE(overlaps(reversed(open)));
    EXPECT_TRUE(overlaps(both(open, box({3, 3, 3}, {8, 8, 8}))));
}

TEST(SelfOverlap, CanBeCancelled) {
    const Result<Snapped> snapped = snap(icosphere(1, 10));
    const std::atomic<bool> cancel = true;
    const auto found = find_self_overlap(snapped->mesh, {.on_progress = {}, .cancel = &cancel});
    ASSERT_FALSE(found);
    EXPECT_EQ(found.error().code, ErrorCode::cancelled);
}

}  // namespace
}  // namespace octavo::mesh
