// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <atomic>
#include <random>

#include <octavo/boolean/evaluate.hpp>
#include <octavo/mesh/shapes.hpp>

#include "bsp_octree/fingerprint.hpp"
#include "bsp_octree/solid_cases.hpp"
#include "effort.hpp"

namespace octavo::bsp_octree {
namespace {

using tests::Convex;
using tests::expect_same;
using tests::fine;
using tests::octree_of;

mesh::Mesh moved(mesh::Mesh mesh, Vec3 by, double scale = 1) {
    for (Vec3& vertex : mesh.vertices) vertex = scale * vertex + by;
    return mesh;
}

mesh::Mesh cube(double x, double y, double z, double side = 1) {
    return moved(tests::box({0, 0, 0}, {1, 1, 1}).mesh, {x, y, z}, side);
}

/// Volumes of A ∩ B, A and B, found by trying all triples of planes in integers.
struct Volumes {
    tests::Rational first, second, both;
};
Volumes volumes_of(const Convex& first, const Convex& second) {
    std::vector<tests::HalfSpace> sides = first.sides;
    sides.insert(sides.end(), second.sides.begin(), second.sides.end());
    return {tests::exact_volume(first.sides), tests::exact_volume(second.sides), tests::exact_volume(sides)};
}

/// Nothing is rounded on either side: in both engines it is the same solid.
void expect_same_in_both(const BspOctree& ours, std::span<const mesh::Mesh> operands,
                         const boolean::Program& program, const std::string& what) {
    EXPECT_TRUE(tests::fingerprint_of(ours) == tests::fingerprint_of(operands, program)) << what;
}

/// As `expect_solid`; and the mesh, whose vertices are rounded to 2^-40, has the volume that this leaves it.
void expect_volume(const BspOctree& octree, const tests::Rational& volume, const std::string& what) {
    const auto expected = static_cast<double>(volume);
    tests::expect_solid(octree, expected, what);
    EXPECT_NEAR(tests::volume_of(to_mesh(octree)->mesh), expected, 1e-11 * (1 + expected)) << what;
}

class RandomConvexBodies : public testing::TestWithParam<std::tuple<int, std::uint32_t>> {};

TEST_P(RandomConvexBodies, GiveTheVolumesThatRationalClippingGives) {
    const auto [side, planes] = GetParam();
    for (int run = 0; run < 150 * tests::effort() && !HasFailure(); ++run) {
        std::mt19937 random(static_cast<unsigned>(run * 100 + side));
        const Convex a = tests::random_convex(random, side);
        const Convex b = run % 8 == 7 ? a : tests::random_convex(random, side);
        const Volumes volume = volumes_of(a, b);
        const BspOctree first = octree_of(a.mesh, fine(planes)), second = octree_of(b.mesh, fine(planes));
        const std::string what = "run " + std::to_string(run);
        expect_volume(*first.intersect(second), volume.both, what + " intersection");
        expect_volume(*first.unite(second), volume.first + volume.second - volume.both, what + " union");
        expect_volume(*first.subtract(second), volume.first - volume.both, what + " difference");
        const std::array<mesh::Mesh, 2> operands{a.mesh, b.mesh};
        using boolean::Program;
        expect_same_in_both(*first.intersect(second), operands, Program::intersection(2), what);
        expect_same_in_both(*first.unite(second), operands, Program::union_of(2), what);
        expect_same_in_both(*first.subtract(second), operands, Program::difference(2), what);
    }
}

INSTANTIATE_TEST_SUITE_P(Sizes, RandomConvexBodies,
                         testing::Combine(testing::Values(2, 3, 5), testing::Values(1U, 4U, 16U)));

TEST(SetOperations, KeepTheLawsOfSetsExactly) {
    for (int run = 0; run < 60 * tests::effort() && !HasFailure(); ++run) {
        std::mt19937 random(static_cast<unsigned>(run));
        const std::uint32_t planes = run % 3 == 0 ? 1 : run % 3 == 1 ? 4 : 16;
        const auto solid = [&] { return octree_of(tests::random_convex(random, 4).mesh, fine(planes)); };
        const BspOctree a = solid(), b = solid(), c = solid();
        const std::string what = "run " + std::to_string(run);
        expect_same(*a.unite(b), *b.unite(a), what + ": A ∪ B = B ∪ A");
        expect_same(*a.intersect(b), *b.intersect(a), what + ": A ∩ B = B ∩ A");
        expect_same(*a.subtract(*b.unite(c)), *a.subtract(b)->subtract(c),
                    what + ": A − (B ∪ C) = A − B − C");
        expect_same(*a.intersect(*b.unite(c)), *a.intersect(b)->unite(*a.intersect(c)),
                    what + ": distribution");
        expect_same(*a.unite(b), a.complement().intersect(b.complement())->complement(),
                    what + ": De Morgan");
        expect_same(*a.subtract(b)->unite(*a.intersect(b)), a, what + ": A − B ∪ A ∩ B = A");
        EXPECT_TRUE(a.subtract(a)->is_empty()) << what;
        EXPECT_TRUE(a.intersect(a.complement())->is_empty()) << what;
        EXPECT_TRUE(a.unite(a.complement())->is_everything()) << what;
        EXPECT_EQ(a.complement().complement().root(), a.root()) << what;
    }
}

TEST(SetOperations, AgreeWithBooleansOfMeshesOnSolidsOfManyFacets) {
    const mesh::Mesh shapes[] = {mesh::icosphere(3, 6), moved(mesh::torus(3, 1.25, 24, 12), {1, 0.5, 0.25}),
                                 moved(mesh::displaced_sphere(5), {1.5, -0.5, 0.75}, 2), mesh::gear()};
    const exact::Lattice lattice = tests::small_lattice(12);
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t k = 0; k < 4; ++k) {
            if (i == k) continue;
            // Both engines must get the same vertices, those on the lattice.
            std::vector<mesh::Mesh> operands{shapes[i], shapes[k]};
            for (mesh::Mesh& mesh : operands)
                for (Vec3& vertex : mesh.vertices) vertex = lattice.to_world(lattice.snap(vertex));
            const BspOctree first = octree_of(operands[0], fine(8), lattice),
                            second = octree_of(operands[1], fine(16), lattice);
            const std::string what = std::to_string(i) + " and " + std::to_string(k);
            const auto check = [&](const BspOctree& ours, const Result<boolean::Evaluated>& theirs) {
                ASSERT_TRUE(theirs);
                const mesh::Moments expected = mesh::moments(theirs->mesh), found = measure(ours);
                tests::expect_solid(ours, expected.volume, what);
                EXPECT_NEAR(found.area, expected.area, 1e-9 * expected.area) << what;
                EXPECT_NEAR(length(found.centroid - expected.centroid), 0, 1e-8) << what;
            };
            check(*first.unite(second), boolean::unite(operands));
            check(*first.intersect(second), boolean::intersect(operands));
            check(*first.subtract(second), boolean::subtract(operands));
            using boolean::Program;
            expect_same_in_both(*first.unite(second), operands, Program::union_of(2), what);
            expect_same_in_both(*first.intersect(second), operands, Program::intersection(2), what);
            expect_same_in_both(*first.subtract(second), operands, Program::difference(2), what);
        }
}

/// Solids that touch in a face, a part of one, an edge, a vertex, or are the same.
TEST(SetOperations, TakeContactsOfAllKinds) {
    const struct {
        mesh::Mesh other;
        double both;
    } cases[] = {{cube(0, 0, 0), 1},
                 {cube(1, 0, 0), 0},
                 {cube(1, 0.5, 0.25), 0},
                 {cube(1, 1, 0), 0},
                 {cube(1, 1, 1), 0},
                 {cube(0.5, 0, 0), 0.5},
                 {cube(0, 0, 0, 2), 1},
                 {cube(0.25, 0.25, 0.25, 0.5), 0.125},
                 {cube(0.5, 0, 0, 0.5), 0.125},
                 {cube(2, 0, 0), 0}};
    for (const std::uint32_t planes : {1U, 3U, 16U})
        for (const auto& [other, both] : cases) {
            const BspOctree a = octree_of(cube(0, 0, 0), fine(planes)), b = octree_of(other, fine(planes));
            const double volume = tests::volume_of(other);
            const std::string what = "volumes 1 and " + std::to_string(volume);
            tests::expect_solid(*a.intersect(b), both, what);
            tests::expect_solid(*a.unite(b), 1 + volume - both, what);
            tests::expect_solid(*a.subtract(b), 1 - both, what);
            tests::expect_solid(*b.subtract(a), volume - both, what);
        }
}

TEST(SetOperations, CoplanarFacesBecomeOneAgain) {
    // Two boxes side by side are one box: six faces of two triangles.
    const BspOctree a = octree_of(cube(0, 0, 0)), b = octree_of(cube(1, 0, 0));
    EXPECT_EQ(to_mesh(*a.unite(b))->mesh.triangles.size(), 12U);
}

TEST(SetOperations, ChainsOfManyOperandsGiveWhatOnePassGives) {
    // Bodies that touch and coincide all the time, one after the other here and all at once in boolean/.
    for (int run = 0; run < 20 * tests::effort() && !HasFailure(); ++run) {
        std::mt19937 random(static_cast<unsigned>(run));
        std::vector<mesh::Mesh> operands{tests::box({0, 0, 0}, {6, 6, 6}).mesh};
        BspOctree rest = octree_of(operands[0], fine(run % 2 ? 1 : 16));
        BspOctree all = rest;
        for (int i = 0; i < 20; ++i) {
            operands.push_back(moved(tests::random_convex(random, 4).mesh,
                                     {static_cast<double>(random() % 6), static_cast<double>(random() % 6),
                                      static_cast<double>(random() % 6)}));
            const BspOctree next = octree_of(operands.back(), fine(run % 2 ? 1 : 16));
            rest = *rest.subtract(next);
            all = *all.unite(next);
        }
        const auto count = static_cast<std::uint32_t>(operands.size());
        const std::string what = "run " + std::to_string(run);
        expect_same_in_both(rest, operands, boolean::Program::difference(count), what + ", difference");
        expect_same_in_both(all, operands, boolean::Program::union_of(count), what + ", union");
    }
}

TEST(SetOperations, StopWhenAskedTo) {
    const BspOctree a = octree_of(mesh::icosphere(20, 24), fine(16), tests::small_lattice(12)),
                    b = octree_of(mesh::torus(18, 6, 40, 20), fine(16), tests::small_lattice(12));
    std::atomic<bool> cancel{false};
    std::vector<double> done;
    Context context;
    context.cancel = &cancel;
    context.on_progress = [&](std::string_view, double at) { done.push_back(at); };
    ASSERT_TRUE(a.subtract(b, nullptr, context));
    ASSERT_GT(done.size(), 20U);
    EXPECT_TRUE(std::is_sorted(done.begin(), done.end()));
    EXPECT_NEAR(done.back(), 1, 0.02);
    context.on_progress = [&](std::string_view, double at) { cancel = at > 0.5; };
    const Result<BspOctree> stopped = a.subtract(b, nullptr, context);
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().code, ErrorCode::cancelled);
    cancel = false;
    expect_same(*a.subtract(b), *a.subtract(b, nullptr, {}), "what was given up leaves nothing behind");
}

