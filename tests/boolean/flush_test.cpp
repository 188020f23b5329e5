// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include <octavo/boolean/evaluate.hpp>
#include <octavo/mesh/disjoint_sets.hpp>

#include "effort.hpp"
#include "solids.hpp"

namespace octavo::boolean {
namespace {

constexpr Tolerance two_units{2, Tolerance::Of::lattice};

struct Shape {
    std::size_t shells = 0;
    std::size_t faces = 0;  ///< facets in one plane that are joined by edges
    double volume = 0, area = 0;
};

Vec3 normal_of(const mesh::Mesh& mesh, const mesh::Triangle& t) {
    const Vec3 normal =
        cross(mesh.vertices[t[1]] - mesh.vertices[t[0]], mesh.vertices[t[2]] - mesh.vertices[t[0]]);
    return (1 / length(normal)) * normal;
}

/// Facets count as one face when their planes meet at less than a degree.
Shape shape_of(const mesh::Mesh& mesh) {
    Shape shape;
    shape.volume = tests::volume_of(mesh);
    mesh::DisjointSets shells(mesh.triangles.size()), faces(mesh.triangles.size());
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> side;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) side[{mesh.triangles[i][k], mesh.triangles[i][(k + 1) % 3]}] = i;
    for (const auto& [edge, facet] : side) {
        const std::uint32_t across = side.at({edge.second, edge.first});
        shells.unite(facet, across);
        if (dot(normal_of(mesh, mesh.triangles[facet]), normal_of(mesh, mesh.triangles[across])) > 1 - 1e-4)
            faces.unite(facet, across);
    }
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        shape.shells += shells.find(i) == i;
        shape.faces += faces.find(i) == i;
        const mesh::Triangle& t = mesh.triangles[i];
        shape.area += length(cross(mesh.vertices[t[1]] - mesh.vertices[t[0]],
                                   mesh.vertices[t[2]] - mesh.vertices[t[0]])) /
                      2;
    }
    return shape;
}

mesh::Mesh box(std::array<double, 3> low, std::array<double, 3> high) {
    mesh::Mesh mesh = tests::box({0, 0, 0}, {1, 1, 1}).mesh;
    for (Vec3& v : mesh.vertices)
        for (int axis = 0; axis < 3; ++axis)
            v[axis] =
                v[axis] == 0 ? low[static_cast<std::size_t>(axis)] : high[static_cast<std::size_t>(axis)];
    return mesh;
}

std::vector<mesh::Mesh> turned(std::vector<mesh::Mesh> parts, Vec3 axis, double degrees) {
    axis = (1 / length(axis)) * axis;
    const double angle = degrees * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
    for (mesh::Mesh& part : parts)
        for (Vec3& v : part.vertices) v = c * v + s * cross(axis, v) + ((1 - c) * dot(axis, v)) * axis;
    return parts;
}

/// Two plates, four legs between them flush with the edges or inside, a block that fills a corner, one on top.
std::vector<mesh::Mesh> table() {
    return {box({0, 0, 0}, {10, 6, 1}), box({0, 0, 4}, {10, 6, 5}),        box({0, 0, 1}, {1, 1, 4}),
            box({9, 0, 1}, {10, 1, 4}), box({8.5, 4.5, 1}, {9.5, 5.5, 4}), box({0.5, 4.5, 1}, {1.5, 6, 4}),
            box({1, 0, 1}, {3, 2, 4}),  box({3, 1, 5}, {7, 6, 8}),         box({10, 2, 0}, {12, 4, 5})};
}

void expect_same_shape(const std::vector<mesh::Mesh>& parts, Vec3 axis, double degrees,
                       const std::string& what) {
    const Result<Evaluated> straight = unite(parts);
    const Result<Evaluated> turned_result = unite(turned(parts, axis, degrees), {.tolerance = two_units});
    ASSERT_TRUE(straight && turned_result) << what;
    EXPECT_EQ(tests::manifold_defect(turned_result->mesh), "") << what;
    const Shape expected = shape_of(straight->mesh), got = shape_of(turned_result->mesh);
    EXPECT_EQ(got.shells, expected.shells) << what;
    EXPECT_EQ(got.faces, expected.faces) << what;
    const FlushReport& flush = turned_result->report.flush;
    EXPECT_TRUE(flush.settled) << what;
    EXPECT_EQ(flush.folded_facets, 0u) << what;
    EXPECT_NEAR(got.volume, expected.volume, flush.tolerance * expected.area) << what;
    EXPECT_EQ(turned_result->report.inverted_facets, 0u) << what;
}

