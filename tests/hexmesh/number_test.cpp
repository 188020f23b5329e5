// SPDX-License-Identifier: Apache-2.0
#include <map>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include <octavo/hexmesh/number.hpp>

#include "hexmesh/trees.hpp"

namespace octavo::hexmesh {
namespace {

using exact::Point;
using octree::CellKey;
using octree::Contact;

Point corner_of(CellKey key, unsigned corner) {
    const Point low = key.low();
    const std::int32_t side = key.side();
    return {low.x + (corner & 1 ? side : 0), low.y + (corner & 2 ? side : 0),
            low.z + (corner & 4 ? side : 0)};
}

/// What the numbering must say, from comparing every node with every cell.
struct Expected {
    std::set<Point> nodes;
    std::map<Point, std::set<Point>> masters;  ///< of hanging nodes
};

Expected by_brute_force(const std::vector<CellKey>& cells) {
    Expected expected;
    for (const CellKey cell : cells)
        for (unsigned corner = 0; corner < 8; ++corner) expected.nodes.insert(corner_of(cell, corner));
    for (const Point node : expected.nodes)
        for (const CellKey cell : cells) {
            // Per axis: 0 low, 1 high, 2 strictly between, 3 away.
            int strict = 0, away = 0;
            unsigned fixed = 0, high = 0;
            for (int axis = 0; axis < 3; ++axis) {
                const std::int64_t offset = std::int64_t{node[axis]} - cell.low()[axis];
                if (offset < 0 || offset > cell.side())
                    ++away;
                else if (offset > 0 && offset < cell.side())
                    ++strict;
                else
                    fixed |= 1U << axis, high |= offset > 0 ? 1U << axis : 0;
            }
            if (away || strict == 0) continue;
            EXPECT_LT(strict, 3) << "a node inside a cell";
            std::set<Point> masters;
            for (unsigned corner = 0; corner < 8; ++corner)
                if ((corner & fixed) == high) masters.insert(corner_of(cell, corner));
            auto [at, fresh] = expected.masters.emplace(node, masters);
            if (!fresh && masters.size() < at->second.size()) at->second = masters;
        }
    return expected;
}

void expect_numbering(const std::vector<CellKey>& leaves, const std::vector<std::uint8_t>& kept) {
    const Result<Numbering> numbered = number_nodes(leaves, kept);
    ASSERT_TRUE(numbered);
    std::vector<CellKey> cells;
    for (std::size_t i = 0; i < leaves.size(); ++i)
        if (kept.empty() || kept[i]) cells.push_back(leaves[i]);
    const Expected expected = by_brute_force(cells);

    ASSERT_EQ(numbered->corners.size(), cells.size());
    ASSERT_EQ(numbered->nodes.size(), expected.nodes.size());
    EXPECT_EQ(std::set<Point>(numbered->nodes.begin(), numbered->nodes.end()), expected.nodes);
    for (std::size_t i = 0; i < cells.size(); ++i)
        for (unsigned corner = 0; corner < 8; ++corner)
            ASSERT_EQ(numbered->nodes[numbered->corners[i][corner]], corner_of(cells[i], corner));

    std::map<Point, std::set<Point>> masters;
    const auto note = [&](const auto& hanging) {
        std::set<Point> points;
        for (const mesh::NodeIndex master : hanging.masters) points.insert(numbered->nodes[master]);
        EXPECT_EQ(points.size(), hanging.masters.size());
        EXPECT_TRUE(masters.emplace(numbered->nodes[hanging.node], points).second) << "listed twice";
    };
    for (const auto& hanging : numbered->edge_hanging) note(hanging);
    for (const auto& hanging : numbered->face_hanging) note(hanging);
    EXPECT_EQ(masters, expected.masters);
    for (const auto& [node, of_node] : masters)
        for (const Point master : of_node) EXPECT_FALSE(masters.contains(master)) << "a chain";
}

std::vector<CellKey> random_tree(std::mt19937& random, int round) {
    if (round % 2) return random_leaves(random, 3, 3 + static_cast<unsigned>(round) % 5);
    return refined_at({random_point(random), random_point(random)}, 4 + round % 3);
}

TEST(NumberNodes, FindsTheNodesAndMastersThatBruteForceFinds) {
    std::mt19937 random(1);
    for (int round = 0; round < 16; ++round) {
        const std::vector<CellKey> leaves = random_tree(random, round);
        for (const Contact contact : {Contact::edge, Contact::corner})
            expect_numbering(octree::balance(leaves, contact), {});
    }
}

TEST(NumberNodes, LooksAtKeptCellsOnly) {
    std::mt19937 random(2);
    for (int round = 0; round < 16; ++round) {
        const std::vector<CellKey> leaves = octree::balance(random_tree(random, round), Contact::edge);
        std::vector<std::uint8_t> kept(leaves.size());
        for (std::uint8_t& keep : kept) keep = random() % 3 != 0;
        expect_numbering(leaves, kept);
    }
}

TEST(NumberNodes, NumbersTheCornersOfATreeBalancedByFaces) {
    std::mt19937 random(3);
    for (int round = 0; round < 16; ++round) {
        const std::vector<CellKey> leaves = octree::balance(random_tree(random, round), Contact::face);
        const Result<Numbering> numbered = number_nodes(leaves);
        ASSERT_TRUE(numbered);
        const Expected expected = by_brute_force(leaves);
        EXPECT_EQ(std::set<Point>(numbered->nodes.begin(), numbered->nodes.end()), expected.nodes);
        EXPECT_EQ(numbered->nodes.size(), expected.nodes.size());
        for (std::size_t i = 0; i < leaves.size(); ++i)
            for (unsigned corner = 0; corner < 8; ++corner)
                ASSERT_EQ(numbered->nodes[numbered->corners[i][corner]], corner_of(leaves[i], corner));
        std::set<Point> hanging, expected_hanging;
        for (const auto& entry : numbered->edge_hanging) hanging.insert(numbered->nodes[entry.node]);
        for (const auto& entry : numbered->face_hanging) hanging.insert(numbered->nodes[entry.node]);
        for (const auto& [node, masters] : expected.masters) expected_hanging.insert(node);
        EXPECT_EQ(hanging, expected_hanging);
    }
}

TEST(NumberNodes, MeetsTheDeepestLevel) {
    constexpr std::int32_t last = exact::universe_side - 1;
    const std::vector<CellKey> leaves =
        octree::balance(refined_at({{last, last, last}, {last / 2, last / 2, 0}}, octree::max_level));
    expect_numbering(leaves, {});
}

TEST(NumberNodes, OfNoCellsAreNone) {
    const std::vector<CellKey> leaves{CellKey::root()};
    const Result<Numbering> none = number_nodes(leaves, std::vector<std::uint8_t>{0});
    ASSERT_TRUE(none);
    EXPECT_TRUE(none->nodes.empty() && none->corners.empty());
    const Result<Numbering> all = number_nodes(leaves);
    ASSERT_TRUE(all);
    EXPECT_EQ(all->nodes.size(), 8u);
}

TEST(NumberNodes, RefusesLeavesThatAreNotBalanced) {
    const std::vector<CellKey> leaves = refined_at({{exact::universe_side / 2 - 1, 0, 0}}, 5);
    EXPECT_DEATH(static_cast<void>(number_nodes(leaves)), "not balanced");
}

}  // namespace
}  // namespace octavo::hexmesh
