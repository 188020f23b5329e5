// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octavo/io/read.hpp>
#include <octavo/mesh/measure.hpp>
#include <octavo/mesh/repair.hpp>
#include <octavo/mesh/transform.hpp>
#include <octavo/mesh/validate.hpp>

#include "models.hpp"
#include "repaired.hpp"
#include "surfaces.hpp"

namespace octavo::mesh {
namespace {

using testing::ElementsAre;

std::vector<RepairKind> kinds_of(const RepairReport& report) {
    std::vector<RepairKind> kinds;
    for (const RepairStep& step : report.steps) kinds.push_back(step.kind);
    return kinds;
}

void expect_same(const Mesh& a, const Mesh& b) {
    EXPECT_EQ(a.vertices, b.vertices);
    EXPECT_EQ(a.triangles, b.triangles);
}

Mesh moved(const Mesh& mesh, Vec3 offset) { return transform(mesh, translation(offset)); }

/// Loose triangles, some turned over, in random order.
Mesh shuffled_soup(const Mesh& solid, std::mt19937& random, double turned) {
    Mesh soup;
    std::vector<Triangle> triangles = solid.triangles;
    std::shuffle(triangles.begin(), triangles.end(), random);
    for (Triangle t : triangles) {
        if (std::uniform_real_distribution<double>(0, 1)(random) < turned) std::swap(t[0], t[1]);
        for (const VertexIndex v : t) soup.vertices.push_back(solid.vertices[v]);
        const auto n = static_cast<VertexIndex>(soup.vertices.size());
        soup.triangles.push_back({n - 3, n - 2, n - 1});
    }
    return soup;
}

TEST(Repair, LeavesSoundSolidsAlone) {
    for (const auto& [name, mesh, genus] : tests::generated_solids()) {
        const Repaired result = repaired(mesh);
        EXPECT_TRUE(result.report.steps.empty()) << name << ": " << result.report.describe();
        expect_same(result.mesh, mesh);
        EXPECT_EQ(result.mesh.sources.back(), (Source{0, static_cast<FaceIndex>(mesh.triangles.size() - 1)}));
    }
}

TEST(Repair, MakesASolidOfShuffledLooseTriangles) {
    std::mt19937 random(41);
    for (const auto& [name, mesh, genus] : tests::generated_solids())
        for (const double turned : {0.0, 0.3, 0.5, 1.0}) {
            const Repaired result = repaired(shuffled_soup(mesh, random, turned));
            const Report report = report_of(result.mesh);
            EXPECT_TRUE(report.solid && report.manifold && report.closed_as_stored)
                << name << report.describe();
            EXPECT_EQ(measure(result.mesh).volume, measure(mesh).volume) << name;
            EXPECT_EQ(measure(result.mesh).area, measure(mesh).area) << name;
            EXPECT_EQ(measure(result.mesh).genus, genus) << name;
        }
}

TEST(Repair, TellsWhatItDidAndToWhichFacets) {
    Mesh mesh = cube();
    mesh.triangles.push_back(mesh.triangles[2]);
    mesh.triangles.push_back({3, 3, 5});
    std::swap(mesh.triangles[7][0], mesh.triangles[7][2]);
    mesh.vertices.push_back({9, 9, 9});
    const Repaired result = repaired(mesh);
    EXPECT_THAT(kinds_of(result.report),
                ElementsAre(RepairKind::dropped_collapsed_facets, RepairKind::dropped_duplicate_facets,
                            RepairKind::turned_facets, RepairKind::dropped_vertices));
    EXPECT_THAT(result.report.steps[0].faces, ElementsAre(13u));
    EXPECT_THAT(result.report.steps[1].faces, ElementsAre(12u));
    EXPECT_THAT(result.report.steps[2].faces, ElementsAre(7u));
    EXPECT_TRUE(report_of(result.mesh).solid);
    EXPECT_DOUBLE_EQ(measure(result.mesh).volume, 1);
    EXPECT_EQ(result.report.describe().substr(0, 45), "1 facet that named a vertex twice was dropped");
}

TEST(Repair, ResolvesFacetsWithoutAreaAndKeepsTheSurfaceClosed) {
    // Edge 0–3 of a cube's side gets a chain of vertices on one side only, closed by needles.
    for (int links = 1; links <= 6; ++links) {
        Mesh mesh = box({0, 0, 0}, {1, 1, 1});
        // Facet 0 is {0, 2, 3}, facet 1 {0, 3, 1}: the diagonal is 3–0 in the first.
        std::vector<VertexIndex> chain{3};
        for (int i = 1; i <= links; ++i) {
            chain.push_back(static_cast<VertexIndex>(mesh.vertices.size()));
            const double t = 1 - i / 8.0;
            mesh.vertices.push_back({t, t, 0});
        }
        chain.push_back(0);
        mesh.triangles.erase(mesh.triangles.begin());
        for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
            mesh.triangles.push_back({2, chain[i], chain[i + 1]});
            if (i > 0) mesh.triangles.push_back({chain[0], chain[i + 1], chain[i]});
        }
        const Report before = report_of(mesh);
        ASSERT_EQ(before.count(ProblemKind::zero_area_facets), static_cast<std::uint64_t>(links))
            << before.describe();
        ASSERT_TRUE(before.closed);
        const Repaired result = repaired(mesh);
        const Report after = report_of(result.mesh);
        EXPECT_TRUE(after.solid && after.manifold);
        EXPECT_TRUE(after.problems.empty()) << after.describe();
        EXPECT_EQ(result.report.count(RepairKind::flipped_edges), static_cast<std::uint64_t>(links));
        EXPECT_EQ(result.mesh.triangles.size(), mesh.triangles.size());
        EXPECT_DOUBLE_EQ(measure(result.mesh).volume, 1);
        EXPECT_DOUBLE_EQ(measure(result.mesh).area, 6);
    }
}

TEST(Repair, ResolvesLongChainsOfNeedlesAtOnce) {
    // One facet with area, and a fan of needles beyond its side: each can be flipped only after the one before.
    constexpr VertexIndex links = 30'000;
    Mesh mesh;
    for (VertexIndex i = 0; i <= links; ++i) mesh.vertices.push_back({static_cast<double>(i), 0, 0});
    mesh.vertices.push_back({0, 1, 0});
    mesh.triangles.push_back({0, links, links + 1});
    for (VertexIndex i = 1; i < links; ++i) mesh.triangles.push_back({0, i, i + 1});
    const Repaired result = repaired(mesh);
    EXPECT_EQ(result.report.count(RepairKind::flipped_edges), links - 1);
    EXPECT_EQ(measure(result.mesh).area, measure(mesh).area);
    const Report after = *validate(result.mesh, {.self_intersections = false});
    EXPECT_EQ(after.count(ProblemKind::zero_area_facets), 0u);
}

TEST(Repair, RemovesInnerWallsButNoDoubleSidedSheets) {
    // Two boxes against each other with the wall between them: one box is left.
    Mesh walled = both(box({0, 0, 0}, {1, 1, 1}), box({1, 0, 0}, {2, 1, 1}));
    // The second box's left side must have the first one's diagonal, turned over.
    ASSERT_FALSE(report_of(walled).solid);
    for (Triangle& t : walled.triangles) {
        if (t == Triangle{8, 12, 14}) t = {8, 12, 10};
        if (t == Triangle{8, 14, 10}) t = {12, 14, 10};
    }
    for (Triangle& t : walled.triangles) {
        if (t == Triangle{1, 3, 7}) t = {1, 3, 5};
        if (t == Triangle{1, 7, 5}) t = {3, 7, 5};
    }
    ASSERT_EQ(report_of(walled).count(ProblemKind::duplicate_facets), 2u) << report_of(walled).describe();
    const Repaired result = repaired(walled);
    EXPECT_EQ(result.report.count(RepairKind::dropped_inner_walls), 4u);
    EXPECT_TRUE(report_of(result.mesh).solid && report_of(result.mesh).manifold);
    EXPECT_DOUBLE_EQ(measure(result.mesh).volume, 2);

    Mesh sheet{
        {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}, {2, 1, 0}, {3, 2, 0}}, {}};
    EXPECT_EQ(repaired(sheet).mesh.triangles.size(), 4u);
    Mesh skin = both(cube(), flipped(cube()));
    EXPECT_EQ(repaired(skin).mesh.triangles.size(), 24u);
}

