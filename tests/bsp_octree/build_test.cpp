// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <atomic>
#include <random>

#include <octavo/bsp_octree/borders.hpp>
#include <octavo/io/read.hpp>
#include <octavo/mesh/shapes.hpp>
#include <octavo/mesh/snap.hpp>
#include <octavo/mesh/transform.hpp>
#include <octavo/query/inside.hpp>

#include "bsp/sliver_cap.hpp"
#include "bsp_octree/fingerprint.hpp"
#include "bsp_octree/solid_cases.hpp"
#include "models.hpp"

namespace octavo::bsp_octree {
namespace {

using tests::fine;

/// A cube around the last lattice point of small_lattice(20).
mesh::Mesh moved_to_border() {
    mesh::Mesh mesh = mesh::cube(0.5);
    const Vec3 last = tests::small_lattice(20).to_world({exact::universe_side - 1, 5, 5});
    for (Vec3& vertex : mesh.vertices) vertex.x = vertex.x > 0 ? last.x : last.x - 0.5;
    return mesh;
}

/// The solid of a mesh comes back exactly: same volume as an integer, and nothing that is not in both.
void expect_round_trip(const mesh::Mesh& mesh, const MeshOptions& options, const std::string& what) {
    const Result<mesh::Snapped> snapped = mesh::snap(mesh);
    ASSERT_TRUE(snapped);
    const exact::Lattice lattice = snapped->mesh.lattice;
    const Result<Built> built = build(mesh, lattice, options);
    ASSERT_TRUE(built) << what << ": " << built.error().describe();
    const Result<ToMesh> back = to_mesh(built->octree);
    ASSERT_TRUE(back) << what << ": " << back.error().describe();
    EXPECT_EQ(tests::manifold_defect(back->mesh), "") << what;
    EXPECT_LE(back->mesh.triangles.size(), mesh.triangles.size()) << what;
    const Result<mesh::Snapped> again = mesh::snap(back->mesh, lattice);
    ASSERT_TRUE(again);
    EXPECT_EQ(again->report.moved_vertices, 0U) << what << ": all vertices are vertices of the input";
    EXPECT_TRUE(mesh::exact_volume6(again->mesh) == mesh::exact_volume6(snapped->mesh)) << what;
    const Result<Built> second = build(back->mesh, lattice, options);
    ASSERT_TRUE(second);
    tests::expect_same(built->octree, second->octree, what);
}

TEST(Build, GivesBackWhatItGot) {
    const mesh::Mesh shapes[] = {mesh::cube(),
                                 mesh::tetrahedron(),
                                 mesh::icosphere(1, 8),
                                 mesh::torus(3, 1, 20, 10),
                                 mesh::gear(),
                                 mesh::bearing_housing(),
                                 mesh::knot_tube(2, 3, 0.3, 60, 8),
                                 mesh::displaced_sphere(8),
                                 mesh::menger_sponge(2),
                                 mesh::cone(1, 0, 3, 200),
                                 mesh::cylinder(1, 20, 300)};
    constexpr int compact = 4;
    int number = 0;
    for (const mesh::Mesh& mesh : shapes) {
        ++number;
        for (const std::uint32_t planes : {4U, 16U, 64U})
            expect_round_trip(mesh, fine(planes),
                              "shape " + std::to_string(number) + ", " + std::to_string(planes) + " planes");
        MeshOptions options;
        options.octree.stop = StopRule::common_point;
        // Side by side, slivers share no point, and cells as small as they are narrow are many.
        if (number <= compact)
            expect_round_trip(mesh, options, "shape " + std::to_string(number) + ", common point");
        for (const bsp::Partition partition : {bsp::Partition::random, bsp::Partition::first}) {
            options = {};
            options.octree.tree.partition = partition;
            expect_round_trip(mesh, options, "shape " + std::to_string(number) + ", other partition");
        }
    }
}

TEST(Build, OfSliversSideBySideIsSmall) {
    const mesh::Mesh cap = tests::sliver_cap(250, 0x1p-20);
    expect_round_trip(cap, {}, "cap");
    const Result<Built> built = build(cap);
    ASSERT_TRUE(built);
    EXPECT_FALSE(built->report.resolved);
    EXPECT_LT(built->octree.stats().bsp_nodes, 20 * cap.triangles.size());
}

TEST(Build, OfSliversSideBySideTakesSetOperations) {
    std::array<mesh::Mesh, 2> caps{tests::sliver_cap(60, 0x1p-20), tests::sliver_cap(60, 0x1p-20)};
    for (Vec3& vertex : caps[1].vertices) vertex = vertex + Vec3{0x1p-4, 0x1p-12, 0x1p-20};
    Box3 bounds = caps[0].bounds();
    bounds.add(caps[1].bounds());
    const exact::Lattice lattice = *exact::Lattice::fit(bounds);
    const Result<Built> first = build(caps[0], lattice), second = build(caps[1], lattice);
    ASSERT_TRUE(first && second);
    using boolean::Program;
    EXPECT_TRUE(tests::fingerprint_of(*first->octree.unite(second->octree)) ==
                tests::fingerprint_of(caps, Program::union_of(2)));
    EXPECT_TRUE(tests::fingerprint_of(*first->octree.subtract(second->octree)) ==
                tests::fingerprint_of(caps, Program::difference(2)));
    EXPECT_TRUE(first->octree.subtract(first->octree)->is_empty());
}

TEST(Build, GivesBackTurnedShapes) {
    // Off the axes nothing is a short number any more.
    Affine turn;
    turn.m = {{{0.36, 0.48, -0.8, 0.1}, {-0.8, 0.6, 0, 0.2}, {0.48, 0.64, 0.6, 0.3}}};
    for (mesh::Mesh mesh : {mesh::gear(), mesh::bearing_housing(), mesh::menger_sponge(1)}) {
        for (Vec3& vertex : mesh.vertices) vertex = turn(vertex);
        // Faces of many triangles are not plane any more on the lattice, and may then cross; that is resolved.
        const Result<Built> built = build(mesh);
        ASSERT_TRUE(built);
        const Result<ToMesh> back = to_mesh(built->octree);
        ASSERT_TRUE(back);
        EXPECT_EQ(tests::manifold_defect(back->mesh), "");
        const double volume = tests::volume_of(mesh);
        EXPECT_NEAR(tests::volume_of(back->mesh), volume, 1e-7 * volume);
    }
}

TEST(Build, ResolvesSurfacesThatMeetThemselves) {
    const auto box = [](tests::Grid low, tests::Grid high) { return tests::box(low, high).mesh; };
    const auto volume = [](const mesh::Mesh& mesh) {
        const Result<Built> built = build(mesh);
        EXPECT_TRUE(built);
        EXPECT_TRUE(built->report.resolved);
        return measure(built->octree).volume;
    };
    // Overlapping, nested the same way, sharing a face, and twice the same.
    EXPECT_NEAR(volume(tests::joined({box({0, 0, 0}, {2, 2, 2}), box({1, 1, 1}, {3, 3, 3})})), 15, 1e-6);
    EXPECT_NEAR(volume(tests::joined({box({0, 0, 0}, {3, 3, 3}), box({1, 1, 1}, {2, 2, 2})})), 27, 1e-6);
    EXPECT_NEAR(volume(tests::joined({box({0, 0, 0}, {1, 1, 1}), box({1, 0, 0}, {2, 1, 1})})), 2, 1e-6);
    EXPECT_NEAR(volume(tests::joined({box({0, 0, 0}, {1, 1, 1}), box({0, 0, 0}, {1, 1, 1})})), 1, 1e-6);
}

/// A box of a grid whose sides are cut at a height between.
mesh::Mesh ringed_box(Vec3 low, Vec3 high, double ring) {
    mesh::Mesh mesh;
    for (const double z : {low.z, ring, high.z})
        for (const auto& [x, y] :
             {std::pair{low.x, low.y}, {high.x, low.y}, {high.x, high.y}, {low.x, high.y}})
            mesh.vertices.push_back({x, y, z});
    mesh.triangles = {{0, 2, 1}, {0, 3, 2}, {8, 9, 10}, {8, 10, 11}};
    for (std::uint32_t level = 0; level < 8; level += 4)
        for (std::uint32_t i = 0; i < 4; ++i) {
            const std::uint32_t a = level + i, b = level + (i + 1) % 4;
            mesh.triangles.insert(mesh.triangles.end(), {{a, b, b + 4}, {a, b + 4, a + 4}});
        }
    return mesh;
}

TEST(Build, ResolvesBodiesInsideOutThatHangOnOthers) {
    // Of one shell, whose volume is positive, one part is inside out.
    const mesh::Mesh hanging = tests::joined(
        {tests::box({0, 0, 0}, {2, 2, 1}).mesh, mesh::flipped(tests::box({2, 2, 0}, {3, 3, 1}).mesh)});
    const Result<Built> built = build(hanging);
    ASSERT_TRUE(built);
    EXPECT_TRUE(built->report.resolved);
    EXPECT_NEAR(measure(built->octree).volume, 4, 1e-6);
    EXPECT_EQ(built->octree.classify({2.5, 2.5, 0.5}), bsp::Position::out);
}

TEST(Build, ResolvesBodiesThatCrossAlongEdgesInFacets) {
    // No interior of a facet meets another facet, and the prism's first facet is outside.
    const mesh::Mesh slab = tests::box({0, 0, 0}, {4, 4, 2}).mesh;
    for (const auto& [low, high, ring, volume] : {std::tuple{-1, 1, 0, 33}, {1, 3, 2, 33}}) {
        const mesh::Mesh prism = ringed_box({1, 1, double(low)}, {2, 2, double(high)}, ring);
        const Result<Built> built = build(tests::joined({slab, prism}));
        ASSERT_TRUE(built);
        EXPECT_TRUE(built->report.resolved);
        EXPECT_NEAR(measure(built->octree).volume, volume, 1e-6);
        EXPECT_EQ(built->octree.classify({1.5, 1.5, ring + 0.0}), bsp::Position::in);
    }
}

TEST(Build, LeavesBodiesThatTouchAlongEdgesInFacetsAsTheyAre) {
    // A prism on its edge on a slab: nothing is cut, so nothing is rounded.
    mesh::Mesh prism;
    prism.vertices = {{1, 1, 2}, {0.5, 1, 3}, {1.5, 1, 3}, {1, 3, 2}, {0.5, 3, 3}, {1.5, 3, 3}};
    prism.triangles = {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3},
                       {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}};
    if (tests::volume_of(prism) < 0) prism = mesh::flipped(prism);
    const Result<Built> built = build(tests::joined({tests::box({0, 0, 0}, {4, 4, 2}).mesh, prism}));
    ASSERT_TRUE(built);
    EXPECT_FALSE(built->report.resolved);
    EXPECT_NEAR(measure(built->octree).volume, 33, 1e-6);
}

TEST(Build, KnowsCavitiesAndPartsThatTouch) {
    const mesh::Mesh shell = tests::joined(
        {tests::box({0, 0, 0}, {3, 3, 3}).mesh, mesh::flipped(tests::box({1, 1, 1}, {2, 2, 2}).mesh)});
    for (const std::uint32_t planes : {1U, 4U, 16U}) {
        tests::expect_solid(tests::octree_of(shell, fine(planes)), 26, "cavity");
        tests::expect_solid(tests::octree_of(tests::joined({tests::box({0, 0, 0}, {1, 1, 1}).mesh,
                                                            tests::box({1, 1, 0}, {2, 2, 1}).mesh}),
                                             fine(planes)),
                            2, "edge contact");
    }
}

TEST(Build, StaysExactWhereTheDepthIsLimited) {
    // Cells at the limit hold trees of whatever is in them: there are no null nodes, and nothing is lost.
    const exact::Lattice lattice = tests::small_lattice(12);
    const auto limited = [&](const mesh::Mesh& mesh, int depth) {
        MeshOptions options = fine(1);
        options.octree.depth = depth;
        return tests::octree_of(mesh, options, lattice);
    };
    const mesh::Mesh ball = mesh::icosphere(20, 3);
    for (const mesh::Mesh& mesh : {mesh::gear(), mesh::torus(3, 1, 12, 6), mesh::cube(3)})
        for (const int depth : {0, 1, 3, 7}) {
            const std::string what = "depth " + std::to_string(depth);
            const BspOctree solid = limited(mesh, depth), whole = tests::octree_of(mesh, {}, lattice);
            EXPECT_LE(solid.stats().deepest, depth);
            tests::expect_same(solid, whole, what);
            const BspOctree other = limited(ball, depth), whole_ball = tests::octree_of(ball, {}, lattice);
            const BspOctree rest = *other.subtract(solid);
            EXPECT_LE(rest.stats().deepest, depth);
            tests::expect_same(rest, *whole_ball.subtract(whole), what + ", taken from a ball");
        }
}

TEST(Build, RefusesWhatIsNoSolid) {
    mesh::Mesh open = mesh::cube();
    open.triangles.pop_back();
    const Result<Built> result = build(open);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::not_a_solid);
    EXPECT_FALSE(result.error().place.faces.empty());

