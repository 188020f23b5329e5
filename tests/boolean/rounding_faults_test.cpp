// SPDX-License-Identifier: Apache-2.0
#include <random>

#include <boost/multiprecision/cpp_int.hpp>
#include <gtest/gtest.h>

#include <octavo/boolean/rounding_faults.hpp>
#include <octavo/exact/intersect.hpp>

namespace octavo::boolean {
namespace {

using exact::Point;

/// A soup of facets on the lattice whose unit is 1.
Soup soup_of(std::vector<Point> points, std::vector<mesh::Triangle> facets) {
    Soup soup;
    soup.points = std::move(points);
    soup.facets = std::move(facets);
    return soup;
}

/// Where the line from p to q meets the plane of a facet.
exact::EdgePoint on_plane(const Soup& soup, std::size_t facet, Point p, Point q) {
    const mesh::Triangle& t = soup.facets[facet];
    const exact::Plane plane = exact::Plane::through(soup.points[t[0]], soup.points[t[1]], soup.points[t[2]]);
    return exact::intersect_edge(p, q, plane.value_at(p), plane.value_at(q));
}

constexpr std::int32_t most = exact::universe_side - 1;

/// The facet z = 1, and the one through the x axis there that rises by one unit over the whole universe.
Soup two_planes() {
    return soup_of(
        {{0, 0, 1}, {100, 0, 1}, {0, 100, 1}, {most, 0, 1}, {0, most, 2}, {10, 10, 9}, {12, 10, 9}},
        {{0, 1, 2}, {0, 3, 4}});
}

TEST(RoundingFaults, NamesFacetsThatMeetOnlyOnceTheyAreRounded) {
    // The point lies 2^-52 above the facet.
    const Soup soup = two_planes();
    PointTable points(soup);
    const PointId above = points.add(on_plane(soup, 1, {5, 0, 0}, {5, 1, most}));
    Surface surface;
    surface.triangles = {{0, 1, 2}, {above, 6, 5}};
    surface.facets = {{0, 0, 0}, {0, 0, 1}};
    const RoundedPoints rounded(soup, points);
    EXPECT_TRUE(rounded.is_moved(above));
    EXPECT_EQ(rounded.world(above).z, 1);
    const RoundingFaults faults = find_rounding_faults(surface, soup, rounded, {});
    EXPECT_EQ(faults.crossing, (std::vector<std::pair<std::uint32_t, std::uint32_t>>{{0, 1}}));

    // A point that is clearly above the facet is no fault.
    const PointId higher = points.add(on_plane(soup, 1, {5, 90, 0}, {5, 91, most}));
    surface.triangles[1][0] = higher;
    EXPECT_TRUE(find_rounding_faults(surface, soup, RoundedPoints(soup, points), {}).crossing.empty());
}

TEST(RoundingFaults, NamesFacetsThatBecomeFlat) {
    const Soup soup = two_planes();
    PointTable points(soup);
    // In the plane z = 1 + y / most, 2^-52 from the line y = 0.
    const PointId beside = points.add(on_plane(soup, 1, {50, 0, 0}, {50, 0, 5}));
    EXPECT_TRUE(points.lattice_point(beside)) << "the line y = 0 lies in the plane";
    const PointId near = points.add(on_plane(soup, 1, {50, 0, 0}, {51, 1, most}));
    Surface surface;
    surface.triangles = {{0, 3, near}};
    surface.facets = {{1, 0, 1}};
    const RoundingFaults faults = find_rounding_faults(surface, soup, RoundedPoints(soup, points), {});
    // 1 / most is the unit that coordinates are rounded to, so the facet keeps its turn.
    EXPECT_TRUE(faults.inverted.empty());
    surface.triangles = {{3, 0, near}};
    EXPECT_EQ(find_rounding_faults(surface, soup, RoundedPoints(soup, points), {}).inverted,
              std::vector<std::uint32_t>{0});
}

TEST(RoundedPoints, HaveExactPredicates) {
    using Number = boost::multiprecision::cpp_int;
    std::mt19937_64 random(3);
    for (int run = 0; run < 20000; ++run) {
        RoundedPoints::Point p[4];
        const int bits = run % 3 == 0 ? 2 : 52;
        for (auto& point : p)
            for (auto& x : point) x = static_cast<std::int64_t>(random() >> (64 - bits));
        // Often nearly in one plane.
        if (run % 3 == 1)
            for (std::size_t k = 0; k < 3; ++k)
                p[3][k] = (p[0][k] + p[1][k]) / 2 + static_cast<int>(random() % 2);
        Number u[3], v[3], w[3];
        for (std::size_t k = 0; k < 3; ++k)
            u[k] = p[1][k] - p[0][k], v[k] = p[2][k] - p[0][k], w[k] = p[3][k] - p[0][k];
        const Number normal[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                                  u[0] * v[1] - u[1] * v[0]};
        const Number volume = normal[0] * w[0] + normal[1] * w[1] + normal[2] * w[2];
        EXPECT_EQ(static_cast<int>(orient3d(p[0], p[1], p[2], p[3])), volume.sign());
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_EQ(static_cast<int>(orient2d(axis, p[0], p[1], p[2])), normal[axis].sign());
    }
}

}  // namespace
}  // namespace octavo::boolean
