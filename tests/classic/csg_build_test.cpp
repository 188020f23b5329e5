// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <octavo/classic/csg_build.hpp>
#include <octavo/classic/csg_by_primitive.hpp>
#include <octavo/classic/csg_descent.hpp>
#include <octavo/octree/linear_octree.hpp>

#include "csg/random_solids.hpp"
#include "effort.hpp"

namespace octavo::classic {
namespace {

using csg::Expr;
using csg::tests::RandomSolids;
using csg::tests::Side;
using octree::Color;

CsgOctree build_or_die(const Expr& expression, const CsgBuildOptions& options, int threads = 1) {
    Context context;
    context.threads = threads;
    Result<CsgOctree> built = build(expression, options, context);
    EXPECT_TRUE(built) << built.error().describe();
    return std::move(*built);
}

CsgBuildOptions depth_of(int depth, CsgMethod method = CsgMethod::top_down) {
    CsgBuildOptions options;
    options.depth = depth;
    options.method = method;
    options.universe = Box3{{-5, -5, -5}, {5, 5, 5}};
    return options;
}

double volume(const octree::Octree& tree, bool with_gray) {
    const octree::OctreeStats stats = tree.stats();
    return octree::world_volume(tree.lattice(), stats.black_volume + (with_gray ? stats.gray_volume : 0));
}

/// Points of a grid in each leaf, its corners a little inside, against the textbook definition.
void expect_right_colors(const Expr& expression, const octree::Octree& tree, int points,
                         RandomSolids& random) {
    // A snapped plane moves by half a unit at most; maps of RandomSolids stretch less than the oracle assumes.
    const double margin = 2 * tree.lattice().unit();
    std::uint64_t wrong = 0, checked = 0;
    tree.for_each_leaf([&](octree::CellKey key, Color color) {
        if (!is_decided(color)) return;
        const Vec3 low = tree.lattice().to_world(key.low());
        const double side = tree.lattice().unit() * key.side();
        const int count = side > 0.5 ? 8 * points : points;
        for (int i = 0; i < count; ++i) {
            const Vec3 p =
                low + Vec3{random.uniform(0, side), random.uniform(0, side), random.uniform(0, side)};
            const Side expected = csg::tests::side(expression, p, margin);
            if (expected == Side::unsure) continue;
            ++checked;
            wrong += (expected == Side::inside) != (color == Color::black);
        }
    });
    EXPECT_EQ(wrong, 0U) << "of " << checked;
}

TEST(CsgBuild, ColoursAreRightForRandomExpressions) {
    RandomSolids random(1);
    for (int round = 0; round < 60 * tests::effort(); ++round) {
        const Expr expression = random.tree(1 + random.below(7));
        expect_right_colors(expression, build_or_die(expression, depth_of(5)).octree, 2, random);
    }
}

TEST(CsgBuild, BothMethodsGiveTheSameTree) {
    RandomSolids random(2);
    for (int round = 0; round < 80 * tests::effort(); ++round) {
        const Expr expression = random.tree(1 + random.below(10));
        const CsgOctree top_down = build_or_die(expression, depth_of(5));
        const CsgOctree classic = build_or_die(expression, depth_of(5, CsgMethod::classic));
        EXPECT_EQ(top_down.octree, classic.octree);
        EXPECT_TRUE(top_down.octree.validate());
        EXPECT_LE(top_down.stats.peak_nodes, classic.stats.peak_nodes);
    }
}

TEST(CsgBuild, PruningIsThreeValuedLogicOnTheOctreesOfThePrimitives) {
    RandomSolids random(3);
    for (int round = 0; round < 60 * tests::effort(); ++round) {
        csg::CompileOptions compile_options;
        compile_options.universe = Box3{{-5, -5, -5}, {5, 5, 5}};
        const Result<csg::Program> program = csg::compile(random.tree(1 + random.below(12)), compile_options);
        ASSERT_TRUE(program);
        if (program->words.empty()) continue;
        const Result<PrimitivewiseOctree> combined = build_by_primitive(*program, {.depth = 5}, {});
        CsgDescent::Counters counters;
        const CsgDescent problem(*program, program->words, {5, CsgDescentOptions::LastLevel::keep_gray},
                                 counters);
        Result<CsgDescent::Output> pruned = octree::descend(problem);
        ASSERT_TRUE(pruned);
        EXPECT_EQ(pruned->take_code(), combined->code);
    }
}

// Their leaves are sorted into cells, and bricks look at bounding boxes first.
TEST(CsgBuild, ThousandsOfSmallPrimitivesGiveTheSameTree) {
    RandomSolids random(4);
    const auto small = [&](double size) {
        Affine map = random.map();
        for (auto& row : map.m) {
            for (std::size_t c = 0; c < 3; ++c) row[c] *= size;
            row[3] = random.uniform(-4.9, 4.9);
        }
        const int kind = random.below(4);
        return csg::transform(map, kind == 0   ? Expr(csg::Ball{1})
                                   : kind == 1 ? Expr(csg::Cuboid{{-1, -1, -1}, {1, 1, 1}})
                                   : kind == 2 ? Expr(csg::Torus{1, 0.3})
                                               : Expr(csg::Frustum{-1, 1, 0.2, 1}));
    };
    for (int round = 0; round < 6; ++round) {
        std::vector<Expr> operands;
        for (int i = 0; i < 2400; ++i) {
            const Expr a = small(0.1), b = small(0.3);
            const int pick = random.below(5);
            operands.push_back(pick == 0   ? csg::subtract({a, b})
                               : pick == 1 ? csg::intersect({csg::unite({a, small(0.1)}), b})
                               : pick == 2 ? csg::subtract({b, csg::intersect({a, csg::unite({a, b})})})
                                           : a);
        }
        const Expr all = csg::unite(operands), plate(csg::Cuboid{{-4, -4, -0.5}, {4, 4, 0.5}});
        const Expr expression = round % 3 == 0   ? all
                                : round % 3 == 1 ? csg::subtract({plate, all})
                                                 : csg::complement(all);
        csg::CompileOptions compile_options;
        compile_options.universe = Box3{{-5, -5, -5}, {5, 5, 5}};
        compile_options.primitives = csg::CompileOptions::Primitives::all;
        const Result<csg::Program> program = csg::compile(expression, compile_options);
        ASSERT_TRUE(program);
        const int depth = 5 + round / 3;
        EXPECT_TRUE(csg::LeavesInCells::sort(*program, program->words, depth - 2));
        const Result<PrimitivewiseOctree> combined = build_by_primitive(*program, {.depth = depth}, {});
        CsgDescent::Counters counters;
        const CsgDescent problem(*program, program->words, {depth, CsgDescentOptions::LastLevel::keep_gray},
                                 counters);
        Result<CsgDescent::Output> pruned = octree::descend(problem);
        ASSERT_TRUE(pruned);
        EXPECT_EQ(pruned->take_code(), combined->code);
        const CsgOctree top_down = build_or_die(expression, depth_of(depth));
        EXPECT_EQ(top_down.octree, build_or_die(expression, depth_of(depth, CsgMethod::classic)).octree);
        EXPECT_EQ(top_down.octree, build_or_die(expression, depth_of(depth), 4).octree);
    }
}

TEST(CsgBuild, AnOctreeWithMoreNodesThanAllowedIsRefusedByBothMethods) {
    const Expr ball(csg::Ball{1});
    for (const CsgMethod method : {CsgMethod::top_down, CsgMethod::classic}) {
        CsgBuildOptions options = depth_of(6);
        options.method = method;
        const Result<CsgOctree> built = build(ball, options);
        ASSERT_TRUE(built);
        options.max_nodes = built->stats.peak_nodes;
        EXPECT_TRUE(build(ball, options));
        options.max_nodes = built->octree.code().size() - 1;
        const Result<CsgOctree> refused = build(ball, options);
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().code, ErrorCode::limit);
        options.depth = 21;
        options.max_nodes = 100'000;
        EXPECT_FALSE(build(ball, options));
    }
}

TEST(CsgBuild, TheNumberOfThreadsChangesNothing) {
    RandomSolids random(4);
    std::vector<Expr> many;
    for (int i = 0; i < 3000; ++i) {
        const Affine place = random.map();
        many.push_back(csg::transform(place, random.placed()));
    }
    const Expr expression = csg::unite(many);
    const CsgOctree one = build_or_die(expression, depth_of(5), 1);
    for (const int threads : {2, 8}) {
        const CsgOctree more = build_or_die(expression, depth_of(5), threads);
        EXPECT_EQ(one.octree, more.octree);
        EXPECT_EQ(one.stats.primitive_tests, more.stats.primitive_tests);
        EXPECT_EQ(one.stats.peak_nodes, more.stats.peak_nodes);
    }
}

// --- Walls ------------------------------------------------------------------------------------------------------

Affine turned(double x, double y, double z, Vec3 shift) {
    const double cx = std::cos(x), sx = std::sin(x), cy = std::cos(y), sy = std::sin(y), cz = std::cos(z),
                 sz = std::sin(z);
    Affine m;
    m.m = {{{cy * cz, sx * sy * cz - cx * sz, cx * sy * cz + sx * sz, shift.x},
            {cy * sz, sx * sy * sz + cx * cz, cx * sy * sz - sx * cz, shift.y},
            {-sy, sx * cy, cx * cy, shift.z}}};
    return m;
}

/// The octree of the parts must be that of the whole: no trace of the cut.
void expect_no_wall(const Expr& parts, const Expr& whole, int depth = 6) {
    const CsgOctree a = build_or_die(parts, depth_of(depth)), b = build_or_die(whole, depth_of(depth));
    EXPECT_EQ(a.octree, b.octree) << a.octree.stats().gray << " gray cells instead of "
                                  << b.octree.stats().gray;
    EXPECT_EQ(build_or_die(parts, depth_of(depth, CsgMethod::classic)).octree, a.octree);
}

Expr box(Vec3 low, Vec3 high) { return Expr(csg::Cuboid{low, high}); }

TEST(CsgWalls, AbuttingBoxesLeaveNone) {
    expect_no_wall(csg::unite({box({-1, -1, -1}, {0.3, 1, 1}), box({0.3, -1, -1}, {1, 1, 1})}),
                   box({-1, -1, -1}, {1, 1, 1}));
    // Eight boxes about a corner.
    std::vector<Expr> eight;
    for (int i = 0; i < 8; ++i) {
        const Vec3 low{i & 1 ? 0.1 : -1, i & 2 ? 0.2 : -1, i & 4 ? 0.3 : -1};
        eight.push_back(box(low, {i & 1 ? 1 : 0.1, i & 2 ? 1 : 0.2, i & 4 ? 1 : 0.3}));
    }
    expect_no_wall(csg::unite(eight), box({-1, -1, -1}, {1, 1, 1}));
}

TEST(CsgWalls, TurnedBoxesLeaveNone) {
    RandomSolids random(5);
    for (int round = 0; round < 20; ++round) {
        // In braces, which fix the order of evaluation.
        const Vec3 angles{random.uniform(0, 6), random.uniform(0, 6), random.uniform(0, 6)},
            shift{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
        const Affine map = turned(angles.x, angles.y, angles.z, shift);
        const double cut = random.uniform(-0.8, 0.8);
        expect_no_wall(
            csg::transform(map, csg::unite({box({-1, -1, -1}, {cut, 1, 1}), box({cut, -1, -1}, {1, 1, 1})})),
            csg::transform(map, box({-1, -1, -1}, {1, 1, 1})));
    }
}

TEST(CsgWalls, BoxesThatOverlapByLessThanACellLeaveNone) {
    const Affine map = turned(0.4, 1.1, 0.3, {});
    expect_no_wall(
        csg::transform(map, csg::unite({box({-1, -1, -1}, {0.301, 1, 1}), box({0.299, -1, -1}, {1, 1, 1})})),
        csg::transform(map, box({-1, -1, -1}, {1, 1, 1})));
}

TEST(CsgWalls, AGapOfAFewUnitsStaysGray) {
    const Expr gap = csg::unite({box({-1, -1, -1}, {0.3, 1, 1}), box({0.3 + 1e-5, -1, -1}, {1, 1, 1})});
    const CsgOctree whole = build_or_die(box({-1, -1, -1}, {1, 1, 1}), depth_of(6));
    EXPECT_GT(build_or_die(gap, depth_of(6)).octree.stats().gray, whole.octree.stats().gray);
}

TEST(CsgWalls, WhatIsCutOutAndPutBackLeavesNone) {
    RandomSolids random(6);
    const Expr block = box({-2, -2, -2}, {2, 2, 2});
    for (int round = 0; round < 30; ++round) {
        const Expr plug = random.placed();
        expect_no_wall(csg::unite({csg::subtract({block, plug}), csg::intersect({plug, block})}), block, 5);
        expect_no_wall(csg::subtract({plug, plug}), csg::nothing(), 5);
        expect_no_wall(csg::symmetric_difference({plug, block, plug}), block, 5);
    }
}

TEST(CsgWalls, BodiesOfManyFacetsLeaveNoneWhereTheyAreTakenFromThemselves) {
    RandomSolids random(16);
    const Expr block = box({-2, -2, -2}, {2, 2, 2});
    for (int round = 0; round < 6; ++round) {
        std::vector<Vec3> points;
        for (int i = 0; i < 60; ++i) {
            Vec3 p{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
            points.push_back((1 / length(p)) * p);
        }
        const auto mesh = std::make_shared<mesh::Mesh>(*csg::convex_hull(points));
        const auto copy = std::make_shared<mesh::Mesh>(*mesh);  // equal, and not the same
        const Affine map = random.map();
        const Expr plug = csg::transform(map, Expr(csg::Polyhedron{mesh, csg::Convexity::convex})),
                   same = csg::transform(map, Expr(csg::Polyhedron{copy, csg::Convexity::convex}));
        expect_no_wall(csg::subtract({plug, same}), csg::nothing(), 5);
        expect_no_wall(csg::unite({csg::subtract({block, plug}), csg::intersect({same, block})}), block, 5);
        expect_no_wall(csg::symmetric_difference({plug, block, same}), block, 5);
    }
}

TEST(CsgWalls, StackedAndCoaxialCylindersLeaveNone) {
    const Affine map = turned(0.7, 0.2, 0.5, {0.1, 0.2, 0.3});
    const auto cylinder = [](double low, double high, double r) {
        return Expr(csg::Frustum{low, high, r, r});
    };
    expect_no_wall(csg::transform(map, csg::unite({cylinder(-1, 0.2, 1), cylinder(0.2, 1.5, 1)})),
                   csg::transform(map, cylinder(-1, 1.5, 1)));
    // A pin in its hole, and a cone cut in two.
    expect_no_wall(
        csg::transform(map, csg::unite({csg::subtract({cylinder(-1, 1, 1.5), cylinder(-2, 2, 0.7)}),
                                        cylinder(-1, 1, 0.7)})),
        csg::transform(map, cylinder(-1, 1, 1.5)));
    expect_no_wall(csg::transform(map, csg::unite({Expr(csg::Frustum{-1, 0, 2, 1.5}),
                                                   Expr(csg::Frustum{0, 1, 1.5, 1})})),
                   csg::transform(map, Expr(csg::Frustum{-1, 1, 2, 1})));
}

TEST(CsgWalls, MeshesWithACommonFaceLeaveNone) {
    // Wedges that meet in a slanted face; as meshes, not as convex bodies.
    const auto wedge = [](bool upper) {
        mesh::Mesh mesh;
        mesh.vertices = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                         {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
        // Cut through the edge x = 1, z = -1 and the edge x = -1, z = 1.
        mesh.triangles = upper ? std::vector<mesh::Triangle>{{4, 5, 6}, {4, 6, 7}, {1, 2, 6}, {1, 6, 5},
                                                             {1, 5, 4}, {2, 7, 6}, {1, 4, 7}, {1, 7, 2}}
                               : std::vector<mesh::Triangle>{{0, 3, 2}, {0, 2, 1}, {0, 4, 7}, {0, 7, 3},
                                                             {0, 1, 4}, {3, 7, 2}, {1, 7, 4}, {1, 2, 7}};
        return Expr(csg::Polyhedron{std::make_shared<mesh::Mesh>(mesh), csg::Convexity::any});
    };
    const Affine map = turned(0.3, 0.4, 0.5, {});
    for (const Affine& m : {Affine{}, map}) {
        const CsgOctree parts =
            build_or_die(csg::transform(m, csg::unite({wedge(true), wedge(false)})), depth_of(6));
        const CsgOctree whole = build_or_die(csg::transform(m, box({-1, -1, -1}, {1, 1, 1})), depth_of(6));
        // Vertices are snapped, so slanted outer faces may differ by a cell that they only just touch.
        EXPECT_NEAR(static_cast<double>(parts.octree.stats().gray),
                    static_cast<double>(whole.octree.stats().gray),
                    m == Affine{} ? 0.0 : 0.01 * static_cast<double>(whole.octree.stats().gray));
    }
}

// --- Measures and limits ----------------------------------------------------------------------------------------

TEST(CsgBuild, PrimitivesAreTheSameAtAnyScale) {
    const Affine turn{{{{0.36, 0.48, -0.8, 0.1}, {-0.8, 0.6, 0, 0.2}, {0.48, 0.64, 0.6, -0.3}}}};
    const auto scaled_turn = [&](double size) {
        Affine map = turn;
        for (auto& row : map.m) row[3] *= size;
        return map;
    };
    const auto scaled = [](std::size_t kind, double s) -> Expr {
        switch (kind) {
            case 0:
                return Expr(csg::Cuboid{{0, -s, 0.5 * s}, {s, s, 2 * s}});
            case 1:
                return Expr(csg::Ball{0.7 * s});
            case 2:
                return Expr(csg::Frustum{-s, s, 0.75 * s, 0.25 * s});
            case 3:
                return Expr(csg::Torus{0.75 * s, 0.2 * s});
            default:
                return csg::intersect(
                    {Expr(csg::Cuboid{{-s, -s, -s}, {s, s, s}}), Expr(csg::HalfSpace{{1, 2, 3}, 0.4 * s})});
        }
    };
    CsgBuildOptions options;
    options.depth = 5;
    for (std::size_t kind = 0; kind < 5; ++kind) {
        const CsgOctree plain = build_or_die(transform(turn, scaled(kind, 1)), options);
        for (const double size : {0x1p-960, 0x1p-560, 0x1p-500, 0x1p500, 0x1p560, 0x1p900}) {
            const CsgOctree tree = build_or_die(transform(scaled_turn(size), scaled(kind, size)), options);
            EXPECT_EQ(tree.octree.code(), plain.octree.code()) << kind << ' ' << size;
        }
    }
}

TEST(CsgBuild, VolumesEncloseTheTrueOneAndCloseIn) {
    const double pi = std::acos(-1.0);
    const struct {
        Expr solid;
        double volume;
    } cases[] = {{Expr(csg::Ball{2}), 32 * pi / 3},
                 {Expr(csg::Frustum{-1, 2, 1.5, 0.5}), pi * (2.25 + 0.75 + 0.25)},
                 {Expr(csg::Torus{2, 0.5}), 2 * pi * pi * 2 * 0.25},
                 {csg::transform(turned(0.3, 0.2, 0.1, {0.1, 0, 0}), box({-1, -1.2, -1.3}, {1, 1, 1})),
                  2 * 2.2 * 2.3}};
    for (const auto& [solid, expected] : cases) {
        double gap = 0;
        for (const int depth : {5, 6, 7, 8}) {
            const CsgOctree built = build_or_die(solid, depth_of(depth));
            const double lower = volume(built.octree, false), upper = volume(built.octree, true);
            EXPECT_LE(lower, expected);
            EXPECT_GE(upper, expected);
            if (gap > 0) {
                EXPECT_NEAR((upper - lower) / gap, 0.5, 0.06);
            }
            gap = upper - lower;
        }
    }
}

TEST(CsgBuild, PrecisionChoosesTheLeastDepthThatKeepsIt) {
    CsgBuildOptions options = depth_of(0);
    options.precision = 0.1;
    const CsgOctree built = build_or_die(Expr(csg::Ball{2}), options);
    const double side = built.octree.lattice().unit() * octree::cell_side(built.octree.depth());
    EXPECT_LE(side, 0.1);
    EXPECT_GT(2 * side, 0.1);
    options.precision = 1e-9;
    EXPECT_EQ(build(Expr(csg::Ball{2}), options).error().code, ErrorCode::limit);
    options.precision = -1;
    EXPECT_EQ(build(Expr(csg::Ball{2}), options).error().code, ErrorCode::bad_input);
}

TEST(CsgBuild, UnboundedSolidsNeedAUniverse) {
    const Expr slab = csg::subtract({Expr(csg::HalfSpace{{1, 2, 3}, 1}), Expr(csg::HalfSpace{{1, 2, 3}, 0})});
    EXPECT_EQ(build(slab).error().code, ErrorCode::limit);
    const CsgOctree built = build_or_die(slab, depth_of(7));
    EXPECT_GT(built.octree.stats().black, 0U);
    RandomSolids random(7);
    expect_right_colors(slab, built.octree, 1, random);
    const CsgOctree all = build_or_die(csg::everything(), depth_of(4));
    EXPECT_EQ(all.octree.stats().black, 1U);
    EXPECT_EQ(all.octree.stats().nodes(), 1U);
    EXPECT_EQ(build_or_die(csg::nothing(), depth_of(4)).octree.stats().white, 1U);
}

TEST(CsgBuild, CancellingEndsBothMethods) {
    std::atomic<bool> cancel{true};
    Context context;
    context.cancel = &cancel;
    for (const CsgMethod method : {CsgMethod::top_down, CsgMethod::classic})
        EXPECT_EQ(build(Expr(csg::Ball{1}), depth_of(8, method), context).error().code, ErrorCode::cancelled);
}

TEST(CsgBuild, DepthsOutOfRangeAreRefused) {
    for (const int depth : {-1, 22})
        EXPECT_EQ(build(Expr(csg::Ball{1}), depth_of(depth)).error().code, ErrorCode::bad_input);
    EXPECT_TRUE(build(Expr(csg::Ball{1}), depth_of(0)));
}

}  // namespace
}  // namespace octavo::classic