    mesh::Mesh wild = mesh::cube();
    wild.triangles[0][0] = 99;
    MeshOptions trusting;
    trusting.surface = SurfaceCheck::trust;
    EXPECT_EQ(build(wild, trusting).error().code, ErrorCode::bad_input);
    // A lattice in which there is no room left around the mesh.
    EXPECT_EQ(build(moved_to_border(), tests::small_lattice(20)).error().code, ErrorCode::bad_input);
}

TEST(Build, RefusesOptionsOutOfRange) {
    // No leaf without a plane: every face would be subdivided to the last level.
    const auto options = [](std::uint32_t planes, int depth) {
        MeshOptions of = fine(planes);
        of.octree.depth = depth;
        return of;
    };
    for (const MeshOptions& wrong : {options(0, 26), options(1001, 26), options(16, -1), options(16, 27)}) {
        const Result<Built> built = build(mesh::cube(), wrong);
        ASSERT_FALSE(built);
        EXPECT_EQ(built.error().code, ErrorCode::bad_input);
    }
    for (const MeshOptions& right : {options(1, 26), options(1000, 0)})
        EXPECT_TRUE(build(mesh::cube(), right));
}

TEST(Build, TellsHowFarItIsAndStopsWhenAskedTo) {
    const mesh::Mesh ball = mesh::displaced_sphere(16);
    std::atomic<bool> cancel{false};
    std::vector<double> done;
    Context context;
    context.cancel = &cancel;
    context.on_progress = [&](std::string_view phase, double at) {
        if (phase == "octree") done.push_back(at);
    };
    const Result<Built> built = build(ball, {}, context);
    ASSERT_TRUE(built);
    ASSERT_GT(done.size(), 20U);
    EXPECT_TRUE(std::is_sorted(done.begin(), done.end()));
    EXPECT_NEAR(done.back(), 1, 0.02);
    for (const std::string_view stop_in : {"octree", "faces"}) {
        cancel = false;
        context.on_progress = [&](std::string_view phase, double at) {
            cancel = phase == stop_in && at > 0.1;
        };
        const ErrorCode code = stop_in == "octree" ? build(ball, {}, context).error().code
                                                   : to_mesh(built->octree, context).error().code;
        EXPECT_EQ(code, ErrorCode::cancelled) << stop_in;
    }
}

