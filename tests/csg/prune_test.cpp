// SPDX-License-Identifier: Apache-2.0
#include <string>

#include <gtest/gtest.h>

#include <octavo/csg/second_look.hpp>

#include "random_solids.hpp"

namespace octavo::csg {
namespace {

using octree::Color;

constexpr Box3 universe{{-5, -5, -5}, {5, 5, 5}};

Program compile_or_die(const Expr& expression) {
    CompileOptions options;
    options.universe = universe;
    Result<Program> program = compile(expression, options);
    EXPECT_TRUE(program);
    return std::move(*program);
}

/// A primitive of this colour in octant 0 of the universe.
Expr primitive(Color color) {
    switch (color) {
        case Color::white:
            return Expr(Cuboid{{3, 3, 3}, {4, 4, 4}});
        case Color::black:
            return Expr(Cuboid{{-50, -50, -50}, {2, 2, 2}});
        default:
            return Expr(Cuboid{{-3, -3, -3}, {-2, -2, -2}});
    }
}

/// What is left of the words last evaluated in an octant.
std::vector<std::uint32_t> left_in(Pruner& pruner, const std::vector<std::uint32_t>& words, int octant) {
    Scratch<std::uint32_t> left;
    pruner.prune(words, 1U << octant, left);
    return {left.data(), left.data() + left.size()};
}

Color color_of(const Expr& expression) {
    const Program program = compile_or_die(expression);
    if (program.words.empty()) return program.constant ? Color::black : Color::white;
    Pruner pruner;
    return pruner.evaluate(program, program.words, octree::Cell::root()).octants[0];
}

// The example of figure 3.3 and table 3.2 of the source: (((((A-B)+(C+D))*(~E)*(F+G)))+H)*I.
TEST(Prune, TheWorkedExampleOfTheSource) {
    const Expr a = primitive(Color::black), b = primitive(Color::white), c = primitive(Color::gray),
               d = primitive(Color::white), e = primitive(Color::white), f = primitive(Color::black),
               g = primitive(Color::black), h = primitive(Color::white), i = primitive(Color::white);
    const Expr node1 = subtract({a, b}), node2 = unite({c, d}), node3 = unite({node1, node2}),
               node4 = complement(e), node5 = unite({f, g}), node6 = intersect({node4, node5}),
               node7 = intersect({node3, node6}), node8 = unite({node7, h}), node9 = intersect({node8, i});
    EXPECT_EQ(color_of(node1), Color::black);
    EXPECT_EQ(color_of(node2), Color::gray);
    EXPECT_EQ(color_of(node3), Color::black);
    EXPECT_EQ(color_of(node4), Color::black);
    EXPECT_EQ(color_of(node5), Color::black);
    EXPECT_EQ(color_of(node6), Color::black);
    EXPECT_EQ(color_of(node7), Color::black);
    EXPECT_EQ(color_of(node8), Color::black);
    EXPECT_EQ(color_of(node9), Color::white);
}

TEST(Prune, AnOperandThatDecidesEndsTheOperation) {
    // Black in the whole universe, followed by a thousand that are never looked at.
    std::vector<Expr> operands{Expr(Cuboid{{-50, -50, -50}, {50, 50, 50}})};
    for (int i = 0; i < 1000; ++i) operands.push_back(primitive(Color::gray));
    const Program program = compile_or_die(unite(operands));
    Pruner pruner;
    EXPECT_EQ(pruner.evaluate(program, program.words, octree::Cell::root()).octants,
              OctantColors::all_black());
    EXPECT_EQ(pruner.primitive_tests(), 8U);
}

TEST(Prune, OnlyWhatIsUndecidedIsHandedDown) {
    std::vector<Expr> operands{primitive(Color::gray)};
    for (int i = 0; i < 100; ++i) operands.push_back(primitive(Color::white));
    const Program program = compile_or_die(unite(operands));
    Pruner pruner;
    EXPECT_EQ(pruner.evaluate(program, program.words, octree::Cell::root()).octants[0], Color::gray);
    Scratch<std::uint32_t> words;
    pruner.prune(program.words, 1, words);
    // The union is left with one operand: a word that is stepped over, and the leaf.
    ASSERT_EQ(words.size(), 2U);
    EXPECT_EQ(word::operation(words[0]), word::skip);
    EXPECT_TRUE(word::is_leaf(words[1]));
}

/// Colours of the octants of a cell by evaluating the whole program there, without pruning on the way.
TEST(Prune, PrunedProgramsColourEveryOctantLikeTheWholeOne) {
    tests::RandomSolids random(31);
    for (int round = 0; round < 200; ++round) {
        // Leaves without payload: their colours do not depend on the way down.
        std::vector<Expr> leaves;
        for (int i = 2 + random.below(8); i > 0; --i) {
            // Drawn one after the other: compilers differ in the order of arguments.
            const Affine map = random.map();
            const bool is_ball = random.below(2) != 0;
            leaves.push_back(transform(
                map, is_ball ? Expr(Ball{random.uniform(0.3, 2)}) : Expr(Cuboid{{-1, -1, -1}, {1, 1, 1}})));
        }
        Expr expression = leaves[0];
        for (std::size_t i = 1; i < leaves.size(); ++i) {
            const int pick = random.below(5);
            expression = pick == 0   ? unite({expression, leaves[i]})
                         : pick == 1 ? subtract({expression, leaves[i]})
                         : pick == 2 ? symmetric_difference({leaves[i], complement(expression)})
                         : pick == 3 ? complement(intersect({expression, leaves[i]}))
                                     : unite({leaves[i], subtract({leaves[i - 1], expression})});
        }
        const Program program = compile_or_die(expression);
        if (program.words.empty()) continue;
        Pruner whole, pruned;
        std::vector<std::uint32_t> words = program.words;
        octree::Cell cell = octree::Cell::root();
        for (int level = 0; level < 6; ++level) {
            const OctantColors expected = whole.evaluate(program, program.words, cell).octants;
            const OctantColors actual = pruned.evaluate(program, words, cell).octants;
            // Convex bodies of several constraints may be seen more sharply on the way down.
            for (int octant = 0; octant < 8; ++octant) {
                if (is_decided(expected[octant])) {
                    EXPECT_EQ(actual[octant], expected[octant]);
                }
            }
            int octant = random.below(8);
            for (int i = 0; i < 8 && is_decided(actual[octant]); ++i) octant = (octant + 1) % 8;
            if (is_decided(actual[octant])) break;
            words = left_in(pruned, words, octant);
            cell = cell.child(octant);
        }
    }
}

// --- Single primitives: never wrong, and tight ------------------------------------------------------------------

/// How far outside the solid a point is, in the primitive's own frame, negative inside; convex in the point.
double excess(const Primitive& primitive, Vec3 p) {
    if (const auto* box = std::get_if<Cuboid>(&primitive)) {
        double most = -1e300;
        for (int a = 0; a < 3; ++a) most = std::max({most, box->low[a] - p[a], p[a] - box->high[a]});
        return most;
    }
    if (const auto* ball = std::get_if<Ball>(&primitive)) return length(p) - ball->radius;
    if (const auto* half = std::get_if<HalfSpace>(&primitive))
        return (dot(half->normal, p) - half->offset) / length(half->normal);
    const auto& f = std::get<Frustum>(primitive);
    const double t = (p.z - f.low) / (f.high - f.low);
    return std::max({f.low - p.z, p.z - f.high, std::hypot(p.x, p.y) - (f.bottom + t * (f.top - f.bottom))});
}

Vec3 solve(const Affine& map, Vec3 p) {
    const auto& m = map.m;
    const double det = map.determinant();
    const Vec3 d{p.x - m[0][3], p.y - m[1][3], p.z - m[2][3]};
    Vec3 local;
    for (std::size_t r = 0; r < 3; ++r) {
        double sum = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            const std::size_t r1 = (c + 1) % 3, r2 = (c + 2) % 3, c1 = (r + 1) % 3, c2 = (r + 2) % 3;
            sum += (m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1]) * d[static_cast<int>(c)];
        }
        local[static_cast<int>(r)] = sum / det;
    }
    return local;
}