/// A cube in octant 0 of the universe. The rest has `label`, and octant 7 is a leaf for it: its tree's plane passes by
/// the cell. No operation makes such trees; a file may hold them.
BspOctree with_needless_tree(bsp::Label label) {
    const BspOctree base = octree_of(cube(-50, -50, -50, 2));
    const std::shared_ptr<Store> store = base.shared_store();
    const std::size_t begin = store->nodes.size();
    constexpr std::int32_t below = exact::universe_side / 2 - 9;
    const bsp::PlaneId plane = store->planes.add({1, 1, below}, {9, 1, below}, {1, 9, below}).plane();
    store->nodes.push_back({plane, bsp::Child::leaf(label), bsp::Child::leaf(bsp::opposite(label))});
    const NodeRef needless = store->add_leaf(begin);
    Octants octants;
    octants.fill(NodeRef::uniform(label));
    octants[0] = base.root().complement_if(label == bsp::Label::in);
    octants[7] = needless;
    return {base.lattice(), base.options(), store, store->add_gray(octants)};
}

TEST(SetOperations, TakeTreesWithoutFaces) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> at(-70, 70);
    const auto expect_same_points = [&](const BspOctree& first, const BspOctree& second, const char* what) {
        for (int i = 0; i < 300; ++i) {
            const Vec3 point{at(random), at(random), at(random)};
            ASSERT_EQ(first.classify(point), second.classify(point)) << what;
        }
    };
    for (const bsp::Label label : {bsp::Label::out, bsp::Label::in}) {
        const BspOctree needless = with_needless_tree(label), other = with_needless_tree(label);
        const BspOctree plain = octree_of(cube(-50, -50, -50, 2));
        const BspOctree lean = label == bsp::Label::out ? plain : plain.complement();
        expect_same_points(needless, lean, "as it is");
        expect_same_points(*needless.intersect(other), lean, "the intersection of two");
        expect_same_points(*needless.unite(other), lean, "the union of two");
        for (const mesh::Mesh& mesh :
             {cube(-60, -60, -60, 120), cube(20, 20, 20, 10), cube(-51, -51, -51, 4)}) {
            const BspOctree tool = octree_of(mesh);
            expect_same_points(*needless.subtract(tool), *lean.subtract(tool), "less a tool");
            expect_same_points(*needless.unite(tool), *lean.unite(tool), "with a tool");
            expect_same_points(*tool.subtract(needless), *tool.subtract(lean), "taken from a tool");
        }
    }
}