TEST(Build, GoesBackToTheSameMeshForAnyNumberOfThreads) {
    const Result<Built> built = build(mesh::displaced_sphere(40));
    ASSERT_TRUE(built);
    Context context;
    context.threads = 1;
    const Result<ToMesh> serial = to_mesh(built->octree, context);
    ASSERT_TRUE(serial);
    for (const int threads : {0, 2, 3}) {
        context.threads = threads;
        const Result<ToMesh> back = to_mesh(built->octree, context);
        ASSERT_TRUE(back);
        EXPECT_EQ(back->mesh.vertices, serial->mesh.vertices) << threads;
        EXPECT_EQ(back->mesh.triangles, serial->mesh.triangles) << threads;
        EXPECT_EQ(back->report.fragments, serial->report.fragments) << threads;
    }
}

TEST(Build, OfNothingIsEmpty) {
    const Result<Built> built = build(mesh::Mesh{});
    ASSERT_TRUE(built);
    EXPECT_TRUE(built->octree.is_empty());
    const Result<ToMesh> back = to_mesh(built->octree);
    ASSERT_TRUE(back);
    EXPECT_TRUE(back->mesh.triangles.empty());
}

TEST(Build, OfAVertexWithManyFacesEndsThere) {
    // 500 faces meet in the apex: no subdivision separates them.
    const mesh::Mesh cone = mesh::cone(1, 0, 1, 500);
    const Result<Built> built = build(cone);
    ASSERT_TRUE(built);
    EXPECT_LT(built->octree.stats().deepest, 16);
    EXPECT_GE(built->octree.stats().largest_tree, 500U);
    EXPECT_NEAR(measure(built->octree).volume, tests::volume_of(cone), 1e-6);
}

