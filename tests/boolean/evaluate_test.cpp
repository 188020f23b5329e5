// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <octavo/boolean/evaluate.hpp>

#include "effort.hpp"
#include "solids.hpp"

namespace octavo::boolean {
namespace {

using tests::Convex;

void expect_solid(const Result<Evaluated>& result, double volume, const std::string& what) {
    ASSERT_TRUE(result) << what << ": " << result.error().describe();
    EXPECT_EQ(tests::manifold_defect(result->mesh), "") << what;
    EXPECT_NEAR(tests::volume_of(result->mesh), volume, 1e-9) << what;
}

mesh::Mesh cube(double x, double y, double z, double side = 1) {
    mesh::Mesh mesh = tests::box({0, 0, 0}, {1, 1, 1}).mesh;
    for (Vec3& vertex : mesh.vertices) vertex = side * vertex + Vec3{x, y, z};
    return mesh;
}

TEST(Evaluate, ReturnsNothingForASolidWithoutItself) {
    const std::vector<mesh::Mesh> same{cube(0, 0, 0), cube(0, 0, 0)};
    const Result<Evaluated> result = subtract(same);
    ASSERT_TRUE(result);
    EXPECT_TRUE(result->mesh.triangles.empty());
    EXPECT_TRUE(result->mesh.vertices.empty());
    EXPECT_EQ(result->report.warnings, std::vector<std::string>{"the result is empty"});
}

TEST(Evaluate, TakesEmptyOperands) {
    Context one_thread;
    one_thread.threads = 1;
    for (const Context& context : {Context{}, one_thread}) {
        const std::vector<mesh::Mesh> nothing(2), something{mesh::Mesh{}, cube(0, 0, 0)};
        const Result<Evaluated> none = unite(nothing, {}, context), some = unite(something, {}, context);
        ASSERT_TRUE(none && some);
        EXPECT_TRUE(none->mesh.triangles.empty());
        EXPECT_EQ(some->mesh.triangles.size(), 12U);
    }
}

TEST(Evaluate, ReturnsTheSolidForItsUnionWithItself) {
    const std::vector<mesh::Mesh> same{cube(0, 0, 0), cube(0, 0, 0), cube(0, 0, 0)};
    const Result<Evaluated> result = unite(same);
    ASSERT_TRUE(result);
    EXPECT_EQ(result->mesh.triangles.size(), 12u);
    expect_solid(result, 1, "A + A + A");
}

TEST(Evaluate, KeepsFacetsThatNothingCuts) {
    const std::vector<mesh::Mesh> apart{cube(0, 0, 0), cube(5, 0, 0)};
    const Result<Evaluated> result = unite(apart);
    ASSERT_TRUE(result);
    ASSERT_EQ(result->mesh.triangles.size(), 24u);
    for (std::size_t i = 0; i < 24; ++i) {
        const mesh::Source source = result->mesh.sources[i];
        const mesh::Mesh& operand = apart[source.operand];
        for (std::size_t k = 0; k < 3; ++k)
            EXPECT_EQ(result->mesh.vertices[result->mesh.triangles[i][k]],
                      operand.vertices[operand.triangles[source.face][k]]);
    }
}

TEST(Evaluate, MergesCoplanarLeftoversOfTwoCubesInARow) {
    // Each of the four long sides is a 2 x 1 rectangle, but for the halves of facets that the other cube leaves whole.
    const std::vector<mesh::Mesh> row{cube(0, 0, 0), cube(0.5, 0, 0)};
    const Result<Evaluated> result = unite(row);
    expect_solid(result, 1.5, "two cubes in a row");
    EXPECT_EQ(result->mesh.triangles.size(), 12u);
    // Three rectangles on each of them, and the two ends: nothing crosses a diagonal.
    EXPECT_EQ(unite(row, {.simplify = Simplify::none})->mesh.triangles.size(), 28u);
}

TEST(Evaluate, GivesTheFaceThatTouchingCubesShareAsASheet) {
    const std::vector<mesh::Mesh> pair{cube(0, 0, 0), cube(1, 0.5, 0.25)};
    EXPECT_TRUE(intersect(pair)->mesh.triangles.empty());
    const Result<Evaluated> face = intersect(pair, {.dangling = Dangling::kept});
    ASSERT_TRUE(face);
    EXPECT_EQ(face->mesh.triangles.size(), 2u);
    EXPECT_EQ(face->mesh.vertices.size(), 4u);
    EXPECT_EQ(face->report.dangling_facets, 2u);
    EXPECT_DOUBLE_EQ(tests::area_of(face->mesh), 0.5 * 0.75);
    for (const mesh::Source& source : face->mesh.sources) EXPECT_EQ(source.operand, 0u);
    // It faces as the first operand does.
    const mesh::Triangle& t = face->mesh.triangles[0];
    const auto& v = face->mesh.vertices;
    EXPECT_GT(cross(v[t[1]] - v[t[0]], v[t[2]] - v[t[0]]).x, 0);
}

TEST(Evaluate, DoublesTheEdgeOrVertexInWhichSolidsTouch) {
    const Result<Evaluated> edge = unite(std::vector<mesh::Mesh>{cube(0, 0, 0), cube(1, 1, 0)});
    expect_solid(edge, 2, "two cubes on an edge");
    EXPECT_EQ(edge->mesh.vertices.size(), 16u);
    EXPECT_EQ(edge->report.duplicated_vertices, 2u);
    const Result<Evaluated> vertex = unite(std::vector<mesh::Mesh>{cube(0, 0, 0), cube(1, 1, 1)});
    expect_solid(vertex, 2, "two cubes on a vertex");
    EXPECT_EQ(vertex->mesh.vertices.size(), 16u);
}

TEST(Evaluate, SplitsAnEdgeOfTouchWhoseEndsAreJoinedOnBothSides) {
    // Two cubes of the middle layer touch in an edge; the layers above and below join them at both its ends.
    const std::vector<mesh::Mesh> parts{
        tests::box({0, 0, 0}, {2, 2, 1}).mesh, tests::box({0, 0, 1}, {1, 1, 2}).mesh,
        tests::box({1, 1, 1}, {2, 2, 2}).mesh, tests::box({0, 0, 2}, {2, 2, 3}).mesh};
    expect_solid(unite(parts), 10, "a doubled inner edge");
}

TEST(Evaluate, TakesSpaceAsInsideWhereAnOperandWindsAboutItAtLeastOnce) {
    mesh::Mesh inward = cube(0.25, 0.25, 0.25, 0.5);
    for (mesh::Triangle& t : inward.triangles) std::swap(t[1], t[2]);
    mesh::Mesh hollow = cube(0, 0, 0);
    for (const mesh::Triangle& t : inward.triangles)
        hollow.triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
    hollow.vertices.insert(hollow.vertices.end(), inward.vertices.begin(), inward.vertices.end());
    expect_solid(unite(std::vector<mesh::Mesh>{hollow}), 1 - 0.125, "a shell");
    expect_solid(unite(std::vector<mesh::Mesh>{inward}), 0, "a body turned inside out");
    // Wound twice, minus the once-wound inner cube: still inside.
    mesh::Mesh twice = tests::joined({tests::box({0, 0, 0}, {4, 4, 4}), tests::box({0, 0, 0}, {4, 4, 4})});
    mesh::Mesh hole = tests::box({1, 1, 1}, {2, 2, 2}).mesh;
    for (const mesh::Triangle& t : hole.triangles)
        twice.triangles.push_back({t[0] + 16, t[2] + 16, t[1] + 16});
    twice.vertices.insert(twice.vertices.end(), hole.vertices.begin(), hole.vertices.end());
    expect_solid(unite(std::vector<mesh::Mesh>{twice}), 64, "wound twice about a hole");
}

TEST(Evaluate, RefusesOpenOperandsAndNamesTheFacets) {
    mesh::Mesh open = cube(3, 0, 0);
    open.triangles.pop_back();
    const Result<Evaluated> result = unite(std::vector<mesh::Mesh>{cube(0, 0, 0), open});
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::not_a_solid);
    EXPECT_EQ(result.error().place.operand, 1U);
    EXPECT_FALSE(result.error().place.faces.empty());

