// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <atomic>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octavo/mesh/measure.hpp>
#include <octavo/mesh/snap.hpp>
#include <octavo/mesh/transform.hpp>
#include <octavo/mesh/validate.hpp>

#include "surfaces.hpp"

namespace octavo::mesh {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

Report report_of(const Mesh& mesh, const ValidateOptions& options = {}) {
    auto report = validate(mesh, options);
    EXPECT_TRUE(report.has_value()) << report.error().describe();
    return *report;
}

std::vector<ProblemKind> kinds_of(const Report& report) {
    std::vector<ProblemKind> kinds;
    for (const Problem& problem : report.problems) kinds.push_back(problem.kind);
    return kinds;
}

std::vector<FaceIndex> faces_of(const Report& report, ProblemKind kind) {
    for (const Problem& problem : report.problems)
        if (problem.kind == kind) return problem.faces;
    return {};
}

Mesh both(const Mesh& a, const Mesh& b) { return join(std::array{a, b}); }
Mesh moved(const Mesh& mesh, Vec3 offset) { return transform(mesh, translation(offset)); }

TEST(Validate, FindsNothingWrongWithGeneratedSolids) {
    for (const auto& [name, mesh, genus] : tests::generated_solids()) {
        const Report report = report_of(mesh);
        EXPECT_THAT(kinds_of(report), IsEmpty()) << name << "\n" << report.describe();
        EXPECT_TRUE(report.solid && report.closed && report.oriented && report.manifold) << name;
        EXPECT_TRUE(report.closed_as_stored) << name;
        EXPECT_EQ(report.shells, 1u);
        EXPECT_EQ(report.components, 1u);
    }
}

TEST(Validate, MergesEqualVerticesAndTellsBoth) {
    Mesh soup;
    const Mesh solid = gear();
    for (const Triangle& t : solid.triangles) {
        for (const VertexIndex v : t) soup.vertices.push_back(solid.vertices[v]);
        const auto n = static_cast<VertexIndex>(soup.vertices.size());
        soup.triangles.push_back({n - 3, n - 2, n - 1});
    }
    const Report report = report_of(soup);
    EXPECT_TRUE(report.solid);
    EXPECT_TRUE(report.closed);
    EXPECT_FALSE(report.closed_as_stored);
    EXPECT_EQ(report.merged_vertices, solid.vertices.size());
    EXPECT_EQ(report.components, solid.triangles.size());
    EXPECT_EQ(report.merged_components, 1u);
}

TEST(Validate, NamesTheFacetsAtAHole) {
    Mesh mesh = cube();
    mesh.triangles.erase(mesh.triangles.begin() + 4);
    const Report report = report_of(mesh);
    EXPECT_THAT(kinds_of(report), ElementsAre(ProblemKind::open_edges));
    EXPECT_EQ(report.count(ProblemKind::open_edges), 3u);
    EXPECT_EQ(faces_of(report, ProblemKind::open_edges).size(), 3u);
    EXPECT_FALSE(report.solid || report.closed || report.manifold);
    EXPECT_TRUE(report.oriented);
}

TEST(Validate, NamesAFacetThatIsTurnedOver) {
    Mesh mesh = icosphere(1, 4);
    std::swap(mesh.triangles[17][0], mesh.triangles[17][1]);
    const Report report = report_of(mesh);
    EXPECT_THAT(kinds_of(report), ElementsAre(ProblemKind::inconsistent_orientation));
    EXPECT_EQ(report.count(ProblemKind::inconsistent_orientation), 3u);
    EXPECT_THAT(faces_of(report, ProblemKind::inconsistent_orientation), testing::Contains(17u));
    EXPECT_TRUE(report.closed);
    EXPECT_FALSE(report.solid);
}

TEST(Validate, TellsInsideOutFromCavity) {
    const Mesh outer = icosphere(3, 4), inner = icosphere(1, 3);
    EXPECT_THAT(kinds_of(report_of(flipped(outer))), ElementsAre(ProblemKind::inside_out_shells));

    const Report hollow = report_of(both(outer, flipped(inner)));
    EXPECT_TRUE(hollow.solid);
    EXPECT_EQ(hollow.cavities, 1u);
    EXPECT_EQ(hollow.shells, 2u);

    // All turned over: the outer shell is wrong; what is in it is right only when the outer one is.
    const Report turned = report_of(both(flipped(outer), inner));
    EXPECT_EQ(turned.count(ProblemKind::inside_out_shells), 1u);
    EXPECT_FALSE(turned.solid);

    // A body in a cavity in a body in a cavity.
    const Mesh russian = join(
        std::array{icosphere(8, 4), flipped(icosphere(6, 4)), icosphere(4, 4), flipped(icosphere(2, 4))});
    EXPECT_TRUE(report_of(russian).solid);
    EXPECT_EQ(report_of(russian).cavities, 2u);

    // A cavity outside of the body is no cavity.
    const Report beside = report_of(both(outer, flipped(moved(inner, {9, 0, 0}))));
    EXPECT_EQ(beside.count(ProblemKind::inside_out_shells), 1u);
    EXPECT_EQ(beside.cavities, 0u);
    EXPECT_THAT(faces_of(beside, ProblemKind::inside_out_shells).front(), outer.triangles.size());
}

TEST(Validate, FindsWhereShellsLieAlsoInDegeneratePositions) {
    // Boxes whose leftmost corners see edges, vertices and facets' planes of the others exactly.
    const Mesh outer = box({0, 0, 0}, {8, 8, 8});
    for (const double y : {0.5, 2.0, 4.0, 5.0})
        for (const double z : {0.5, 2.0, 4.0, 5.0}) {
            const Report report = report_of(both(outer, flipped(box({3, y, z}, {5, y + 2, z + 2}))));
            EXPECT_TRUE(report.solid);
            EXPECT_EQ(report.cavities, 1u);
            const Report outside = report_of(both(outer, flipped(box({9, y, z}, {11, y + 2, z + 2}))));
            EXPECT_EQ(outside.count(ProblemKind::inside_out_shells), 1u);
        }
    // Touching from inside and from outside, at a whole facet and at a vertex.
    EXPECT_EQ(
        report_of(both(outer, flipped(box({8, 1, 1}, {9, 2, 2})))).count(ProblemKind::inside_out_shells), 1u);
    EXPECT_EQ(report_of(both(outer, flipped(box({7, 1, 1}, {8, 2, 2})))).cavities, 1u);
    EXPECT_EQ(report_of(both(outer, flipped(box({0, 1, 1}, {1, 2, 2})))).cavities, 1u);
    const Mesh spike{
        {{0, 5, 2}, {3, 5, 2}, {3, 6, 2}, {3, 5, 3}}, {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}}, {}};
    ASSERT_GT(measure(spike).volume, 0);
    const Report touching = report_of(both(outer, flipped(spike)));
    EXPECT_EQ(touching.cavities, 1u);
    EXPECT_TRUE(touching.solid);
    EXPECT_EQ(touching.count(ProblemKind::touching_facets), 3u);
    EXPECT_EQ(report_of(both(outer, flipped(moved(spike, {8, 0, 0})))).count(ProblemKind::inside_out_shells),
              1u);
}