TEST(Build, BringsClosedModelsBackExactly) {
    for (const char* name : {"classic/homer.off", "classic/spot.obj", "mechanical/anchor-1k.off",
                             "mechanical/pinion.off", "mechanical/hilbert-cube.obj", "mechanical/part.off"}) {
        OCTAVO_NEEDS_MODEL(name);
        const Result<io::ReadMesh> read = io::read_mesh((tests::models_folder() / name).string());
        ASSERT_TRUE(read);
        expect_round_trip(read->mesh, {}, name);
    }
}

TEST(ToMesh, SeparatesWedgesOppositeGaps) {
    // Wedges about one edge, every other sixth or tenth of a turn: each side of one goes straight on in a side of
    // another, and so do the borders in the planes above and below, where the edge ends. Nothing changes there for any
    // plane; but faces, and borders, must not cross.
    using tests::prism;
    const mesh::Mesh three = tests::joined({prism(2, {{{0, 0}, {4, 0}, {4, 4}}}, 0, 1).mesh,
                                            prism(2, {{{0, 0}, {0, 4}, {-4, 0}}}, 0, 1).mesh,
                                            prism(2, {{{0, 0}, {-4, -4}, {0, -4}}}, 0, 1).mesh});
    const std::array<std::array<int, 2>, 10> spokes{
        {{4, 0}, {4, 1}, {4, 4}, {0, 4}, {-2, 4}, {-4, 0}, {-4, -1}, {-4, -4}, {0, -4}, {2, -4}}};
    std::vector<mesh::Mesh> parts;
    for (std::size_t i = 0; i < 10; i += 2)
        parts.push_back(prism(2, {{{0, 0}, spokes[i], spokes[i + 1]}}, 0, 1).mesh);
    const mesh::Mesh five = tests::joined(parts);
    const mesh::Mesh tilted =
        mesh::transform(five, {{{{1, 1, 2, 3}, {-1, 2, 1, 5}, {2, 1, -1, 0}}}});  // no line along an axis
    const std::int64_t corner = -(std::int64_t{1} << 25);
    const exact::Lattice centred = *exact::Lattice::from_parts(0, {corner, corner, corner});
    // An outline that goes through (−½, −½) three times: an edge in two walls of cells, and no cell has all of the
    // faces about it. Its ends lie so far apart that no triangle would have it as a side by chance.
    const std::array<std::array<int, 2>, 6> outline{{{3, 0}, {-4, -1}, {-1, 3}, {0, -4}, {-4, -4}, {3, 3}}};
    mesh::Mesh in_walls;
    for (const double z : {0.0, 1.0})
        for (const auto& [x, y] : outline)
            in_walls.vertices.push_back({double(x), double(y), 20 * z + 3 * y});
    for (std::uint32_t i = 0; i < 6; ++i) {
        const std::uint32_t k = (i + 1) % 6;
        in_walls.triangles.insert(in_walls.triangles.end(), {{i, i + 6, k}, {k, i + 6, k + 6}});
        if (i == 0 || k == 0) continue;
        in_walls.triangles.insert(in_walls.triangles.end(), {{0, i, k}, {6, k + 6, i + 6}});
    }
    struct Case {
        mesh::Mesh mesh;
        std::size_t wedges;
    };
    for (const auto& [mesh, wedges] : {Case{three, 3}, Case{five, 5}, Case{tilted, 5}, Case{in_walls, 3}})
        for (const StopRule stop : {StopRule::few_planes, StopRule::common_point}) {
            MeshOptions options = fine(1);
            options.octree.stop = stop;
            const BspOctree solid = tests::octree_of(mesh, options, centred);
            tests::expect_solid(solid, tests::volume_of(mesh), "wedges");
            const mesh::Mesh back = to_mesh(solid)->mesh;
            EXPECT_EQ(back.triangles.size(), 8 * wedges);
            EXPECT_EQ(back.vertices.size(), 6 * wedges);
            EXPECT_EQ(mesh::measure(back).components, wedges);
        }
}

