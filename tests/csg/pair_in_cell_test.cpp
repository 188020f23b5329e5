// SPDX-License-Identifier: Apache-2.0
#include <optional>

#include <gtest/gtest.h>

#include <octavo/csg/local_arrangement.hpp>
#include <octavo/csg/pair_in_cell.hpp>

#include "effort.hpp"
#include "random_solids.hpp"

namespace octavo::csg {
namespace {

using octree::Color;

/// As second_look.cpp goes on where color_of_pair says nothing.
Color by_the_long_way(const Program& program, std::span<const std::uint32_t> words,
                      const octree::Cell& cell) {
    Pruner below;
    const Seen seen = below.evaluate(program, words, cell);
    const bool black = seen.octants.black != 0 || seen.points.inside != 0;
    const bool white = seen.octants.white != 0 || seen.points.outside != 0;
    if (black && white) return Color::gray;
    if (seen.octants.gray() == 0) return black ? Color::black : Color::white;
    return LocalArrangement().resolve(program, words, cell, below);
}

TEST(PairInCell, GivesTheColoursOfTheLongWay) {
    tests::RandomSolids random(41);
    Pruner pruner;
    int answered = 0, decided = 0;
    for (int round = 0; round < 40000 * octavo::tests::effort(); ++round) {
        const auto body = [&] {
            const Affine map = random.map();
            const int kind = random.below(3);
            return transform(map, kind == 0   ? Expr(Ball{random.uniform(0.3, 2)})
                                  : kind == 1 ? Expr(Cuboid{{-1, -1, -1}, {1, 1, 1}})
                                              : Expr(Frustum{-1, 1, random.uniform(0, 1), 1}));
        };
        const Expr a = body(), b = random.below(8) == 0 ? a : body();
        const int pick = random.below(6);
        const Expr expression = pick < 2    ? unite({a, b})
                                : pick == 2 ? intersect({a, b})
                                : pick == 3 ? subtract({a, b})
                                : pick == 4 ? complement(unite({a, b}))
                                            : symmetric_difference({a, b});
        CompileOptions options;
        options.universe = Box3{{-5, -5, -5}, {5, 5, 5}};
        const Result<Program> program = compile(expression, options);
        ASSERT_TRUE(program);
        if (program->words.empty()) continue;
        std::vector<std::uint32_t> words = program->words;
        octree::Cell cell = octree::Cell::root();
        while (cell.level < 9) {
            const OctantColors colors = pruner.evaluate(*program, words, cell).octants;
            if (colors.gray() == 0) break;
            int octant = random.below(8);
            while (is_decided(colors[octant])) octant = (octant + 1) % 8;
            Scratch<std::uint32_t> left;
            pruner.prune(words, 1U << octant, left);
            words.assign(left.data(), left.data() + left.size());
            cell = cell.child(octant);
            const std::optional<Color> color = color_of_pair(*program, words, cell);
            if (!color) continue;
            ASSERT_EQ(*color, by_the_long_way(*program, words, cell)) << "round " << round;
            ++answered;
            decided += is_decided(*color);
        }
    }
    EXPECT_GT(answered, 1000);
    EXPECT_GT(decided, 5);
}

}  // namespace
}  // namespace octavo::csg