TEST(Validate, TellsEdgesAndVerticesThatAreNotManifold) {
    // Two cubes along an edge, and at a vertex: solids, but not manifold ones.
    Mesh at_edge = both(box({0, 0, 0}, {1, 1, 1}), box({1, 1, 0}, {2, 2, 1}));
    const Report edge = report_of(at_edge);
    EXPECT_THAT(kinds_of(edge), ElementsAre(ProblemKind::non_manifold_edges));
    EXPECT_EQ(edge.count(ProblemKind::non_manifold_edges), 1u);
    EXPECT_EQ(faces_of(edge, ProblemKind::non_manifold_edges).size(), 4u);
    EXPECT_TRUE(edge.solid);
    EXPECT_FALSE(edge.closed);

    const Report vertex = report_of(both(box({0, 0, 0}, {1, 1, 1}), box({1, 1, 1}, {2, 2, 2})));
    EXPECT_THAT(kinds_of(vertex), ElementsAre(ProblemKind::non_manifold_vertices));
    EXPECT_TRUE(vertex.solid);
    EXPECT_TRUE(vertex.closed);
    EXPECT_FALSE(vertex.manifold);
    EXPECT_EQ(vertex.shells, 2u);
    EXPECT_EQ(vertex.merged_components, 1u);
}

