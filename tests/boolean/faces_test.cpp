// SPDX-License-Identifier: Apache-2.0
#include <map>
#include <random>

#include <gtest/gtest.h>

#include <octavo/boolean/faces.hpp>
#include <octavo/exact/orient.hpp>

namespace octavo::boolean {
namespace {

using exact::Point;

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// Every facet comes near the next.
Pairs all_near(const Soup& soup) {
    Pairs near;
    for (std::uint32_t facet = 0; facet + 1 < soup.facets.size(); ++facet) near.push_back({facet, facet + 1});
    return near;
}

/// Of facets in the plane z = 0, seen from above.
Soup flat_soup(const std::vector<Point>& points, const std::vector<mesh::Triangle>& facets) {
    Soup soup;
    soup.points.assign(points.begin(), points.end());
    soup.facets.assign(facets.begin(), facets.end());
    soup.transition.assign(facets.size(), 0);
    return soup;
}

TEST(Faces, JoinTheTwoHalvesOfARectangle) {
    const Soup soup = flat_soup({{0, 0, 0}, {9, 0, 0}, {9, 5, 0}, {0, 5, 0}}, {{0, 1, 2}, {2, 3, 0}});
    const Faces faces(soup, all_near(soup), {});
    ASSERT_TRUE(faces.any_joined());
    EXPECT_EQ(faces.partner(0), 1U);
    EXPECT_EQ(faces.of(1), 0U);
    const Faces::Corners corners = faces.corners(soup, 0);
    ASSERT_EQ(corners.count, 4U);
    for (std::size_t k = 0; k < 4; ++k)
        EXPECT_EQ(exact::orient2d(2, soup.points[corners.vertex[k]], soup.points[corners.vertex[(k + 1) % 4]],
                                  soup.points[corners.vertex[(k + 2) % 4]]),
                  exact::Sign::positive);
}

TEST(Faces, LeaveAloneWhatIsNotOneConvexQuadrilateral) {
    const std::vector<Point> square{{0, 0, 0}, {9, 0, 0}, {9, 5, 0}, {0, 5, 0}, {3, 3, 7}};
    const auto joined = [](const Soup& soup) { return Faces(soup, all_near(soup), {}).any_joined(); };
    EXPECT_FALSE(joined(flat_soup({{0, 0, 0}, {9, 0, 0}, {9, 5, 0}, {0, 5, 1}}, {{0, 1, 2}, {2, 3, 0}})))
        << "bent";
    EXPECT_FALSE(joined(flat_soup({{0, 0, 0}, {9, 0, 0}, {1, 1, 0}, {0, 5, 0}}, {{0, 1, 2}, {2, 3, 0}})))
        << "a dart";
    EXPECT_FALSE(joined(flat_soup({{0, 0, 0}, {8, 0, 0}, {4, 4, 0}, {0, 8, 0}}, {{0, 1, 2}, {2, 3, 0}})))
        << "a triangle with a vertex on its side";
    EXPECT_FALSE(joined(flat_soup(square, {{0, 1, 2}, {0, 3, 2}}))) << "turned against each other";
    EXPECT_FALSE(joined(flat_soup(square, {{0, 1, 2}, {2, 3, 0}, {0, 2, 4}}))) << "a third facet at the edge";
    Soup two_operands = flat_soup(square, {{0, 1, 2}, {2, 3, 0}});
    two_operands.transition[1] = 1;
    EXPECT_FALSE(joined(two_operands));
    // The third facet need not come near anything.
    const Soup far = flat_soup(square, {{0, 1, 2}, {2, 3, 0}, {0, 2, 4}});
    EXPECT_FALSE(Faces(far, Pairs{{0, 1}}, {}).any_joined());
}

TEST(Faces, OfARandomMeshAreConvexAndTakeEveryFacetOnce) {
    std::mt19937 random(7);
    constexpr int side = 24;
    std::vector<Point> points;
    for (int y = 0; y <= side; ++y)
        for (int x = 0; x <= side; ++x)
            // Rows of points on one line now and then, so that quadrilaterals degenerate.
            points.push_back(
                {8 * x + static_cast<int>(random() % 5), 8 * y + static_cast<int>(random() % 2), 0});
    std::vector<mesh::Triangle> facets;
    const auto at = [](int x, int y) { return static_cast<std::uint32_t>(y * (side + 1) + x); };
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const std::uint32_t a = at(x, y), b = at(x + 1, y), c = at(x + 1, y + 1), d = at(x, y + 1);
            if (random() % 2) {
                facets.push_back({a, b, c}), facets.push_back({a, c, d});
            } else {
                facets.push_back({a, b, d}), facets.push_back({b, c, d});
            }
        }
    const Soup soup = flat_soup(points, facets);
    const Faces faces(soup, all_near(soup), {});
    std::size_t joined = 0;
    for (std::uint32_t facet = 0; facet < facets.size(); ++facet) {
        if (faces.partner(facet) == no_index) continue;
        ++joined;
        ASSERT_EQ(faces.partner(faces.partner(facet)), facet);
        const Faces::Corners corners = faces.corners(soup, faces.of(facet));
        ASSERT_EQ(corners.count, 4U);
        for (const std::uint32_t corner : facets[facet])
            EXPECT_NE(std::find(corners.vertex.begin(), corners.vertex.end(), corner), corners.vertex.end());
        for (std::size_t k = 0; k < 4; ++k)
            EXPECT_EQ(exact::orient2d(2, points[corners.vertex[k]], points[corners.vertex[(k + 1) % 4]],
                                      points[corners.vertex[(k + 2) % 4]]),
                      exact::Sign::positive);
    }
    EXPECT_GT(joined, facets.size() / 2);
}

}  // namespace
}  // namespace octavo::boolean