TEST(Flush, KeepsAnAssemblyTogetherThatIsTurned) {
    const std::vector<mesh::Mesh> parts = table();
    for (const auto& [axis, degrees] : {std::pair{Vec3{0, 0, 1}, 30.0},
                                        {Vec3{1, 0, 0}, 30.0},
                                        {Vec3{1, 2, 3}, 30.0},
                                        {Vec3{-3, 1, 0.5}, 77.0}})
        expect_same_shape(parts, axis, degrees, "a table turned by " + std::to_string(degrees));
}

TEST(Flush, TakesNoSolidForAThinShellWhateverItsScale) {
    for (const double scale : {1e-100, 1e-90, 1e-30, 1e30, 2e90, 1e100}) {
        mesh::Mesh cube = tests::box({0, 0, 0}, {1, 1, 1}).mesh;
        for (Vec3& vertex : cube.vertices) vertex = scale * vertex;
        const Result<Evaluated> result = unite({&cube, 1}, {.tolerance = scale * 1e-6});
        ASSERT_TRUE(result) << scale;
        EXPECT_EQ(result->mesh.triangles.size(), 12U) << scale;
    }
}

TEST(Flush, LeavesTheExactResultWithoutATolerance) {
    const std::vector<mesh::Mesh> parts = turned(table(), {1, 2, 3}, 30);
    const Result<Evaluated> exact = unite(parts);
    ASSERT_TRUE(exact);
    EXPECT_GT(shape_of(exact->mesh).faces, shape_of(unite(table())->mesh).faces)
        << "without slivers between the parts this test says nothing";
    EXPECT_EQ(exact->report.flush.rounds, 0u);
}

TEST(Flush, TouchesNothingThatIsExact) {
    const std::vector<mesh::Mesh> parts = table();
    const Result<Evaluated> exact = unite(parts), flush = unite(parts, {.tolerance = two_units});
    ASSERT_TRUE(exact && flush);
    EXPECT_EQ(flush->report.flush.rounds, 0u);
    EXPECT_TRUE(exact->mesh.vertices == flush->mesh.vertices);
    EXPECT_TRUE(exact->mesh.triangles == flush->mesh.triangles);
}

TEST(Flush, ClosesSlabsSlitsAndStepsOfItsOwnWidth) {
    const double gap = 0.001;
    const Options within{.tolerance = {2 * gap, Tolerance::Of::length}};
    // A slit between two blocks, one overhanging the other on all sides.
    const std::vector<mesh::Mesh> apart{box({0, 0, 0}, {4, 4, 1}), box({1, 1, 1 + gap}, {3, 3, 2})};
    const Result<Evaluated> slit = unite(apart, within);
    ASSERT_TRUE(slit);
    EXPECT_EQ(shape_of(slit->mesh).shells, 1u);
    EXPECT_EQ(shape_of(unite(apart)->mesh).shells, 2u);
    // A skin that a cut leaves.
    const std::vector<mesh::Mesh> skin{box({0, 0, 0}, {4, 4, 1}), box({1, 1, -1}, {3, 3, 1 - gap})};
    const Result<Evaluated> hole = subtract(skin, within);
    ASSERT_TRUE(hole);
    EXPECT_EQ(shape_of(hole->mesh).faces, 10u);
    EXPECT_NEAR(shape_of(hole->mesh).volume, 12, 0.1);
    // A body thinner than the tolerance vanishes, and it is said which facets did.
    const std::vector<mesh::Mesh> thin{box({0, 0, 0}, {4, 4, gap})};
    const Result<Evaluated> nothing = unite(thin, within);
    ASSERT_TRUE(nothing);
    EXPECT_TRUE(nothing->mesh.triangles.empty());
    EXPECT_GE(nothing->report.flush.removed_facets, 12u);
    EXPECT_FALSE(nothing->report.flush.first_removed.empty());
}

