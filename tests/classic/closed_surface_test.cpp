// SPDX-License-Identifier: Apache-2.0
#include <classic/solids.hpp>
#include <gtest/gtest.h>

#include <octavo/classic/closed_surface.hpp>

namespace octavo::classic {
namespace {

using tests::box;

mesh::LatticeMesh soup_of(const mesh::LatticeMesh& mesh) {
    mesh::LatticeMesh soup;
    for (const mesh::Triangle& t : mesh.triangles) {
        const auto first = static_cast<mesh::VertexIndex>(soup.points.size());
        for (const mesh::VertexIndex vertex : t) soup.points.push_back(mesh.points[vertex]);
        soup.triangles.push_back({first, first + 1, first + 2});
    }
    return soup;
}

TEST(OpenEdges, AcceptsEverythingWhoseEdgesBalance) {
    const mesh::LatticeMesh cube = box({0, 0, 0}, {10, 10, 10});
    EXPECT_TRUE(open_edges(cube).empty());
    EXPECT_TRUE(open_edges(soup_of(cube)).empty()) << "triangle soup";
    mesh::LatticeMesh two = cube;
    tests::append(two, box({10, 10, 0}, {20, 20, 10}));
    EXPECT_TRUE(open_edges(two).empty()) << "a shared edge";
    tests::append(two, tests::reversed(cube));
    EXPECT_TRUE(open_edges(two).empty()) << "coincident and inside out";
    mesh::LatticeMesh with_sliver = cube;
    with_sliver.triangles.push_back({0, 1, 1});
    EXPECT_TRUE(open_edges(with_sliver).empty()) << "a facet that is a doubled edge";
    EXPECT_TRUE(open_edges({}).empty());
}

TEST(OpenEdges, NamesTheEdgesOfAMissingFacetWithTheirDirection) {
    mesh::LatticeMesh cube = box({0, 0, 0}, {10, 10, 10});
    const mesh::Triangle missing = cube.triangles.back();
    cube.triangles.pop_back();
    const std::vector<OpenEdge> open = open_edges(cube);
    ASSERT_EQ(open.size(), 3u);
    for (const OpenEdge& edge : open) {
        EXPECT_EQ(edge.surplus, 1);
        bool reversed_use = false;
        for (std::size_t i = 0; i < 3; ++i)
            reversed_use = reversed_use || (missing[i] == edge.to && missing[(i + 1) % 3] == edge.from);
        EXPECT_TRUE(reversed_use) << "the missing facet would use the edge the other way";
        const mesh::Triangle& user = cube.triangles[edge.face];
        EXPECT_EQ(std::count(user.begin(), user.end(), edge.from), 1);
        EXPECT_EQ(std::count(user.begin(), user.end(), edge.to), 1);
    }
    const Error error = open_surface_error(open);
    EXPECT_EQ(error.code, ErrorCode::not_a_solid);
    EXPECT_EQ(error.place.faces.size(), 3u);
}

TEST(OpenEdges, CountsFacetsThatRunTheSameWay) {
    mesh::LatticeMesh cube = box({0, 0, 0}, {10, 10, 10});
    std::swap(cube.triangles[4][0], cube.triangles[4][1]);
    const std::vector<OpenEdge> open = open_edges(cube);
    ASSERT_EQ(open.size(), 3u);
    for (const OpenEdge& edge : open) EXPECT_EQ(edge.surplus, 2);
}

TEST(CloseHoles, MakesEverySurfaceBalanced) {
    mesh::LatticeMesh cube = box({0, 0, 0}, {10, 10, 10});
    tests::append(cube, soup_of(box({100, 0, 0}, {110, 10, 10})));
    for (std::size_t drop = 0; drop < 7; ++drop) {
        cube.triangles.erase(cube.triangles.begin() +
                             static_cast<std::ptrdiff_t>((drop * 5) % cube.triangles.size()));
        const std::vector<OpenEdge> open = open_edges(cube);
        ASSERT_FALSE(open.empty());
        const mesh::LatticeMesh closed = close_holes(cube, open);
        EXPECT_TRUE(open_edges(closed).empty()) << drop;
    }
}

TEST(CloseHoles, RestoresAFlatHoleExactly) {
    const mesh::LatticeMesh whole = box({0, 0, 0}, {12, 12, 12});
    mesh::LatticeMesh open = whole;
    open.triangles.erase(open.triangles.begin() + 2, open.triangles.begin() + 4);
    const mesh::LatticeMesh closed = close_holes(open, open_edges(open));
    EXPECT_EQ(closed.triangles.size(), whole.triangles.size() + 2);
    EXPECT_TRUE(tests::six_volumes(closed) == tests::six_volumes(whole));
}

}  // namespace
}  // namespace octavo::classic
