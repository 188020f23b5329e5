// SPDX-License-Identifier: Apache-2.0
#include <map>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include <octavo/mesh/topology.hpp>
#include <octavo/mesh/transform.hpp>
#include <octavo/mesh/weld.hpp>

#include "surfaces.hpp"

namespace octavo::mesh {
namespace {

std::vector<Triangle> random_soup(std::mt19937& random, std::size_t triangles, VertexIndex vertices) {
    std::uniform_int_distribution<VertexIndex> vertex(0, vertices - 1);
    std::vector<Triangle> soup;
    for (std::size_t i = 0; i < triangles; ++i)
        soup.push_back({vertex(random), vertex(random), vertex(random)});
    return soup;
}

TEST(EdgeTable, HoldsTheSidesThatAMapHolds) {
    std::mt19937 random(1);
    for (int round = 0; round < 300; ++round) {
        const VertexIndex vertices = 1 + round % 40;
        const auto soup = random_soup(random, static_cast<std::size_t>(round % 70), vertices);
        std::map<std::array<VertexIndex, 2>, std::vector<SideIndex>> expected;
        for (SideIndex side = 0; side < 3 * soup.size(); ++side) {
            const Triangle& t = soup[side / 3];
            if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
            const VertexIndex a = t[side % 3], b = t[(side + 1) % 3];
            expected[{std::min(a, b), std::max(a, b)}].push_back(side);
        }
        const EdgeTable edges = build_edges(soup, vertices);
        ASSERT_EQ(edges.size(), expected.size());
        EdgeIndex edge = 0;
        std::size_t sides = 0;
        for (const auto& [ends, expected_sides] : expected) {
            EXPECT_EQ(edges.ends[edge], ends);
            const auto found = edges.sides_of(edge);
            EXPECT_EQ(std::vector(found.begin(), found.end()), expected_sides);
            for (const SideIndex side : expected_sides) EXPECT_EQ(edges.edge_of_side[side], edge);
            sides += expected_sides.size(), ++edge;
        }
        EXPECT_EQ(sides, edges.sides.size());
    }
}

/// Spreads labels until nothing changes.
template <class Together>
std::vector<std::uint32_t> labels_by_spreading(std::size_t count, const Together& together) {
    std::vector<std::uint32_t> label(count);
    for (std::uint32_t i = 0; i < count; ++i) label[i] = i;
    for (bool changed = true; changed;) {
        changed = false;
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t j = 0; j < count; ++j)
                if (label[j] < label[i] && together(i, j)) label[i] = label[j], changed = true;
    }
    return label;
}

template <class Label>
std::set<std::set<std::size_t>> partition(const std::vector<Label>& labels) {
    std::map<Label, std::set<std::size_t>> groups;
    for (std::size_t i = 0; i < labels.size(); ++i) groups[labels[i]].insert(i);
    std::set<std::set<std::size_t>> result;
    for (const auto& [label, group] : groups) result.insert(group);
    return result;
}

TEST(EdgeTable, HasALimitThatIsSaid) {
    EXPECT_TRUE(check_sides_can_be_numbered(most_sided_triangles));
    EXPECT_LT(3 * most_sided_triangles + 2, std::size_t{no_index});
    const Status refused = check_sides_can_be_numbered(most_sided_triangles + 1);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::limit);
    EXPECT_TRUE(check_sides_can_be_numbered(std::size_t{1} << 30));
    EXPECT_FALSE(check_sides_can_be_numbered((std::size_t{1} << 32) + 12)) << "32 bits of it would pass";
}

TEST(Components, AreThoseOfSpreadingLabels) {
    std::mt19937 random(2);
    for (int round = 0; round < 60; ++round) {
        const VertexIndex vertices = 30;
        const auto soup = random_soup(random, 16, vertices);
        const auto common = [&](std::size_t i, std::size_t j) {
            std::set<VertexIndex> a(soup[i].begin(), soup[i].end()), shared;
            for (const VertexIndex v : soup[j])
                if (a.contains(v)) shared.insert(v);
            return shared.size();
        };
        const auto proper = [&](std::size_t i) {
            return std::set<VertexIndex>(soup[i].begin(), soup[i].end()).size() == 3;
        };
        const Components by_vertex = components_by_vertex(soup, vertices);
        EXPECT_EQ(
            partition(by_vertex.of_face),
            partition(labels_by_spreading(soup.size(), [&](auto i, auto j) { return common(i, j) >= 1; })));
        const Components by_edge = components_by_edge(build_edges(soup, vertices), soup.size());
        EXPECT_EQ(partition(by_edge.of_face), partition(labels_by_spreading(soup.size(), [&](auto i, auto j) {
                      return proper(i) && proper(j) && common(i, j) >= 2;
                  })));
        EXPECT_EQ(by_vertex.count, partition(by_vertex.of_face).size());
        EXPECT_EQ(by_vertex.of_face[0], 0u);
    }
}

TEST(Fans, AreCornersJoinedByEdgesAtTheirVertex) {
    std::mt19937 random(3);
    for (int round = 0; round < 60; ++round) {
        const VertexIndex vertices = 9;
        const auto soup = random_soup(random, 12, vertices);
        const auto fans = fan_of_corner(build_edges(soup, vertices), soup);
        const auto vertex = [&](std::size_t corner) { return soup[corner / 3][corner % 3]; };
        const auto proper = [&](std::size_t corner) {
            return std::set<VertexIndex>(soup[corner / 3].begin(), soup[corner / 3].end()).size() == 3;
        };
        const auto expected = labels_by_spreading(fans.size(), [&](std::size_t i, std::size_t j) {
            if (vertex(i) != vertex(j) || !proper(i) || !proper(j)) return false;
            for (const VertexIndex a : soup[i / 3])
                for (const VertexIndex b : soup[j / 3])
                    if (a == b && a != vertex(i)) return true;
            return false;
        });
        EXPECT_EQ(partition(fans), partition(expected));
        for (std::size_t corner = 0; corner < fans.size(); ++corner) EXPECT_LE(fans[corner], corner);
    }
}

TEST(Weld, JoinsEqualPositionsOnly) {
    std::mt19937 random(4);
    for (const auto& [name, mesh, genus] : tests::generated_solids()) {
        Mesh soup;
        for (const Triangle& t : mesh.triangles) {
            const auto base = static_cast<VertexIndex>(soup.vertices.size());
            for (const VertexIndex v : t) soup.vertices.push_back(mesh.vertices[v]);
            soup.triangles.push_back({base, base + 1, base + 2});
        }
        const Mesh welded = weld(soup);
        EXPECT_EQ(welded.vertices.size(), mesh.vertices.size()) << name;
        EXPECT_EQ(tests::count_edges(welded), tests::EdgeCounts{}) << name;
        for (std::size_t face = 0; face < mesh.triangles.size(); ++face)
            for (std::size_t k = 0; k < 3; ++k)
                ASSERT_EQ(welded.vertices[welded.triangles[face][k]], mesh.vertices[mesh.triangles[face][k]]);
    }
}

TEST(Weld, TakesMinusZeroForZeroAndKeepsTheOrder) {
    const std::vector<Vec3> positions{{1, 0, 0}, {0.0, 0, 0}, {1, -0.0, 0}, {-0.0, 0, -0.0}, {1, 0, 5e-324}};
    const WeldMap map = equal_vertices(positions);
    EXPECT_EQ(map.index, (std::vector<VertexIndex>{0, 1, 0, 1, 2}));
    EXPECT_EQ(map.kept, (std::vector<VertexIndex>{0, 1, 4}));
}

}  // namespace
}  // namespace octavo::mesh