TEST(ToMesh, SlitsFacesOnlyWhereTheyCross) {
    // A wedge of one solid ends in the middle of an edge about which three planes go straight on.
    const mesh::Mesh mesh{
        {{3, 3, 1}, {1, 1, 2}, {1, 3, 0}, {0, 0, 3}, {0, 2, 0}, {1, 3, 1}, {0, 1, 2}, {2, 2, 1}, {3, 3, 0}},
        {{0, 1, 2},
         {3, 4, 1},
         {3, 1, 0},
         {0, 2, 4},
         {1, 4, 2},
         {4, 3, 0},
         {5, 6, 0},
         {5, 7, 6},
         {8, 6, 7},
         {8, 7, 0},
         {8, 0, 6},
         {5, 0, 7}},
        {}};
    for (const std::uint32_t planes : {1U, 16U}) {
        const BspOctree solid = tests::octree_of(mesh, fine(planes));
        const mesh::Mesh back = to_mesh(solid)->mesh;
        EXPECT_EQ(tests::manifold_defect(back), "");
        EXPECT_EQ(back.triangles.size(), 22U);
    }
}

TEST(ToMesh, RefusesSolidsWithoutAnOuterBoundary) {
    const Result<ToMesh> result = to_mesh(tests::octree_of(mesh::cube()).complement());
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::not_a_solid);
}

}  // namespace
}  // namespace octavo::bsp_octree
