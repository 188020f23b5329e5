// SPDX-License-Identifier: Apache-2.0
#include <random>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include <octavo/bsp_octree/line_key.hpp>
#include <octavo/exact/intersect.hpp>
#include <octavo/exact/lattice.hpp>

namespace octavo::bsp_octree {
namespace {

class LineKey : public testing::TestWithParam<int> {};

TEST_P(LineKey, IsThatOfTheLineWhicheverPlanesCutItOut) {
    std::mt19937 random(7);
    std::uniform_int_distribution<std::int32_t> anywhere(0, exact::universe_side - 1), near(0, 3);
    std::set<std::uint64_t> all;
    for (int i = 0; i < 2000; ++i) {
        const auto point = [&] {
            auto& from = i % 2 == 0 ? anywhere : near;
            return exact::Point{from(random), from(random), from(random)};
        };
        const exact::Point p = point(), q = point();
        std::vector<exact::Plane> planes;
        for (int k = 0; k < 40; ++k) {
            const exact::Plane plane = exact::Plane::through(p, q, point());
            if (!plane.degenerate()) planes.push_back(plane);
        }
        std::vector<PlanePair> pairs;
        for (std::size_t k = 1; k < planes.size(); ++k)
            for (std::size_t other = 0; other < k && other < 3; ++other) {
                const PlanePair pair{planes[k], planes[other]}, swapped{planes[other], planes[k]};
                if (exact::Line(pair.first, pair.second).degenerate()) continue;
                pairs.push_back(pair), pairs.push_back(swapped);
            }
        if (pairs.empty()) continue;
        const std::vector<std::uint64_t> keys = line_keys(pairs, GetParam());
        for (const std::uint64_t key : keys) EXPECT_EQ(key, keys[0]) << i;
        if (i % 2 == 0) {
            EXPECT_TRUE(all.insert(keys[0]).second) << "another line has this key";
        }
    }
    EXPECT_GT(all.size(), 900U);
}

INSTANTIATE_TEST_SUITE_P(BothPrimes, LineKey, testing::Values(0, 1));

}  // namespace
}  // namespace octavo::bsp_octree