TEST(Validate, CountsDuplicatesAndFacetsWithoutArea) {
    Mesh doubled = cube();
    doubled.triangles.push_back(doubled.triangles[3]);
    const auto [a, b, c] = doubled.triangles[5];
    doubled.triangles.push_back({c, b, a});
    const Report report = report_of(doubled);
    EXPECT_EQ(report.count(ProblemKind::duplicate_facets), 2u);
    EXPECT_THAT(faces_of(report, ProblemKind::duplicate_facets), ElementsAre(12u, 13u));
    EXPECT_FALSE(report.solid);

    // A needle between the two facets of a cube's side: closed, but it has no area.
    Mesh needle = cube();
    const Vec3 middle = 0.5 * (needle.vertices[0] + needle.vertices[3]);
    needle.vertices.push_back(middle);
    needle.triangles[0] = {0, 2, 3};
    needle.triangles[1] = {0, 8, 1};
    needle.triangles.push_back({8, 3, 1});
    needle.triangles.push_back({0, 3, 8});
    const Report needles = report_of(needle);
    EXPECT_EQ(needles.count(ProblemKind::zero_area_facets), 1u);
    EXPECT_THAT(faces_of(needles, ProblemKind::zero_area_facets), ElementsAre(13u));
    EXPECT_TRUE(needles.closed);
    EXPECT_EQ(needles.count(ProblemKind::touching_facets), 2u);
}

TEST(Validate, SeesAreaAtAnyScale) {
    // Products of these coordinates underflow or overflow.
    for (const int exponent : {-960, -700, -570, -481, 505, 640, 900}) {
        SCOPED_TRACE(exponent);
        const double scale = std::ldexp(1.0, exponent);
        Mesh mesh = transform(box({0, 0, 0}, {1, 1, 1}), scaling({scale, scale, scale}));
        EXPECT_EQ(report_of(mesh).count(ProblemKind::zero_area_facets), 0u);
        mesh.vertices.push_back({scale / 2, scale / 2, 0});
        mesh.triangles.push_back({0, 8, 3});
        EXPECT_EQ(report_of(mesh).count(ProblemKind::zero_area_facets), 1u);
    }
}

TEST(Validate, TellsThinFacetsThatTheLatticeFlattens) {
    Mesh mesh = box({0, 0, 0}, {1, 1, 1});
    // Splits the facet (0, 2, 3) by a vertex far less than a lattice unit off its edge 0–3.
    const Vec3 off = 0.5 * (mesh.vertices[0] + mesh.vertices[3]) + Vec3{-1e-12, 1e-12, 0};
    mesh.vertices.push_back(off);
    mesh.triangles[0] = {0, 2, 8};
    mesh.triangles.push_back({2, 3, 8});
    mesh.triangles.push_back({0, 8, 3});
    const Report report = report_of(mesh);
    EXPECT_EQ(report.count(ProblemKind::snapped_facets), 1u);
    EXPECT_EQ(report.count(ProblemKind::zero_area_facets), 0u);
    EXPECT_TRUE(report.closed);
    EXPECT_GT(report.largest_displacement, 0);
    EXPECT_LT(report.largest_displacement, 1e-7);
}

TEST(Snap, TellsHowFarVerticesMovedAtAnyScale) {
    const Mesh sphere = icosphere(1, 2);
    const double plain = snap(sphere)->report.largest_displacement;
    EXPECT_GT(plain, 0);
    for (const double size : {0x1p-900, 0x1p-560, 0x1p560, 0x1p900}) {
        Mesh scaled = sphere;
        for (Vec3& vertex : scaled.vertices) vertex = size * vertex;
        EXPECT_EQ(snap(scaled)->report.largest_displacement, size * plain) << size;
    }
}

TEST(Validate, NamesTheFacetsThatCross) {
    const Report report = report_of(both(icosphere(1, 5), moved(icosphere(1, 5), {0.8, 0.1, 0})));
    EXPECT_GT(report.count(ProblemKind::self_intersections), 20u);
    EXPECT_GT(faces_of(report, ProblemKind::self_intersections).size(), 20u);
    EXPECT_FALSE(report.solid);
    EXPECT_TRUE(report.closed && report.oriented && report.manifold);
    ValidateOptions quick;
    quick.self_intersections = false;
    EXPECT_TRUE(report_of(both(icosphere(1, 5), moved(icosphere(1, 5), {0.8, 0.1, 0})), quick).solid);
}