TEST(Repair, DropsFlapsThatStandOnASolid) {
    // A strip of two squares, both sides of it, on the edge from (1, 0, 0) to (1, 1, 0): outside of the box and inside.
    for (const double x : {2.0, 0.5}) {
        Mesh flapped = box({0, 0, 0}, {1, 1, 1});
        const auto at = [&](Vec3 position) {
            flapped.vertices.push_back(position);
            return static_cast<VertexIndex>(flapped.vertices.size() - 1);
        };
        const VertexIndex a = at({x, 0.25, 0.5}), b = at({x, 0.75, 0.5}), c = at({x, 0.5, 0.7});
        for (const Triangle& t : {Triangle{1, 3, b}, Triangle{1, b, a}, Triangle{a, b, c}}) {
            flapped.triangles.push_back(t);
            flapped.triangles.push_back({t[1], t[0], t[2]});
        }
        const Repaired result = repaired(flapped);
        EXPECT_THAT(kinds_of(result.report),
                    ElementsAre(RepairKind::dropped_flaps, RepairKind::dropped_vertices));
        EXPECT_THAT(result.report.steps[0].faces, ElementsAre(12u, 13u, 14u, 15u, 16u, 17u));
        expect_same(result.mesh, box({0, 0, 0}, {1, 1, 1}));
    }
    // Of a part that is open at that edge the flap may be the rest: it stays.
    Mesh open = box({0, 0, 0}, {1, 1, 1});
    const Triangle side = open.triangles.back();
    open.triangles.pop_back();
    open.vertices.push_back({9, 9, 9});
    const auto far = static_cast<VertexIndex>(open.vertices.size() - 1);
    open.triangles.push_back({side[0], side[1], far});
    open.triangles.push_back({side[1], side[0], far});
    EXPECT_EQ(repaired(open).report.count(RepairKind::dropped_flaps), 0u);
    EXPECT_EQ(repaired(open).mesh.triangles.size(), 13u);
}

