// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <octavo/octree/linear_octree.hpp>

namespace octavo::octree {
namespace {

void grow(std::mt19937& random, DfCode& code, int depth, unsigned split_of_ten) {
    const bool split = depth > 0 && random() % 10 < split_of_ten;
    code.append(split ? Node::split : static_cast<Node>(random() % 3));
    for (int i = 0; split && i < 8; ++i) grow(random, code, depth - 1, split_of_ten);
}

Octree random_octree(unsigned seed, int depth, unsigned split_of_ten) {
    std::mt19937 random(seed);
    DfCode code;
    code.append(Node::split);
    for (int i = 0; i < 8; ++i) grow(random, code, depth - 1, split_of_ten);
    return {exact::Lattice{}, depth, code};
}

exact::Point random_point(std::mt19937& random) {
    std::uniform_int_distribution<std::int32_t> place(0, exact::universe_side - 1);
    // Half of the points lie on cell walls.
    const std::int32_t mask = random() % 2 ? -1 : -cell_side(5);
    return {place(random) & mask, place(random) & mask, place(random) & mask};
}

TEST(LinearOctree, KeepsTheTreeThereAndBack) {
    for (unsigned seed = 0; seed < 20; ++seed) {
        const Octree octree = random_octree(seed, 5, 1 + seed % 9);
        const Result<LinearOctree> linear = LinearOctree::from(octree);
        ASSERT_TRUE(linear);
        EXPECT_EQ(linear->to_octree(), octree);
        EXPECT_EQ(linear->size(), octree.stats().leaves());
        EXPECT_TRUE(std::is_sorted(linear->keys().begin(), linear->keys().end()));
    }
    EXPECT_EQ(LinearOctree::from(Octree{})->to_octree(), Octree{});
}

TEST(LinearOctree, LocatesPointsAsASearchOfAllLeavesDoes) {
    std::mt19937 random(1);
    for (unsigned seed = 0; seed < 10; ++seed) {
        const LinearOctree linear = *LinearOctree::from(random_octree(seed, 5, 1 + seed % 9));
        std::vector<exact::Point> points;
        for (int i = 0; i < 300; ++i) points.push_back(random_point(random));
        const std::vector<LeafIndex> batch = linear.locate(points);
        for (std::size_t i = 0; i < points.size(); ++i) {
            std::vector<LeafIndex> containing;
            for (LeafIndex leaf = 0; leaf < linear.size(); ++leaf)
                if (Cell::of(linear.key(leaf)).contains(points[i])) containing.push_back(leaf);
            ASSERT_EQ(containing.size(), 1u);
            ASSERT_EQ(batch[i], containing[0]);
            ASSERT_EQ(linear.locate(points[i]), containing[0]);
        }
    }
}

TEST(LinearOctree, FindsNeighboursAsAnOverlapTestOfAllLeavesDoes) {
    for (unsigned seed = 0; seed < 6; ++seed) {
        const LinearOctree linear = *LinearOctree::from(random_octree(seed, 3, 5));
        for (LeafIndex leaf = 0; leaf < linear.size(); ++leaf)
            for (int direction = 0; direction < 27; ++direction) {
                const int dx = direction % 3 - 1, dy = direction / 3 % 3 - 1, dz = direction / 9 - 1;
                const Cell cell = Cell::of(linear.key(leaf));
                std::vector<LeafIndex> overlapping;
                for (LeafIndex other = 0; other < linear.size(); ++other) {
                    const Cell candidate = Cell::of(linear.key(other));
                    const int steps[3] = {dx, dy, dz};
                    bool overlaps = true;
                    for (int axis = 0; axis < 3; ++axis) {
                        const std::int64_t low = cell.low[axis] + std::int64_t{steps[axis]} * cell.side();
                        overlaps = overlaps && candidate.low[axis] < low + cell.side() &&
                                   low < std::int64_t{candidate.low[axis]} + candidate.side();
                    }
                    if (overlaps) overlapping.push_back(other);
                }
                const LeafRange found = linear.neighbours(leaf, dx, dy, dz);
                ASSERT_EQ(found.end - found.begin, overlapping.size());
                if (!overlapping.empty()) {
                    ASSERT_EQ(found.begin, overlapping.front());
                    ASSERT_EQ(found.end, overlapping.back() + 1);
                }
            }
    }
}

}  // namespace
}  // namespace octavo::octree