TEST(Validate, ListsAtMostSoManyFacetsButCountsAll) {
    Mesh mesh = icosphere(1, 10);
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 2)
        std::swap(mesh.triangles[i][0], mesh.triangles[i][1]);
    ValidateOptions options;
    options.most_faces = 7;
    const Report report = report_of(mesh, options);
    EXPECT_EQ(faces_of(report, ProblemKind::inconsistent_orientation).size(), 7u);
    EXPECT_GT(report.count(ProblemKind::inconsistent_orientation), 1000u);
}

TEST(Validate, TakesUnusedVerticesForANote) {
    Mesh mesh = cube();
    mesh.vertices.push_back({1e30, 0, NAN});
    const Report report = report_of(mesh);
    EXPECT_THAT(kinds_of(report), ElementsAre(ProblemKind::unused_vertices));
    EXPECT_TRUE(report.solid);
}

TEST(Validate, OfNothingIsNoSolid) {
    EXPECT_THAT(kinds_of(report_of(Mesh{})), ElementsAre(ProblemKind::empty));
    EXPECT_FALSE(report_of(Mesh{}).solid);
    const Mesh flat{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}, {2, 1, 0}}, {}};
    EXPECT_EQ(kinds_of(report_of(flat)).front(), ProblemKind::empty);
}

TEST(Validate, FindsDoubleSheetsThatOnlyTheLatticeMakes) {
    // A plate of a thickness far below the lattice unit: its two sides fall together.
    Mesh plate = box({0, 0, 0}, {1, 1, 1e-12});
    const Report report = report_of(plate);
    EXPECT_EQ(report.count(ProblemKind::flat_shells), 1u);
    EXPECT_FALSE(report.solid);
    // Beside a real body it is still named, with its facets alone.
    const Report beside = report_of(both(cube(), moved(plate, {5, 0, 0})));
    ASSERT_EQ(beside.count(ProblemKind::flat_shells), 1u);
    for (const Problem& problem : beside.problems) {
        if (problem.kind == ProblemKind::flat_shells) {
            EXPECT_GE(problem.faces.front(), 12u);
        }
    }
    // What has not even area is no sheet.
    const Report speck = report_of(both(cube(), moved(box({0, 0, 0}, {1e-12, 1e-12, 1e-12}), {5, 0, 0})));
    EXPECT_EQ(speck.count(ProblemKind::flat_shells), 0u);
}

TEST(Validate, TellsBodiesThatOnlyTheLatticeMakesOne) {
    const Mesh one = box({0, 0, 0}, {1, 1, 1});
    for (const Mesh& other : {moved(one, {1e-10, 1e-10, 1e-10}), flipped(moved(one, {0, 1e-10, 0}))}) {
        const Report report = report_of(both(one, other));
        EXPECT_EQ(report.count(ProblemKind::duplicate_facets), 0u);
        EXPECT_EQ(report.count(ProblemKind::overlaps), one.triangles.size());
        EXPECT_EQ(faces_of(report, ProblemKind::overlaps).size(), 2 * one.triangles.size());
        EXPECT_FALSE(report.solid);
    }
    // What is the same in the file already is told as that, and one facet beside it is one pair more.
    Mesh doubled = both(one, one);
    EXPECT_EQ(report_of(doubled).count(ProblemKind::overlaps), 0u);
    EXPECT_EQ(report_of(doubled).count(ProblemKind::duplicate_facets), one.triangles.size());
}

TEST(Validate, NamesThePartThatIsInsideOutAtACommonEdge) {
    const Mesh large = box({0, 0, 0}, {2, 2, 1}), small = box({2, 2, 0}, {3, 3, 1});
    const Report report = report_of(both(large, flipped(small)));
    EXPECT_EQ(report.count(ProblemKind::inside_out_shells), 1u);
    EXPECT_FALSE(report.solid);
    const std::vector<FaceIndex> faces = faces_of(report, ProblemKind::inside_out_shells);
    EXPECT_EQ(faces.size(), small.triangles.size());
    EXPECT_EQ(faces.front(), large.triangles.size());
}