TEST(Repair, SeparatesSolidsThatTouchAtEdgesAndVertices) {
    const Mesh at_edge = both(box({0, 0, 0}, {1, 1, 1}), box({1, 1, 0}, {2, 2, 1}));
    const Repaired edge = repaired(at_edge);
    EXPECT_EQ(edge.report.count(RepairKind::separated_edges), 1u);
    EXPECT_EQ(edge.report.count(RepairKind::separated_vertices), 2u);
    EXPECT_EQ(measure(edge.mesh).components, 2u);
    EXPECT_TRUE(report_of(edge.mesh).closed_as_stored);
    EXPECT_EQ(tests::count_edges(edge.mesh), tests::EdgeCounts{});

    const Repaired vertex = repaired(both(box({0, 0, 0}, {1, 1, 1}), box({1, 1, 1}, {2, 2, 2})));
    EXPECT_EQ(vertex.report.count(RepairKind::separated_vertices), 1u);
    EXPECT_EQ(measure(vertex.mesh).components, 2u);

    // Two cavities that touch along an edge: pairs that bound the same solid would join them at both ends of the edge,
    // so those that bound the same empty space are taken.
    std::vector<Mesh> around;
    for (const auto& [x, y] : {std::pair(0, 0), std::pair(1, 1)})
        around.push_back(flipped(box({x + 0.0, y + 0.0, 0}, {x + 1.0, y + 1.0, 1})));
    around.push_back(box({-1, -1, -1}, {3, 3, 2}));
    const Repaired inner = repaired(join(around));
    EXPECT_EQ(inner.report.count(RepairKind::separated_edges), 1u);
    EXPECT_EQ(tests::count_edges(inner.mesh), tests::EdgeCounts{});
    EXPECT_DOUBLE_EQ(measure(inner.mesh).volume, 4 * 4 * 3 - 2);
}

TEST(Repair, LeavesCrowdedEdgesThatSayNothing) {
    // Three facets at an edge.
    const Mesh fan{
        {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}}, {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}}, {}};
    const Repaired result = repaired(fan);
    EXPECT_TRUE(result.report.steps.empty()) << result.report.describe();
    EXPECT_EQ(report_of(result.mesh).count(ProblemKind::non_manifold_edges), 1u);
}

TEST(Repair, TurnsShellsOutwardsAndCavitiesInwards) {
    const Mesh outer = icosphere(3, 5), inner = icosphere(1, 4), beside = moved(icosphere(1, 4), {9, 0, 0});
    const auto volume = [](const Mesh& m) { return measure(m).volume; };
    const double hollow = volume(outer) - volume(inner);
    EXPECT_DOUBLE_EQ(volume(repaired(flipped(outer)).mesh), volume(outer));
    // A hollow ball turned inside out as a whole stays hollow.
    const Repaired turned = repaired(both(flipped(outer), inner));
    EXPECT_DOUBLE_EQ(volume(turned.mesh), hollow);
    EXPECT_EQ(turned.report.count(RepairKind::turned_shells), 2u);
    EXPECT_DOUBLE_EQ(volume(repaired(both(outer, flipped(inner))).mesh), hollow);
    // Bodies in bodies, both outwards, are no cavity: nothing is wrong with them.
    EXPECT_TRUE(repaired(both(outer, inner)).report.steps.empty());
    EXPECT_DOUBLE_EQ(volume(repaired(both(outer, flipped(beside))).mesh), volume(outer) + volume(beside));
    // Where the facets disagree among themselves the nesting decides.
    std::mt19937 random(42);
    const Repaired soup = repaired(shuffled_soup(both(outer, inner), random, 0.5));
    EXPECT_DOUBLE_EQ(volume(soup.mesh), hollow);
    EXPECT_TRUE(report_of(soup.mesh).solid);
    EXPECT_EQ(report_of(soup.mesh).cavities, 1u);
}

