// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <random>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include <octavo/octree/balance.hpp>

namespace octavo::octree {
namespace {

constexpr std::array contacts{Contact::face, Contact::edge, Contact::corner};

void grow(std::mt19937& random, std::vector<CellKey>& leaves, CellKey key, int depth, unsigned split_of_ten) {
    if (key.level() == depth || random() % 10 >= split_of_ten) {
        leaves.push_back(key);
        return;
    }
    for (int i = 0; i < 8; ++i) grow(random, leaves, key.child(i), depth, split_of_ten);
}

/// Refines around a few points down to `depth`: as unbalanced as a tree can be.
std::vector<CellKey> refined_at(std::vector<exact::Point> points, int depth) {
    std::vector<CellKey> leaves, open{CellKey::root()};
    while (!open.empty()) {
        const CellKey key = open.back();
        open.pop_back();
        const bool split =
            key.level() < depth &&
            std::any_of(points.begin(), points.end(), [&](exact::Point p) { return key.contains(p); });
        if (split)
            for (int i = 7; i >= 0; --i) open.push_back(key.child(i));
        else
            leaves.push_back(key);
    }
    return leaves;
}

/// How many axes the closed boxes of two disjoint cells touch along in a single coordinate; 4 when they do not touch.
int contact_axes(CellKey a, CellKey b) {
    int axes = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const std::int64_t low = std::max(a.low()[axis], b.low()[axis]);
        const std::int64_t high = std::min<std::int64_t>(std::int64_t{a.low()[axis]} + a.side(),
                                                         std::int64_t{b.low()[axis]} + b.side());
        if (high < low) return 4;
        axes += high == low;
    }
    return axes;
}

/// Compares all pairs of leaves and splits whatever is two levels larger than something it touches, until nothing is.
std::vector<CellKey> balanced_by_brute_force(const std::vector<CellKey>& leaves, Contact contact) {
    const int most_axes = static_cast<int>(contact) + 1;
    std::set<CellKey> cells(leaves.begin(), leaves.end());
    for (bool changed = true; changed;) {
        changed = false;
        std::vector<CellKey> too_large;
        for (const CellKey a : cells)
            for (const CellKey b : cells)
                if (a.level() + 1 < b.level() && contact_axes(a, b) <= most_axes) {
                    too_large.push_back(a);
                    break;
                }
        for (const CellKey cell : too_large) {
            changed = true;
            cells.erase(cell);
            for (int i = 0; i < 8; ++i) cells.insert(cell.child(i));
        }
    }
    return {cells.begin(), cells.end()};
}

exact::Point random_point(std::mt19937& random) {
    std::uniform_int_distribution<std::int32_t> place(0, exact::universe_side - 1);
    return {place(random), place(random), place(random)};
}

TEST(Balance, IsTheSmallestRefinementThatBruteForceFinds) {
    std::mt19937 random(1);
    for (int round = 0; round < 24; ++round) {
        std::vector<CellKey> leaves;
        if (round % 2)
            grow(random, leaves, CellKey::root(), 3, 3 + static_cast<unsigned>(round) % 5);
        else
            leaves = refined_at({random_point(random), random_point(random)}, 4 + round % 3);
        for (const Contact contact : contacts) {
            const std::vector<CellKey> balanced = balance(leaves, contact);
            ASSERT_EQ(balanced, balanced_by_brute_force(leaves, contact));
            ASSERT_TRUE(is_balanced(balanced, contact));
        }
    }
}

TEST(Balance, TellsTheContactsApart) {
    // One deep corner in the middle of the universe: its neighbours by corner are only refined for Contact::corner.
    const exact::Point middle{exact::universe_side / 2, exact::universe_side / 2, exact::universe_side / 2};
    const std::vector<CellKey> leaves = refined_at({middle}, 4);
    const auto face = balance(leaves, Contact::face), edge = balance(leaves, Contact::edge),
               corner = balance(leaves, Contact::corner);
    EXPECT_LT(face.size(), edge.size());
    EXPECT_LT(edge.size(), corner.size());
    EXPECT_FALSE(is_balanced(face, Contact::edge));
    EXPECT_FALSE(is_balanced(edge, Contact::corner));
    EXPECT_TRUE(is_balanced(corner, Contact::face));
}

TEST(Balance, ReachesTheDeepestLevelAndTheUniverseSides) {
    constexpr std::int32_t last = exact::universe_side - 1;
    const std::vector<CellKey> leaves =
        refined_at({{0, 0, 0}, {last, last, last}, {last, 0, last / 3}}, max_level);
    for (const Contact contact : contacts) {
        const std::vector<CellKey> balanced = balance(leaves, contact);
        EXPECT_TRUE(is_balanced(balanced, contact));
        EXPECT_TRUE(std::is_sorted(balanced.begin(), balanced.end()));
        LatticeVolume volume = 0;
        for (const CellKey key : balanced) volume += cell_volume(key.level());
        EXPECT_EQ(volume, cell_volume(0));
        EXPECT_EQ(balance(balanced, contact), balanced) << "balancing again changes nothing";
    }
}

TEST(Balance, LeavesABalancedTreeAlone) {
    EXPECT_EQ(balance(std::vector<CellKey>{CellKey::root()}), std::vector<CellKey>{CellKey::root()});
    std::vector<CellKey> uniform;
    std::mt19937 random(1);
    grow(random, uniform, CellKey::root(), 3, 10);
    EXPECT_EQ(uniform.size(), 512u);
    EXPECT_EQ(balance(uniform, Contact::corner), uniform);
}

TEST(Origins, AreTheLeavesThatContainTheRefinedOnes) {
    std::mt19937 random(5);
    const std::vector<CellKey> coarse = refined_at({random_point(random), random_point(random)}, 9);
    const std::vector<CellKey> fine = balance(coarse, Contact::corner);
    const std::vector<LeafIndex> origin = origins(fine, coarse);
    ASSERT_EQ(origin.size(), fine.size());
    for (std::size_t i = 0; i < fine.size(); ++i) ASSERT_TRUE(coarse[origin[i]].contains(fine[i]));
}

}  // namespace
}  // namespace octavo::octree