/// The least excess in a world box by the ellipsoid method (N. Shor; D. Yudin and A. Nemirovski, 1976), which closes
/// in on the minimum of any convex function: an ellipsoid that holds it is halved through its middle again and again.
double least_excess(const Primitive& primitive, const Affine& map, Vec3 low, double side) {
    const auto value = [&](Vec3 p) { return excess(primitive, solve(map, p)); };
    Vec3 x = low + 0.5 * Vec3{side, side, side};
    double p[3][3] = {{side * side, 0, 0}, {0, side * side, 0}, {0, 0, side * side}};
    double least = value(x);
    for (int round = 0; round < 500; ++round) {
        Vec3 g;
        for (int a = 0; a < 3; ++a) g[a] = x[a] < low[a] ? -1 : x[a] > low[a] + side ? 1 : 0;
        if (g == Vec3{}) {
            least = std::min(least, value(x));
            const double h = 1e-7 * side;
            for (int a = 0; a < 3; ++a) {
                Vec3 more = x, less = x;
                more[a] += h, less[a] -= h;
                g[a] = (value(more) - value(less)) / (2 * h);
            }
        }
        Vec3 pg;
        for (int r = 0; r < 3; ++r) pg[r] = p[r][0] * g.x + p[r][1] * g.y + p[r][2] * g.z;
        const double norm = std::sqrt(dot(g, pg));
        if (!(norm > 0)) break;
        pg = (1 / norm) * pg;
        x = x - 0.25 * pg;
        for (int r = 0; r < 3; ++r)
            for (int c = 0; c < 3; ++c) p[r][c] = 9.0 / 8 * (p[r][c] - 0.5 * pg[r] * pg[c]);
    }
    return least;
}