/// Bodies that are flush or touch in edges and corners by chance, turned: shells and volume are those of the grid.
TEST(Flush, GivesRandomTurnedAssembliesTheShellsAndVolumeOfTheGrid) {
    // Bodies that touch in an edge or a corner may come apart or join by less than the tolerance: that is one in
    // hundreds.
    std::size_t other_shells = 0, unsettled = 0, cases = 0;
    for (int run = 0; run < 100 * tests::effort() && !HasFailure(); ++run) {
        std::mt19937 random(static_cast<unsigned>(run));
        const auto number = [&](double low, double high) {
            return std::uniform_real_distribution<double>(low, high)(random);
        };
        std::vector<mesh::Mesh> parts;
        for (int k = 0; k < 4; ++k) parts.push_back(tests::random_convex(random, 4).mesh);
        const Vec3 axis{number(-1, 1), number(-1, 1), number(-1, 1)};
        const std::vector<mesh::Mesh> moved = turned(parts, axis, number(1, 90));
        for (const bool minus : {false, true}) {
            const std::string what = "run " + std::to_string(run) + (minus ? ", difference" : ", union");
            const Result<Evaluated> straight = minus ? subtract(parts) : unite(parts);
            const Result<Evaluated> result =
                minus ? subtract(moved, {.tolerance = two_units}) : unite(moved, {.tolerance = two_units});
            ASSERT_TRUE(straight && result) << what;
            EXPECT_EQ(tests::manifold_defect(result->mesh), "") << what;
            const Shape expected = shape_of(straight->mesh), got = shape_of(result->mesh);
            EXPECT_NEAR(got.volume, expected.volume, 1e-5) << what;
            other_shells += got.shells != expected.shells;
            unsettled += result->report.flush.left_alone > 0;
            ++cases;
        }
    }
    EXPECT_LE(other_shells, 1 + cases / 200);
    EXPECT_LE(unsettled, 1 + cases / 200);
}

/// A parallelepiped or something like it, with corners on a small grid, often flat, thin or folded.
mesh::Mesh random_hexahedron(std::mt19937& random) {
    const auto point = [&] {
        const auto number = [&] { return static_cast<double>(random() % 4); };
        return Vec3{number(), number(), number()};
    };
    mesh::Mesh mesh = box({0, 0, 0}, {1, 1, 1});
    const Vec3 corner = point(), a = point(), b = point(), c = point();
    for (Vec3& v : mesh.vertices) v = corner + v.x * a + v.y * b + v.z * c;
    if (random() % 4 == 0) mesh.vertices[7] = point();
    return mesh;
}

/// Whatever a tolerance larger than parts of the bodies makes of them, it opens nothing.
TEST(Flush, OpensNothingHoweverLargeTheTolerance) {
    for (int run = 0; run < 300 * tests::effort() && !HasFailure(); ++run) {
        std::mt19937 random(static_cast<unsigned>(run));
        std::vector<mesh::Mesh> parts;
        for (int k = 0; k < 3; ++k) parts.push_back(random_hexahedron(random));
        const Options options{.tolerance = {0.002 * (1 + random() % 25), Tolerance::Of::size}};
        for (const Result<Evaluated>& result : {unite(parts, options), subtract(parts, options)}) {
            ASSERT_TRUE(result) << "run " << run << ": " << result.error().sentence;
            EXPECT_EQ(tests::manifold_defect(result->mesh), "") << "run " << run;
        }
    }
}

TEST(Flush, RefusesATolerancePastAllSense) {
    const std::vector<mesh::Mesh> parts{box({0, 0, 0}, {1, 1, 1})};
    for (const double value : {-1.0, 100.0, std::nan("")})
        EXPECT_EQ(unite(parts, {.tolerance = {value, Tolerance::Of::length}}).error().code,
                  ErrorCode::bad_input);
}

}  // namespace
}  // namespace octavo::boolean