    mesh::Mesh turned = cube(0, 0, 0);
    std::swap(turned.triangles[3][0], turned.triangles[3][1]);
    EXPECT_EQ(unite(std::vector<mesh::Mesh>{turned}).error().code, ErrorCode::not_a_solid);
}

TEST(Evaluate, TellsWhichOperandIsAtFault) {
    mesh::Mesh open = cube(3, 0, 0), broken = cube(6, 0, 0);
    open.triangles.pop_back();
    broken.triangles[2][1] = 99;
    const auto error_of = [](const mesh::Mesh& second) {
        return unite(std::vector<mesh::Mesh>{cube(0, 0, 0), second}).error();
    };
    EXPECT_EQ(error_of(open).place.operand, 1U);
    EXPECT_TRUE(error_of(open).sentence.starts_with("is not closed")) << error_of(open).sentence;
    EXPECT_EQ(error_of(broken).place.operand, 1U);
    broken.vertices[0].x = std::nan("");
    EXPECT_EQ(error_of(broken).place.operand, 1U);
    // At its open edges are facets of the other operand too.
    mesh::Mesh facet = cube(0, 0, 0);
    facet.triangles.resize(1);
    EXPECT_EQ(error_of(facet).place.operand, 1U);
    facet.vertices[facet.triangles[0][2]] = {5, 5, 5};
    EXPECT_EQ(error_of(facet).place.operand, 1U);
    EXPECT_EQ(error_of(facet).place.faces, std::vector<std::uint32_t>{0});
}

TEST(Evaluate, CallsOperandsInWarningsAsItsCallerDoes) {
    mesh::Mesh open = cube(3, 0, 0);
    open.triangles.pop_back();
    const Options closing{.open = OpenOperands::winding, .names = {"bore.stl"}};
    EXPECT_NE(unite({&open, 1}, closing)->report.warnings.at(0).find("the first is bore.stl: "),
              std::string::npos);
}

/// The cube with some facets missing.
mesh::Mesh open_cube(std::initializer_list<std::size_t> missing) {
    mesh::Mesh open = cube(0, 0, 0, 2);
    std::vector<mesh::Triangle> kept;
    for (std::size_t i = 0; i < open.triangles.size(); ++i)
        if (std::find(missing.begin(), missing.end(), i) == missing.end()) kept.push_back(open.triangles[i]);
    open.triangles = kept;
    return open;
}

TEST(Evaluate, ClosesHolesOfOpenOperandsWhenAsked) {
    const Options closing{.open = OpenOperands::winding};
    for (const mesh::Mesh& open :
         {open_cube({0}), open_cube({0, 1}), open_cube({0, 1, 2, 3}), open_cube({3, 8})}) {
        EXPECT_FALSE(unite({&open, 1}));
        const Result<Evaluated> closed = unite({&open, 1}, closing);
        ASSERT_TRUE(closed) << closed.error().describe();
        EXPECT_EQ(tests::manifold_defect(closed->mesh), "");
        EXPECT_GT(closed->report.closing_facets, 0U);
        ASSERT_EQ(closed->report.warnings.size(), 1U);
        const std::vector<mesh::Mesh> pair{open, cube(1, 1, 1, 4)};
        const Result<Evaluated> both = intersect(pair, closing), either = unite(pair, closing);
        ASSERT_TRUE(both && either);
        EXPECT_NEAR(tests::volume_of(both->mesh) + tests::volume_of(either->mesh),
                    tests::volume_of(closed->mesh) + 64, 1e-9);
    }
    // A flat rim is closed by its polygon: a lid that is missing comes back.
    const mesh::Mesh lidless = open_cube({0, 1});
    EXPECT_NEAR(tests::volume_of(unite({&lidless, 1}, closing)->mesh), 8, 1e-12);
    // Closed operands are left alone.
    const mesh::Mesh whole = cube(0, 0, 0);
    const Result<Evaluated> same = unite({&whole, 1}, closing);
    ASSERT_TRUE(same);
    EXPECT_EQ(same->report.closing_facets, 0U);
    EXPECT_EQ(same->mesh.triangles.size(), 12U);
}

TEST(Evaluate, NamesOperandsThatTheLatticeIsTooCoarseFor) {
    const std::vector<mesh::Mesh> pair{cube(0, 0, 0), cube(1e12, 0, 0, 1e12)};
    const Result<Evaluated> result = unite(pair);
    ASSERT_TRUE(result);
    ASSERT_GE(result->report.warnings.size(), 1U);
    EXPECT_NE(result->report.warnings.back().find("operand 0 is small beside the whole"), std::string::npos)
        << result->report.warnings.back();
    EXPECT_EQ(tests::manifold_defect(result->mesh), "");
}

/// A cone of slivers: a flat fan below, slanted ones above.
mesh::Mesh sliver_cone(double x, double turn, std::uint32_t count) {
    mesh::Mesh cone;
    cone.vertices = {{x, 0, 0}, {x, 0, 1}};
    for (std::uint32_t i = 0; i < count; ++i) {
        const double angle = turn + 6.283185307179586 * i / count;
        cone.vertices.push_back({x + std::cos(angle), std::sin(angle), 0});
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t a = 2 + i, b = 2 + (i + 1) % count;
        cone.triangles.push_back({0, b, a});
        cone.triangles.push_back({1, a, b});
    }
    return cone;
}

TEST(Evaluate, TellsHowFarVerticesMovedAtAnyScale) {
    const mesh::Mesh sphere = tests::octahedral_sphere(4);
    const double plain = unite(std::vector{sphere})->report.largest_displacement;
    EXPECT_GT(plain, 0);
    for (const double size : {0x1p-900, 0x1p-560, 0x1p560, 0x1p900}) {
        mesh::Mesh scaled = sphere;
        for (Vec3& vertex : scaled.vertices) vertex = size * vertex;
        EXPECT_EQ(unite(std::vector{scaled})->report.largest_displacement, size * plain) << size;
    }
}

TEST(Evaluate, CutsFansOfSliversWithoutLookingAtAllPairs) {
    const std::vector<mesh::Mesh> cones{sliver_cone(0, 0, 600), sliver_cone(0.01, 0.3, 600)};
    const Result<Evaluated> either = unite(cones), both = intersect(cones);
    ASSERT_TRUE(either && both);
    EXPECT_EQ(tests::manifold_defect(either->mesh), "");
    EXPECT_EQ(tests::manifold_defect(both->mesh), "");
    EXPECT_NEAR(tests::volume_of(either->mesh) + tests::volume_of(both->mesh),
                tests::volume_of(cones[0]) + tests::volume_of(cones[1]), 1e-6);
    EXPECT_LT(either->report.pairs_tested, 3 * either->report.pieces)
        << "most pairs should be rejected by filters";
}

TEST(Evaluate, AcceptsTJunctionsThatLeaveNoGap) {
    // One edge of the cube has an extra vertex on one side only, by way of a facet without area.
    mesh::Mesh mesh = cube(0, 0, 0);
    const mesh::Triangle t = mesh.triangles[0];
    const Vec3 middle = 0.5 * (mesh.vertices[t[0]] + mesh.vertices[t[1]]);
    mesh.vertices.push_back(middle);
    mesh.triangles[0] = {t[0], 8, t[2]};
    mesh.triangles.push_back({8, t[1], t[2]});
    expect_solid(unite(std::vector<mesh::Mesh>{mesh}), 1, "a T-junction");
}

TEST(Evaluate, RefusesWhatIsNoMeshOrHasNoBound) {
    mesh::Mesh bad = cube(0, 0, 0);
    bad.triangles[2][1] = 99;
    EXPECT_EQ(unite(std::vector<mesh::Mesh>{bad}).error().code, ErrorCode::bad_input);
    mesh::Mesh endless = cube(0, 0, 0);
    endless.vertices[3].x = std::numeric_limits<double>::infinity();
    EXPECT_EQ(unite(std::vector<mesh::Mesh>{endless}).error().code, ErrorCode::bad_input);

    Program complement;
    const Program::NodeId a = complement.operand(0);
    const bool negated = true;
    complement.gate(Gate::any, {&a, 1}, {&negated, 1});
    const mesh::Mesh solid = cube(0, 0, 0);
    const mesh::Mesh* operand = &solid;
    EXPECT_EQ(evaluate({&operand, 1}, complement).error().code, ErrorCode::bad_input);
}

TEST(Evaluate, GivesTheSameBytesForAnyNumberOfThreads) {
    std::mt19937 random(7);
    std::vector<mesh::Mesh> meshes;
    for (int k = 0; k < 60; ++k) meshes.push_back(tests::random_convex(random, 12).mesh);
    Context one, two;
    one.threads = 1, two.threads = 2;
    const Result<Evaluated> first = symmetric_difference(meshes, {}, one),
                            second = symmetric_difference(meshes, {}, two);
    ASSERT_TRUE(first && second);
    EXPECT_EQ(tests::manifold_defect(first->mesh), "");
    EXPECT_TRUE(first->mesh.vertices == second->mesh.vertices);
    EXPECT_TRUE(first->mesh.triangles == second->mesh.triangles);
    EXPECT_TRUE(first->mesh.sources == second->mesh.sources);
}

TEST(Evaluate, IsCancelled) {
    const std::atomic<bool> stop{true};
    Context context;
    context.cancel = &stop;
    EXPECT_EQ(unite(std::vector<mesh::Mesh>{cube(0, 0, 0), cube(0.5, 0.5, 0.5)}, {}, context).error().code,
              ErrorCode::cancelled);
}

}  // namespace
}  // namespace octavo::boolean