TEST(Classify, ConvexPrimitivesAreNeverWrongAndTight) {
    tests::RandomSolids random(41);
    int grays = 0, decided = 0;
    for (int round = 0; round < 240; ++round) {
        Primitive primitive;
        switch (round % 4) {
            case 0:
                primitive = Cuboid{{-1, -0.7, -0.5}, {1, 0.8, random.uniform(-0.4, 1)}};
                break;
            case 1:
                primitive = Ball{random.uniform(0.2, 1.5)};
                break;
            case 2:
                primitive =
                    Frustum{-1, random.uniform(-0.5, 1), random.uniform(0.2, 1), random.uniform(0, 1)};
                break;
            default:
                primitive = HalfSpace{{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)},
                                      random.uniform(-1, 1)};
        }
        const Affine map = random.map();
        const Program program = compile_or_die(transform(map, Expr(primitive)));
        if (program.words.empty()) continue;
        const double unit = program.lattice.unit();
        // Two lattice units in the primitive's frame.
        double stretch = 0;
        for (int a = 0; a < 3; ++a) {
            Vec3 e{map.m[0][3], map.m[1][3], map.m[2][3]};
            e[a] += 1;
            stretch += length(solve(map, e));
        }
        const double margin = 2 * unit * stretch;
        Pruner pruner;
        SecondLook second_look;
        std::vector<std::uint32_t> words = program.words;
        octree::Cell cell = octree::Cell::root();
        for (int level = 0; level < 9; ++level) {
            const OctantColors quick = pruner.evaluate(program, words, cell).octants;
            OctantColors colors = quick;
            for (int octant = 0; octant < 8; ++octant)
                if (quick[octant] == Color::gray)
                    colors.set(octant, second_look.color(program, left_in(pruner, words, octant),
                                                         cell.child(octant)));
            int gray = -1;
            for (int k = 0; k < 8; ++k) {
                const int octant = (k + round) % 8;
                const octree::Cell child = cell.child(octant);
                const Vec3 low = program.lattice.to_world(child.low);
                const double side = unit * child.side();
                double most_at_corners = -1e300;
                for (int corner = 0; corner < 8; ++corner)
                    most_at_corners = std::max(
                        most_at_corners,
                        excess(primitive, solve(map, low + Vec3{corner & 1 ? side : 0, corner & 2 ? side : 0,
                                                                corner & 4 ? side : 0})));
                const double least = least_excess(primitive, map, low, side);
                if (colors[octant] == Color::black) {
                    ++decided;
                    EXPECT_LE(most_at_corners, margin) << "black, but a corner is outside";
                } else if (colors[octant] == Color::white) {
                    ++decided;
                    EXPECT_GE(least, -margin) << "white, but it reaches inside";
                } else {
                    ++grays;
                    gray = octant;
                    EXPECT_GE(most_at_corners, -margin) << "gray, but all inside";
                    EXPECT_LE(least, margin + 1e-5 * side * stretch)
                        << "gray, but all outside, round " << round;
                }
            }
            if (gray < 0) break;
            words = left_in(pruner, words, gray);
            cell = cell.child(gray);
        }
    }
    EXPECT_GT(grays, 2000);
    EXPECT_GT(decided, 2000);
}

}  // namespace
}  // namespace octavo::csg
