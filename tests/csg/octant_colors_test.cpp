// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <octavo/csg/octant_colors.hpp>

namespace octavo::csg {
namespace {

using octree::Color;

constexpr Color colors[] = {Color::white, Color::black, Color::gray};

OctantColors filled(int octant, Color color) {
    OctantColors result;
    result.set(octant, color);
    return result;
}

// Table 3.1 of the source, row by row: both relations, difference, intersection, union, complement of the first.
struct Row {
    Color first, second, difference, intersection, union_of, complement;
};
constexpr Color B = Color::white, G = Color::gray, N = Color::black;  // blanco, gris, negro
constexpr Row table[] = {{B, B, B, B, B, N}, {B, G, B, B, G, N}, {B, N, B, B, N, N},
                         {G, B, G, B, G, G}, {G, G, G, G, G, G}, {G, N, B, G, N, G},
                         {N, B, N, B, N, B}, {N, G, G, G, N, B}, {N, N, B, N, N, B}};

TEST(OctantColors, FollowTheNineRowsOfTheSourceInEveryOctant) {
    for (const Row& row : table)
        for (int octant = 0; octant < 8; ++octant) {
            const OctantColors a = filled(octant, row.first), b = filled(octant, row.second);
            EXPECT_EQ(intersect(a, complement(b))[octant], row.difference);
            EXPECT_EQ(intersect(a, b)[octant], row.intersection);
            EXPECT_EQ(unite(a, b)[octant], row.union_of);
            EXPECT_EQ(complement(a)[octant], row.complement);
        }
}

TEST(OctantColors, AgreeWithTheColourAlgebraInAllOctantsAtOnce) {
    // Every combination of colours in two octants that are not neighbours in the word.
    for (const Color a0 : colors)
        for (const Color a5 : colors)
            for (const Color b0 : colors)
                for (const Color b5 : colors) {
                    OctantColors a = filled(0, a0), b = filled(0, b0);
                    a.set(5, a5);
                    b.set(5, b5);
                    EXPECT_EQ(unite(a, b)[0], octree::unite(a0, b0));
                    EXPECT_EQ(unite(a, b)[5], octree::unite(a5, b5));
                    EXPECT_EQ(intersect(a, b)[0], octree::intersect(a0, b0));
                    EXPECT_EQ(intersect(a, b)[5], octree::intersect(a5, b5));
                    EXPECT_EQ(symmetric_difference(a, b)[0], octree::symmetric_difference(a0, b0));
                    EXPECT_EQ(symmetric_difference(a, b)[5], octree::symmetric_difference(a5, b5));
                    EXPECT_EQ(complement(a)[3], Color::gray);
                }
}

}  // namespace
}  // namespace octavo::csg
