// SPDX-License-Identifier: Apache-2.0
#include <vector>

#include <gtest/gtest.h>

#include <octavo/octree/color.hpp>

namespace octavo::octree {
namespace {

constexpr Color B = Color::white, N = Color::black, G = Color::gray;  // blanco, negro, gris

struct Row {
    Color a, b, difference, intersection, union_, complement;
};

// Table 3.1 of the source, row by row.
constexpr Row table[] = {
    {B, B, B, B, B, N}, {B, G, B, B, G, N}, {B, N, B, B, N, N}, {G, B, G, B, G, G}, {G, G, G, G, G, G},
    {G, N, B, G, N, G}, {N, B, N, B, N, B}, {N, G, G, G, N, B}, {N, N, B, N, N, B},
};

TEST(ColorAlgebra, AgreesWithTheNineRowsOfTheSource) {
    for (const Row& row : table) {
        EXPECT_EQ(subtract(row.a, row.b), row.difference) << name(row.a) << " " << name(row.b);
        EXPECT_EQ(intersect(row.a, row.b), row.intersection) << name(row.a) << " " << name(row.b);
        EXPECT_EQ(unite(row.a, row.b), row.union_) << name(row.a) << " " << name(row.b);
        EXPECT_EQ(complement(row.a), row.complement) << name(row.a);
    }
}

TEST(ColorAlgebra, IsTheStrongestAnswerThatIsRightForEveryPairOfSolids) {
    // A cell's possible contents, as membership at two sample points: gray may be anything.
    const auto contents = [](Color color) -> std::vector<int> {
        if (color == B) return {0};
        if (color == N) return {3};
        return {0, 1, 2, 3};
    };
    const auto strongest = [&](Color a, Color b, auto operation) {
        bool all_white = true, all_black = true;
        for (const int x : contents(a))
            for (const int y : contents(b)) {
                const int result = operation(x, y) & 3;
                all_white = all_white && result == 0;
                all_black = all_black && result == 3;
            }
        return all_white ? B : all_black ? N : G;
    };
    for (const Color a : {B, N, G})
        for (const Color b : {B, N, G}) {
            EXPECT_EQ(unite(a, b), strongest(a, b, [](int x, int y) { return x | y; }));
            EXPECT_EQ(intersect(a, b), strongest(a, b, [](int x, int y) { return x & y; }));
            EXPECT_EQ(subtract(a, b), strongest(a, b, [](int x, int y) { return x & ~y; }));
            EXPECT_EQ(symmetric_difference(a, b), strongest(a, b, [](int x, int y) { return x ^ y; }));
        }
}

static_assert(unite(B, N) == N && intersect(G, B) == B, "the algebra works at compile time");

}  // namespace
}  // namespace octavo::octree