TEST(Repair, LeavesOneSidedSurfacesAlone) {
    Mesh band;
    const int steps = 30;
    for (int i = 0; i < steps; ++i) {
        const double a = 2 * 3.14159265358979 * i / steps;
        for (const double s : {-0.3, 0.3}) {
            const double r = 1 + s * std::cos(a / 2);
            band.vertices.push_back({r * std::cos(a), r * std::sin(a), s * std::sin(a / 2)});
        }
    }
    for (VertexIndex i = 0; i < steps; ++i) {
        const VertexIndex a = 2 * i, b = 2 * i + 1;
        const bool last = i + 1 == steps;
        const VertexIndex c = last ? 1 : a + 2, d = last ? 0 : a + 3;
        band.triangles.push_back({a, c, b});
        band.triangles.push_back({b, c, d});
    }
    const Repaired result = repaired(band);
    EXPECT_TRUE(result.report.steps.empty()) << result.report.describe();
    EXPECT_EQ(result.mesh.triangles, band.triangles);
}

TEST(Repair, TwiceIsRepairOnce) {
    std::mt19937 random(43);
    std::uniform_int_distribution<int> coordinate(0, 3);
    for (int round = 0; round < 300; ++round) {
        Mesh soup;
        for (int i = 0; i < 14; ++i)
            soup.vertices.push_back(
                {coordinate(random) + 0.0, coordinate(random) + 0.0, coordinate(random) + 0.0});
        std::uniform_int_distribution<VertexIndex> vertex(0, 13);
        for (int i = 0; i < 30; ++i)
            soup.triangles.push_back({vertex(random), vertex(random), vertex(random)});
        const Mesh once = repaired(soup).mesh, twice = repaired(once).mesh;
        expect_same(once, twice);
    }
}

TEST(Repair, KeepsTheSourcesOfAMeshThatHasThem) {
    Mesh mesh = cube();
    for (FaceIndex i = 0; i < 12; ++i) mesh.sources.push_back({3, 100 + i});
    mesh.triangles.push_back(mesh.triangles[0]);
    mesh.sources.push_back({4, 0});
    const Repaired result = repaired(mesh);
    ASSERT_EQ(result.mesh.sources.size(), 12u);
    EXPECT_EQ(result.mesh.sources[11], (Source{3, 111}));
}

TEST(Repair, OfEveryModelIsStableAndHarmless) {
    OCTAVO_NEEDS_MODEL("defective");
    for (const char* folder : {"defective", "mechanical"})
        for (const auto& entry : std::filesystem::directory_iterator(tests::models_folder() / folder)) {
            SCOPED_TRACE(entry.path().filename().string());
            const auto read = io::read_mesh(entry.path().string());
            ASSERT_TRUE(read.has_value());
            ValidateOptions quick;
            quick.self_intersections = false;
            const Report before = *validate(read->mesh, quick);
            const Repaired result = repaired(read->mesh);
            const Report after = *validate(result.mesh, quick);
            EXPECT_LE(after.count(ProblemKind::open_edges), before.count(ProblemKind::open_edges));
            EXPECT_LE(after.count(ProblemKind::inconsistent_orientation),
                      before.count(ProblemKind::inconsistent_orientation));
            EXPECT_EQ(after.count(ProblemKind::inside_out_shells), 0u);
            EXPECT_LE(after.count(ProblemKind::zero_area_facets),
                      before.count(ProblemKind::zero_area_facets));
            EXPECT_TRUE(after.oriented || before.count(ProblemKind::non_manifold_edges) > 0 ||
                        entry.path().filename() == "moebius.obj");
            if (before.closed) {
                EXPECT_TRUE(after.closed);
            }
            expect_same(repaired(result.mesh).mesh, result.mesh);
        }
}

}  // namespace
}  // namespace octavo::mesh