TEST(Validate, CountsBodiesInBodies) {
    const Mesh nested = both(box({-2, -2, -2}, {2, 2, 2}), box({-1, -1, -1}, {1, 1, 1}));
    EXPECT_EQ(report_of(nested).nested_bodies, 1u);
    EXPECT_TRUE(report_of(nested).solid);
    EXPECT_EQ(report_of(both(cube(), moved(cube(), {5, 0, 0}))).nested_bodies, 0u);
}

TEST(Validate, TellsTheTopologyOfWhatNoLatticeHolds) {
    Mesh mesh = cube();
    for (Vec3& vertex : mesh.vertices) vertex = 1e300 * vertex;
    const auto refused = validate(mesh);
    ASSERT_FALSE(refused.has_value());
    EXPECT_EQ(refused.error().code, ErrorCode::limit);
    const auto report = validate(mesh, {.topology_only = true});
    ASSERT_TRUE(report.has_value());
    EXPECT_TRUE(report->closed && report->oriented && report->manifold);
    EXPECT_FALSE(report->solid) << "not known";
}

TEST(Validate, RefusesWhatIsNotFinite) {
    Mesh mesh = cube();
    mesh.vertices[3].y = INFINITY;
    const auto report = validate(mesh);
    ASSERT_FALSE(report.has_value());
    EXPECT_EQ(report.error().code, ErrorCode::bad_input);
    EXPECT_THAT(report.error().sentence, testing::HasSubstr("vertex 3"));
}

TEST(Validate, RefusesVeryManyNumbersThatAreNoneAtOnce) {
    const double nan = std::nan("");
    Mesh mesh = cube();
    mesh.vertices.insert(mesh.vertices.end(), 400'000, {nan, nan, nan});
    EXPECT_EQ(report_of(mesh).count(ProblemKind::unused_vertices), 400'000u);
    mesh.triangles.push_back({0, 1, 300'000});
    const auto report = validate(mesh);
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().code, ErrorCode::bad_input);
}

TEST(Validate, DescribesInSentences) {
    Mesh mesh = cube();
    mesh.triangles.pop_back();
    EXPECT_EQ(report_of(mesh).describe(),
              "The mesh does not bound a solid and is not closed. It has 11 facets in 1 shell.\n"
              "error: 3 edges have only one facet.\n");
    EXPECT_EQ(report_of(cube()).describe(),
              "The mesh bounds a solid and is closed. It has 12 facets in 1 shell.\n");
}

TEST(Validate, IsTheSameForAnyNumberOfThreads) {
    const Mesh mesh = both(displaced_sphere(24), moved(displaced_sphere(20), {0.4, 0.2, 0}));
    Context one, two;
    one.threads = 1, two.threads = 2;
    const auto first = validate(mesh, {}, one), second = validate(mesh, {}, two);
    ASSERT_TRUE(first && second);
    ASSERT_EQ(first->problems.size(), second->problems.size());
    for (std::size_t i = 0; i < first->problems.size(); ++i) {
        EXPECT_EQ(first->problems[i].count, second->problems[i].count);
        EXPECT_EQ(first->problems[i].faces, second->problems[i].faces);
    }
}

TEST(Validate, StopsWhenCancelled) {
    const std::atomic<bool> cancel{true};
    Context context;
    context.cancel = &cancel;
    const auto report = validate(cube(), {}, context);
    ASSERT_FALSE(report.has_value());
    EXPECT_EQ(report.error().code, ErrorCode::cancelled);
}

TEST(Validate, TellsHowFarItIsAndStopsWhereItIs) {
    const Mesh ball = icosphere(1, 60);
    std::vector<double> shares;
    Context context;
    context.on_progress = [&](std::string_view phase, double done) {
        EXPECT_EQ(phase, "check");
        shares.push_back(done);
    };
    ASSERT_TRUE(validate(ball, {}, context));
    EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
    // Looking for self-intersections is most of the work.
    EXPECT_GE(std::count_if(shares.begin(), shares.end(), [](double s) { return s > 0.3 && s < 1; }), 10);
    for (const double from : {0.0, 0.1, 0.31, 0.7}) {
        std::atomic<bool> cancel{false};
        context.cancel = &cancel;
        context.on_progress = [&](std::string_view, double done) { cancel = cancel || done >= from; };
        const auto stopped = validate(ball, {}, context);
        ASSERT_FALSE(stopped) << from;
        EXPECT_EQ(stopped.error().code, ErrorCode::cancelled);
    }
}

}  // namespace
}  // namespace octavo::mesh