TEST(SetOperations, RefuseSolidsOnDifferentLattices) {
    const BspOctree a = octree_of(cube(0, 0, 0)), b = octree_of(cube(0, 0, 0), {}, tests::small_lattice(5));
    const Result<BspOctree> result = a.unite(b);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::bad_input);
}

TEST(SetOperations, LeaveVersionsAloneAndShareWhatTheyDoNotTouch) {
    const BspOctree before = octree_of(mesh::icosphere(20, 24), fine(16), tests::small_lattice(12));
    const Stats stats = before.stats();
    const std::size_t nodes = before.store().nodes.size();
    Edit edit;
    const BspOctree after =
        *before.subtract(octree_of(cube(19, -0.5, -0.5), fine(16), tests::small_lattice(12)), &edit);
    EXPECT_EQ(before.stats().bsp_nodes, stats.bsp_nodes);
    // The tool's nodes and those of the cells that it touches were added, and no more.
    EXPECT_LT(after.store().nodes.size() - nodes, nodes / 10);
    EXPECT_FALSE(edit.changed.empty());
    EXPECT_GT(edit.merged_cells, 0U);
    // What changed lies about the tool.
    const exact::Lattice lattice = before.lattice();
    for (const octree::Cell& cell : edit.changed) {
        const Vec3 low = lattice.to_world(cell.low), high = lattice.to_world(cell.high());
        EXPECT_TRUE(low.x <= 20 && high.x >= 19 && low.y <= 0.5 && high.y >= -0.5 && low.z <= 0.5 &&
                    high.z >= -0.5)
            << low.x << ' ' << low.y << ' ' << low.z << " to " << high.x << ' ' << high.y << ' ' << high.z;
    }
    expect_same(*after.unite(*before.subtract(after)), before, "the part put back");
}

