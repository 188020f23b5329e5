// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <octavo/boolean/evaluate.hpp>
#include <octavo/boolean/rounding_faults.hpp>
#include <octavo/exact/intersect.hpp>

#include "effort.hpp"
#include "solids.hpp"

namespace octavo::boolean {
namespace {

using exact::Point;
using Pairs = std::vector<NearFacets::Pair>;

/// Where the line from p to q meets the plane of a facet.
exact::EdgePoint on_plane(const Soup& soup, std::size_t facet, Point p, Point q) {
    const mesh::Triangle& t = soup.facets[facet];
    const exact::Plane plane = exact::Plane::through(soup.points[t[0]], soup.points[t[1]], soup.points[t[2]]);
    return exact::intersect_edge(p, q, plane.value_at(p), plane.value_at(q));
}

constexpr std::int32_t most = exact::universe_side - 1;

/// Facet 0 is z = 1, facet 1 the one through the x axis there that rises by one unit over the whole universe. Doubles
/// are 2^-12 units apart here, unless the world's origin is nearer.
struct TwoPlanes {
    Soup soup;
    explicit TwoPlanes(std::int64_t far = std::int64_t{1} << 40) {
        soup.lattice = *exact::Lattice::from_parts(0, {far, far, far});
        soup.points = {{0, 0, 1},   {1000, 0, 1}, {0, 1000, 1}, {most, 0, 1},  {0, most, 2},
                       {10, 10, 9}, {12, 10, 9},  {12, 9, 0},   {310, 310, 9}, {312, 310, 9}};
        soup.facets = {{0, 1, 2}, {0, 3, 4}};
    }
    /// The point of facet 1 above y = 5, by 5 · 2^-26 above facet 0.
    exact::EdgePoint above() const { return on_plane(soup, 1, {5, 5, 0}, {5, 5, 9}); }
    /// By 2^-26 beside the line that the facets share.
    exact::EdgePoint beside() const { return on_plane(soup, 1, {50, 0, 0}, {51, 1, most}); }
};

TEST(MendRounding, TakesApartFacetsThatRoundingHasMadeToTouch) {
    const TwoPlanes planes;
    PointTable points(planes.soup);
    const PointId above = points.add(planes.above());
    Surface surface;
    surface.triangles = {{0, 1, 2}, {above, 6, 5}};
    surface.facets = {{0, 0, 0}, {1, 0, 1}};
    RoundedPoints rounded(planes.soup, points);
    ASSERT_TRUE(rounded.is_moved(above));
    ASSERT_EQ(rounded.world(above).z, 0x1p40 + 1) << "in the plane of facet 0";
    const RoundingFaults faults = mend_rounding(surface, planes.soup, Pairs{{0, 1}}, rounded, {});
    EXPECT_TRUE(faults.empty());
    EXPECT_EQ(faults.moved_points, 1U);
    EXPECT_EQ(faults.farthest_move, 0x1p-12);
    EXPECT_EQ(rounded.world(above).z, 0x1p40 + 1 + 0x1p-12);
}

TEST(MendRounding, TurnsFacetsThatRoundingHasMadeFlat) {
    const TwoPlanes planes;
    PointTable points(planes.soup);
    const PointId beside = points.add(planes.beside());
    Surface surface;
    surface.triangles = {{0, 3, beside}};
    surface.facets = {{1, 0, 1}};
    RoundedPoints rounded(planes.soup, points);
    EXPECT_EQ(find_inverted(surface, planes.soup, rounded), std::vector<std::uint32_t>{0});
    const RoundingFaults faults = mend_rounding(surface, planes.soup, {}, rounded, {});
    EXPECT_TRUE(faults.empty());
    EXPECT_EQ(faults.moved_points, 1U);
    EXPECT_TRUE(find_inverted(surface, planes.soup, rounded).empty());
}

TEST(MendRounding, NamesWhatItCannotHelp) {
    const TwoPlanes planes;
    PointTable points(planes.soup);
    const PointId above = points.add(planes.above()),
                  higher = points.add(on_plane(planes.soup, 1, {5, 5, 0}, {6, 90, 9}));
    Surface surface;
    // One facet turns against its plane by far, another passes through facet 0.
    surface.triangles = {{0, 1, 2}, {3, 0, higher}, {above, 7, 6}};
    surface.facets = {{0, 0, 0}, {1, 0, 1}, {1, 0, 1}};
    RoundedPoints rounded(planes.soup, points);
    const RoundingFaults faults = mend_rounding(surface, planes.soup, Pairs{{0, 1}}, rounded, {});
    EXPECT_EQ(faults.inverted, std::vector<std::uint32_t>{1});
    EXPECT_EQ(faults.crossing, (Pairs{{0, 2}}));
}

TEST(NearFacets, AreThoseOfTheFilterAndThoseWithMoreThanACornerNearOneThatTheyShare) {
    const TwoPlanes planes(0);
    PointTable points(planes.soup);
    const PointId near = points.add(planes.above()),
                  apart = points.add(on_plane(planes.soup, 1, {300, 300, 0}, {300, 300, 9}));
    const RoundedPoints rounded(planes.soup, points);
    Surface surface;
    surface.facets = {{0, 0, 0}, {1, 0, 1}};
    const auto found = [&](const Pairs& contacts) {
        const NearFacets near_facets(surface, planes.soup, contacts, rounded, {});
        return Pairs(near_facets.pairs().begin(), near_facets.pairs().end());
    };
    // The facets share corner 0 of the soup.
    surface.triangles = {{0, 1, 2}, {apart, 9, 8}};
    EXPECT_EQ(found({}), Pairs{});
    EXPECT_EQ(found({{0, 1}}), (Pairs{{0, 1}}));
    surface.triangles[1] = {near, 6, 5};
    EXPECT_EQ(found({}), (Pairs{{0, 1}}));
}

// ------------------------------------------------------------------------------------------------ against all pairs

using Integers = std::array<std::int64_t, 3>;
using Corners = std::array<Integers, 3>;

Integers difference(const Integers& a, const Integers& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Integers product(const Integers& a, const Integers& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
std::int64_t dot(const Integers& a, const Integers& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Whether the projections on some axis of those that can separate two triangles have a gap.
bool are_apart(const Corners& a, const Corners& b) {
    const auto normal = [](const Corners& t) {
        return product(difference(t[1], t[0]), difference(t[2], t[0]));
    };
    std::vector<Integers> axes{normal(a), normal(b)};
    for (std::size_t i = 0; i < 3; ++i) {
        const Integers edge = difference(a[(i + 1) % 3], a[i]);
        axes.push_back(product(normal(a), edge));
        axes.push_back(product(normal(b), difference(b[(i + 1) % 3], b[i])));
        for (std::size_t k = 0; k < 3; ++k) axes.push_back(product(edge, difference(b[(k + 1) % 3], b[k])));
    }
    return std::any_of(axes.begin(), axes.end(), [&](const Integers& axis) {
        const auto ends = [&](const Corners& t) {
            return std::minmax({dot(axis, t[0]), dot(axis, t[1]), dot(axis, t[2])});
        };
        return ends(a).second < ends(b).first || ends(b).second < ends(a).first;
    });
}

/// Numbers are whole above the origin and halves below it, where bodies reach too: all are counted in halves. Rounding
/// them to whole ones would make facets meet that do not.
std::int64_t halves(double number) {
    EXPECT_EQ(std::rint(2 * number), 2 * number);
    return std::llrint(2 * number);
}

/// The pairs of facets without a common place of corners that meet, those aside that are flat.
std::size_t pairs_that_meet(const mesh::Mesh& mesh, Vec3 origin) {
    std::vector<Corners> facets;
    for (const mesh::Triangle& t : mesh.triangles) {
        Corners corners;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 at = mesh.vertices[t[k]] - origin;
            corners[k] = {halves(at.x), halves(at.y), halves(at.z)};
        }
        if (product(difference(corners[1], corners[0]), difference(corners[2], corners[0])) != Integers{})
            facets.push_back(corners);
    }
    std::size_t count = 0;
    for (std::size_t i = 0; i < facets.size(); ++i)
        for (std::size_t k = 0; k < i; ++k) {
            const bool common = std::any_of(facets[i].begin(), facets[i].end(), [&](const Integers& corner) {
                return std::find(facets[k].begin(), facets[k].end(), corner) != facets[k].end();
            });
            count += !common && !are_apart(facets[i], facets[k]);
        }
    return count;
}

/// A block so large that even floats are fine beside it.
mesh::Mesh far_block(Vec3 origin) {
    mesh::Mesh block = tests::box({128, 128, 128}, {512, 512, 1 << 15}).mesh;
    for (Vec3& vertex : block.vertices) vertex = vertex + origin;
    return block;
}

void append(mesh::Mesh& mesh, const mesh::Mesh& part) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), part.vertices.begin(), part.vertices.end());
    for (const mesh::Triangle& t : part.triangles)
        mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

/// So far from the world's origin that numbers are whole and bodies a few of these long; `scale` is the unit of the
/// bodies' coordinates.
void expect_all_faults_told(Numbers numbers, double far, double scale, int runs) {
    const Vec3 origin{far, far, far};
    const std::string rounding = numbers == Numbers::floats ? "rounding to floats" : "rounding to doubles";
    std::size_t mended = 0, left = 0, faulty = 0;
    for (int run = 0; run < runs * tests::effort() && !testing::Test::HasFailure(); ++run) {
        std::mt19937 random(static_cast<unsigned>(run));
        std::vector<mesh::Mesh> bodies;
        for (int body = 0; body < 2 + run % 3; ++body) {
            bodies.push_back(tests::random_convex(random, 4 + run % 5).mesh);
            for (Vec3& vertex : bodies.back().vertices) vertex = scale * (1 + run % 7) * vertex + origin;
        }
        append(bodies[0], far_block(origin));
        Options options{.numbers = numbers};
        if (run % 2) options.simplify = Simplify::none;
        const Result<Evaluated> result = run % 4 < 2    ? unite(bodies, options)
                                         : run % 4 == 2 ? subtract(bodies, options)
                                                        : symmetric_difference(bodies, options);
        ASSERT_TRUE(result);
        const std::size_t meeting = pairs_that_meet(result->mesh, origin);
        const Report& report = result->report;
        EXPECT_EQ(tests::manifold_defect(result->mesh), "");
        if (report.inverted_facets == 0) {
            EXPECT_LE(meeting, report.crossing_facets) << "run " << run;
        }
        if (meeting > 0) {
            EXPECT_GT(report.inverted_facets + report.crossing_facets, 0U) << "run " << run;
        }
        const bool told =
            std::any_of(report.warnings.begin(), report.warnings.end(),
                        [&](const std::string& warning) { return warning.starts_with(rounding); });
        EXPECT_EQ(told, report.inverted_facets + report.crossing_facets > 0);
        mended += report.mended_points;
        left += report.inverted_facets + report.crossing_facets;
        faulty += meeting;
    }
    EXPECT_GT(mended, 0U);
    EXPECT_GT(left, 0U);
    EXPECT_GT(faulty, 0U);
    testing::Test::RecordProperty("mended", static_cast<int>(mended));
    testing::Test::RecordProperty("left", static_cast<int>(left));
}

TEST(MendRounding, TellsOfAllFaultsWhereDoublesAreCoarse) {
    expect_all_faults_told(Numbers::doubles, 0x1p52, 1, 220);
}

TEST(MendRounding, TellsOfAllFaultsWhereFloatsAreCoarse) {
    expect_all_faults_told(Numbers::floats, 0x1p23, 1, 75);
    expect_all_faults_told(Numbers::floats, 0x1p23, 0.75, 75);  // vertices of operands move too
}

TEST(MendRounding, IsLeftOutForThoseWhoRoundAgain) {
    const Vec3 origin{0x1p52, 0x1p52, 0x1p52};
    std::size_t mended = 0;
    for (unsigned run = 0; run < 40; ++run) {
        std::mt19937 random(run);
        std::vector<mesh::Mesh> bodies{tests::random_convex(random, 4).mesh,
                                       tests::random_convex(random, 5).mesh};
        for (mesh::Mesh& body : bodies)
            for (Vec3& vertex : body.vertices) vertex = 3 * vertex + origin;
        append(bodies[0], far_block(origin));
        const Result<Evaluated> looked_at = unite(bodies),
                                not_looked_at = unite(bodies, {.faults = Faults::ignored});
        ASSERT_TRUE(looked_at && not_looked_at);
        EXPECT_EQ(not_looked_at->mesh.triangles, looked_at->mesh.triangles);
        EXPECT_EQ(not_looked_at->report.mended_points + not_looked_at->report.inverted_facets +
                      not_looked_at->report.crossing_facets,
                  0U);
        EXPECT_EQ(not_looked_at->mesh.vertices == looked_at->mesh.vertices,
                  looked_at->report.mended_points == 0);
        mended += looked_at->report.mended_points;
    }
    EXPECT_GT(mended, 0U);
}

TEST(Report, CountsFacetsThatDoNotBoundTheResult) {
    const auto dropped = [](const std::vector<mesh::Mesh>& bodies) {
        const Result<Evaluated> result = unite(bodies);
        EXPECT_TRUE(result);
        return result->report.dropped_facets;
    };
    const mesh::Mesh large = tests::box({0, 0, 0}, {4, 4, 4}).mesh;
    EXPECT_EQ(dropped({large, tests::box({5, 5, 5}, {6, 6, 6}).mesh}), 0U);
    EXPECT_EQ(dropped({large, tests::box({1, 1, 1}, {2, 2, 2}).mesh}), 12U);
    EXPECT_GT(dropped({large, tests::box({3, 3, 3}, {6, 6, 6}).mesh}), 0U);
}

}  // namespace
}  // namespace octavo::boolean
