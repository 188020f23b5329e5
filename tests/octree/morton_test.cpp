// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <random>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include <octavo/octree/cell.hpp>

namespace octavo::octree {
namespace {

constexpr exact::Point last_point{exact::universe_side - 1, exact::universe_side - 1,
                                  exact::universe_side - 1};

exact::Point random_point(std::mt19937& random) {
    std::uniform_int_distribution<std::int32_t> place(0, exact::universe_side - 1);
    return {place(random), place(random), place(random)};
}

TEST(Interleave, PutsEachBitWhereAPlainLoopPutsIt) {
    std::mt19937 random(1);
    for (int round = 0; round < 1000; ++round) {
        const std::uint32_t x = random() & 0x1FFFFF, y = random() & 0x1FFFFF, z = random() & 0x1FFFFF;
        std::uint64_t expected = 0;
        for (int bit = 0; bit < 21; ++bit)
            expected |= static_cast<std::uint64_t>(x >> bit & 1) << (3 * bit) |
                        static_cast<std::uint64_t>(y >> bit & 1) << (3 * bit + 1) |
                        static_cast<std::uint64_t>(z >> bit & 1) << (3 * bit + 2);
        ASSERT_EQ(interleave(x, y, z), expected);
        ASSERT_EQ(spread_bits(x) | spread_bits(y) << 1 | spread_bits(z) << 2, expected) << "portable form";
        const std::array<std::uint32_t, 3> back{x, y, z};
        ASSERT_EQ(deinterleave(expected), back);
        ASSERT_EQ(pack_bits(expected >> 1), y) << "portable form";
    }
    static_assert(interleave(1, 0, 0) == 1 && interleave(0, 1, 0) == 2 && interleave(0, 0, 1) == 4);
}

TEST(CellKey, NamesTheCellOfEachLevelThatContainsAPoint) {
    std::mt19937 random(2);
    for (int round = 0; round < 300; ++round) {
        const exact::Point p = round == 0 ? exact::Point{} : round == 1 ? last_point : random_point(random);
        CellKey above;
        for (int level = 0; level <= max_level; ++level) {
            const CellKey key = CellKey::at(p, level);
            ASSERT_TRUE(key.is_valid());
            ASSERT_EQ(key.level(), level);
            const std::int32_t mask = -cell_side(level);
            ASSERT_EQ(key.low(), (exact::Point{p.x & mask, p.y & mask, p.z & mask}));
            ASSERT_TRUE(key.contains(p));
            ASSERT_EQ(CellKey::from_code(key.code(), level), key);
            ASSERT_EQ(Cell::of(key).key(), key);
            if (level > 0) {
                ASSERT_EQ(key.parent(), above);
                ASSERT_EQ(above.child(key.child_index()), key);
                ASSERT_TRUE(above.contains(key));
                ASSERT_FALSE(key.contains(above));
            }
            for (int up = 0; up <= level; ++up) ASSERT_EQ(key.ancestor(up), CellKey::at(p, up));
            above = key;
        }
    }
    EXPECT_FALSE(CellKey().is_valid());
    EXPECT_FALSE(CellKey::from_bits(2).is_valid());
}

TEST(CellKey, HasEightOctantsThatPartitionItHalfOpen) {
    std::mt19937 random(3);
    for (int round = 0; round < 200; ++round) {
        const CellKey key = CellKey::at(random_point(random), round % max_level);
        const Cell cell = Cell::of(key);
        for (int i = 0; i < 8; ++i) {
            ASSERT_EQ(cell.child(i), Cell::of(key.child(i)));
            ASSERT_EQ(key.child(i).child_index(), i);
            if (i > 0) {
                ASSERT_LT(key.child(i - 1), key.child(i));
            }
        }
        ASSERT_LT(key.child(3), key);
        ASSERT_LT(key, key.child(4));
        // The centre belongs to the last octant; the lattice point below it to the first.
        const exact::Point c = cell.centre();
        ASSERT_TRUE(cell.child(7).contains(c));
        ASSERT_TRUE(key.child(7).contains(c));
        ASSERT_TRUE(key.child(0).contains(exact::Point{c.x - 1, c.y - 1, c.z - 1}));
        ASSERT_TRUE(key.child(1).contains(exact::Point{c.x, c.y - 1, c.z - 1}));
        ASSERT_EQ(cell.side(), 2 * cell.child(0).side());
    }
}

TEST(CellKey, FindsNeighboursByFaceEdgeAndCorner) {
    std::mt19937 random(4);
    for (int round = 0; round < 300; ++round) {
        const CellKey key = CellKey::at(random_point(random), round % (max_level + 1));
        const Cell cell = Cell::of(key);
        for (int dz = -1; dz <= 1; ++dz)
            for (int dy = -1; dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx) {
                    const auto next = key.neighbour(dx, dy, dz);
                    const std::int64_t x = cell.low.x + std::int64_t{dx} * cell.side(),
                                       y = cell.low.y + std::int64_t{dy} * cell.side(),
                                       z = cell.low.z + std::int64_t{dz} * cell.side();
                    const bool inside =
                        std::min({x, y, z}) >= 0 && std::max({x, y, z}) < exact::universe_side;
                    ASSERT_EQ(next.has_value(), inside);
                    if (!next) continue;
                    ASSERT_EQ(next->level(), key.level());
                    const exact::Point low = next->low();
                    ASSERT_TRUE(low.x == x && low.y == y && low.z == z);
                }
    }
}

TEST(Orders, SortKeysAsRecursionAndLevelByLevelVisitsDo) {
    std::vector<CellKey> depth_first, breadth_first;
    const auto visit = [&](const auto& self, CellKey key) -> void {
        depth_first.push_back(key);
        if (key.level() < 3)
            for (int i = 0; i < 8; ++i) self(self, key.child(i));
    };
    visit(visit, CellKey::root());
    for (int level = 0; level <= 3; ++level)
        for (const CellKey key : depth_first)
            if (key.level() == level) breadth_first.push_back(key);

    std::vector<CellKey> keys = depth_first;
    std::shuffle(keys.begin(), keys.end(), std::mt19937(5));
    std::sort(keys.begin(), keys.end(), DepthFirst{});
    EXPECT_EQ(keys, depth_first);
    std::shuffle(keys.begin(), keys.end(), std::mt19937(6));
    std::sort(keys.begin(), keys.end(), BreadthFirst{});
    EXPECT_EQ(keys, breadth_first);
}

}  // namespace
}  // namespace octavo::octree