TEST(SetOperations, LongChainsStayExactAndSmall) {
    // A box is cut away and filled again, crookedly, a thousand times; in the end it is the box, in few cells.
    const BspOctree start = octree_of(tests::box({-8, -8, -8}, {8, 8, 8}).mesh, {}, tests::small_lattice(16));
    BspOctree solid = start;
    std::mt19937 random(1);
    std::uniform_real_distribution<double> at(-8, 8);
    const mesh::Mesh tool = mesh::icosphere(1.5, 2);
    std::vector<BspOctree> bites;
    MeshOptions trusting;
    trusting.surface = SurfaceCheck::trust;
    std::size_t most_bytes = 0;
    for (int step = 0; step < 500; ++step) {
        const BspOctree bite =
            octree_of(moved(tool, {at(random), at(random), at(random)}), trusting, tests::small_lattice(16));
        bites.push_back(*solid.intersect(bite));
        solid = *solid.subtract(bite);
        EXPECT_LE(solid.stats().deepest, 12) << step;
        most_bytes = std::max(most_bytes, solid.store().bytes());
        if (step % 50 == 49) solid = solid.compacted();
    }
    double removed = 0;
    for (const BspOctree& bite : bites) removed += measure(bite).volume;
    tests::expect_solid(solid, 16 * 16 * 16 - removed, "after 500 cuts");
    const std::size_t bytes = solid.compacted().store().bytes();
    for (std::size_t i = bites.size(); i-- > 0;) {
        solid = *solid.unite(bites[i]);
        EXPECT_LE(solid.stats().deepest, 12) << i;
        most_bytes = std::max(most_bytes, solid.store().bytes());
        if (i % 50 == 0) solid = solid.compacted();
    }
    EXPECT_LT(most_bytes, 8 * bytes) << "old versions are thrown away";
    expect_same(solid, start, "after putting all back");
    EXPECT_LE(solid.stats().bsp_nodes, 100U);
    EXPECT_LE(solid.stats().deepest, 3);
}

}  // namespace
}  // namespace octavo::bsp_octree
