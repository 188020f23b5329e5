// SPDX-License-Identifier: Apache-2.0
#include <random>
#include <vector>

#include <classic/rational.hpp>
#include <classic/solids.hpp>
#include <gtest/gtest.h>

#include <octavo/classic/crossing.hpp>

#include "effort.hpp"

namespace octavo::classic {
namespace {

// The displaced point for real: ε₁ = 2^-60, ε₂ = 2^-120, ε₃ = 2^-180 are small enough, because coefficients are
// integers of less than 56 bits.
const tests::Integer scale = tests::Integer(1) << 180;
tests::IntegerPoint displaced(const std::array<std::int32_t, 3>& p) {
    return {p[0] * scale + (tests::Integer(1) << 120), p[1] * scale + (tests::Integer(1) << 60),
            p[2] * scale + 1};
}

TEST(Crossing, SumsToTheDifferenceOfRationalWindingNumbersOnDegenerateSurfaces) {
    int differences = 0;
    for (unsigned seed = 0; seed < 400u * static_cast<unsigned>(tests::effort()); ++seed) {
        tests::GridPoints points(seed, 4);
        const mesh::LatticeMesh bag = tests::random_bag(points);
        const tests::ScaledSurface surface(bag, scale);
        const std::vector<Facet> facets = *facets_of(bag);
        for (int step = 0; step < 6; ++step) {
            const exact::Point from = points();
            const std::array<std::int32_t, 3> start{from.x, from.y, from.z};
            const int axis = step % 3;
            std::array<std::int32_t, 3> end = start;
            end[static_cast<std::size_t>(axis)] = points.one();
            const std::int32_t length =
                end[static_cast<std::size_t>(axis)] - start[static_cast<std::size_t>(axis)];
            int change = 0;
            for (const Facet& facet : facets) change += crossing(facet, start, axis, length);
            const tests::Place before = tests::place_of(surface, displaced(start)),
                               after = tests::place_of(surface, displaced(end));
            ASSERT_FALSE(before.on_facet || after.on_facet);
            ASSERT_EQ(change, after.winding - before.winding) << seed;
            differences += change != 0;
        }
    }
    EXPECT_GT(differences, 100);
}

}  // namespace
}  // namespace octavo::classic
