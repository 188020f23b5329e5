// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <vector>

#include <gtest/gtest.h>

#include <octavo/csg/body_in_cells.hpp>
#include <octavo/csg/brick.hpp>
#include <octavo/csg/brick_sides.hpp>
#include <octavo/csg/convex_overlap.hpp>
#include <octavo/csg/point_sides.hpp>
#include <octavo/csg/prune.hpp>

#include "random_solids.hpp"
#include "unlimited.hpp"

// The sides of points and cells that SIMD lanes in single precision say, against rationals.

namespace octavo::csg {
namespace {

using octavo::tests::Rational;
using octree::Cell;

/// A point in eighths of a cell from its low corner, in lattice coordinates.
std::array<Rational, 3> point_in(const Cell& cell, int x, int y, int z) {
    const Rational eighth(cell.side(), 8);
    return {cell.low.x + x * eighth, cell.low.y + y * eighth, cell.low.z + z * eighth};
}

/// −1 outside, 1 inside, 0 on the surface.
int exact_side(const LatticePlane& plane, const std::array<Rational, 3>& p) {
    const Rational value =
        plane.normal[0] * p[0] + plane.normal[1] * p[1] + plane.normal[2] * p[2] + plane.offset;
    return value.sign();
}
/// The doubles of a cone are the surface: |L x + l|² against (w · x + v)², in the nappe where that is positive.
int exact_side(const SecondOrderCone& cone, const std::array<Rational, 3>& p) {
    std::array<Rational, 4> u;
    for (std::size_t r = 0; r < 4; ++r) {
        u[r] = Rational(cone.row[r][3]);
        for (std::size_t a = 0; a < 3; ++a)
            u[r] += Rational(cone.row[r][a]) * (p[a] - Rational(cone.origin[a]));
    }
    if (u[3] <= 0) return -1;
    const Rational excess = u[0] * u[0] + u[1] * u[1] + u[2] * u[2] - u[3] * u[3];
    return -excess.sign();
}

Cell random_cell(tests::RandomSolids& random, int least_level, int most_level) {
    Cell cell = Cell::root();
    for (int level = least_level + random.below(most_level - least_level + 1); level > 0; --level)
        cell = cell.child(random.below(8));
    return cell;
}

/// Through a lattice point of the cell or near it, so that signs change in the cell; often normal to an axis or with
/// points of the grid exactly on it.
LatticePlane random_plane(tests::RandomSolids& random, const Cell& cell) {
    LatticePlane plane;
    const int kind = random.below(3);
    for (auto& component : plane.normal)
        component = kind == 0 ? random.below(3) - 1 : (std::int64_t{random.below(1 << 30)} - (1 << 29)) * 16;
    plane.normal[static_cast<std::size_t>(random.below(3))] = std::int64_t{1} << LatticePlane::normal_bits;
    if (kind == 0)
        for (auto& component : plane.normal) component = component < 2 ? component << 34 : component;
    const std::int32_t eighth = cell.side() / 8;
    const auto at = [&](std::int32_t low) { return low + eighth * random.below(9); };
    plane.offset -= plane.at(at(cell.low.x), at(cell.low.y), at(cell.low.z));
    if (kind == 2) plane.offset += random.below(1000);
    return plane;
}

SecondOrderCone random_cone(tests::RandomSolids& random, const Cell& cell) {
    SecondOrderCone cone;
    const int kind = random.below(4);  // ellipsoid, cylinder, cone, and a cone about the cell's middle
    const double size = cell.side() * random.uniform(0.1, 3);
    for (std::size_t r = 0; r < (kind == 0 ? 3U : 2U); ++r)
        for (std::size_t a = 0; a < 3; ++a) cone.row[r][a] = random.uniform(-1, 1) / size;
    cone.row[3][3] = kind < 3 ? 1 : 0;
    if (kind >= 2)
        for (std::size_t a = 0; a < 3; ++a) cone.row[3][a] = random.uniform(-1, 1) / size;
    const exact::Point middle = cell.centre();
    const double spread = kind == 3 ? 0 : cell.side();
    cone.origin = {middle.x + std::nearbyint(spread * random.uniform(-1, 1)),
                   middle.y + std::nearbyint(spread * random.uniform(-1, 1)),
                   middle.z + std::nearbyint(spread * random.uniform(-1, 1))};
    cone.finish();
    return cone;
}

/// Inside and outside are right, and no point is left out that is not on the surface or next to it.
template <class Surface>
void expect_right(const Surface& surface, const Cell& cell, PointColors points, bool exact) {
    const auto check = [&](int p, int x, int y, int z) {
        const int side = exact_side(surface, point_in(cell, x, y, z));
        const bool inside = (points.inside >> p & 1) != 0, outside = (points.outside >> p & 1) != 0;
        EXPECT_FALSE(inside && side <= 0);
        EXPECT_FALSE(outside && side >= 0);
        if (exact) {
            EXPECT_EQ(inside, side > 0);
            EXPECT_EQ(outside, side < 0);
        }
    };
    for (int p = 0; p < PointColors::corners; ++p) check(p, 4 * (p % 3), 4 * (p / 3 % 3), 4 * (p / 9));
    for (int n = 0; n < 8; ++n) check(PointColors::corners + n, n & 1 ? 6 : 2, n & 2 ? 6 : 2, n & 4 ? 6 : 2);
}

template <class Surface>
void expect_right(const Surface& surface, const Cell& cell, const LayerPair& corners, bool exact) {
    for (std::uint32_t k = 0; k < 5; ++k)
        for (std::uint32_t j = 0; j < 5; ++j)
            for (std::uint32_t i = 0; i < 5; ++i) {
                const int side =
                    exact_side(surface, point_in(cell, static_cast<int>(2 * i), static_cast<int>(2 * j),
                                                 static_cast<int>(2 * k)));
                const bool inside = (corners.in.layer[k] >> (i + 5 * j) & 1) != 0,
                           outside = (corners.out.layer[k] >> (i + 5 * j) & 1) != 0;
                EXPECT_FALSE(inside && side <= 0);
                EXPECT_FALSE(outside && side >= 0);
                if (exact) {
                    EXPECT_EQ(inside, side > 0);
                    EXPECT_EQ(outside, side < 0);
                }
            }
}

TEST(PointSides, OfPlanesAreExact) {
    tests::RandomSolids random(71);
    for (int round = 0; round < 300; ++round) {
        const Cell cell = random_cell(random, 0, 20);
        const LatticePlane plane = random_plane(random, cell);
        const PointColors points = sides_of(plane, cell);
        expect_right(plane, cell, points, true);
        const OctantColors octants = octants_of(plane, cell);
        EXPECT_EQ(octants.white, static_cast<std::uint8_t>(~octants_with_corner(points.inside)));
        EXPECT_EQ(octants.black, static_cast<std::uint8_t>(~octants_with_corner(points.outside)));
        BrickSurface surface;
        const BrickSides brick = brick_sides(plane, cell, surface);
        expect_right(plane, cell, brick.corners, true);
        // A half space is white in a cell without a corner inside, and black in one without a corner outside.
        EXPECT_EQ(brick.white, without(Layers::cells(), cells_with_corner(brick.corners.in)));
        EXPECT_EQ(brick.black, without(Layers::cells(), cells_with_corner(brick.corners.out)));
    }
}

TEST(PointSides, OfQuadricsAreNeverWrongAndSeldomMissing) {
    tests::RandomSolids random(72);
    int unknown = 0, missed = 0, missed_as_colors = 0, missed_by_bricks = 0, held = 0, held_as_colors = 0;
    for (int round = 0; round < 300; ++round) {
        const Cell cell = random_cell(random, 0, 20);
        const SecondOrderCone cone = random_cone(random, cell);
        const Quadric quadric(cone);
        const QuadricSides sides = sides_of(quadric, cell);
        expect_right(cone, cell, sides.points, false);
        unknown += std::popcount(PointColors::all & ~(sides.points.inside | sides.points.outside));
        const OctantColors colors = octants_of(quadric, cell);
        const auto all_inside = static_cast<std::uint8_t>(~octants_with_corner(~sides.points.inside));
        EXPECT_EQ(colors.black & ~all_inside, 0) << "a corner that may lie outside";
        held += std::popcount(all_inside);
        held_as_colors += std::popcount(colors.black);
        BrickSurface surface;
        const BrickSides brick = brick_sides(quadric, cell, surface);
        expect_right(cone, cell, brick.corners, false);
        unknown += without(Layers::corners(), brick.corners.in | brick.corners.out).any();
        // No point of a cell that is missed lies inside.
        for (int sample = 0; sample < 40; ++sample) {
            const std::array<int, 3> at{random.below(65), random.below(65), random.below(65)};
            const Rational step(cell.side(), 64);
            const std::array<Rational, 3> p{cell.low.x + at[0] * step, cell.low.y + at[1] * step,
                                            cell.low.z + at[2] * step};
            const int octant = (at[0] > 32) + 2 * (at[1] > 32) + 4 * (at[2] > 32);
            const auto quarter = [](int a) { return static_cast<std::uint32_t>(std::min(a / 16, 3)); };
            const BrickCell place{quarter(at[0]), quarter(at[1]), quarter(at[2])};
            const bool outside = exact_side(cone, p) <= 0;
            EXPECT_TRUE(outside || !(sides.missed >> octant & 1));
            EXPECT_TRUE(outside || !(colors.white >> octant & 1));
            EXPECT_TRUE(outside || !place.in(brick.white));
            EXPECT_TRUE(!outside || exact_side(cone, p) == 0 || !place.in(brick.black));
            missed += sides.missed >> octant & 1;
            missed_as_colors += colors.white >> octant & 1;
            missed_by_bricks += place.in(brick.white);
        }
    }
    EXPECT_LT(unknown, 180)
        << "of 48 000: twice the tip of a cone that lies in the middle of a cell, and few others";
    EXPECT_GT(missed, 500);
    EXPECT_GT(missed_as_colors, 500);
    EXPECT_GT(missed_by_bricks, 500);
    EXPECT_GT(held, 100);
    EXPECT_GT(10 * held_as_colors, 9 * held) << "colours alone allow for the most that mixed terms can add";
}

TEST(PointSides, OfBoxesAreThoseOfTheirSides) {
    tests::RandomSolids random(73);
    for (int round = 0; round < 300; ++round) {
        const Cell cell = random_cell(random, 3, 20);
        Leaf leaf;
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            const std::int32_t eighth = cell.side() / 8,
                               low = cell.low[axis] + eighth * (random.below(13) - 2);
            leaf.low[a] = std::max(0, low + random.below(3) - 1);
            leaf.high[a] = leaf.low[a] + eighth * (1 + random.below(12)) + random.below(3) - 1;
        }
        const BrickSides brick = brick_sides_of_box(leaf, cell);
        const std::int32_t quarter = cell.side() / 4;
        for (std::uint32_t k = 0; k < 5; ++k)
            for (std::uint32_t j = 0; j < 5; ++j)
                for (std::uint32_t i = 0; i < 5; ++i) {
                    const std::array<std::uint32_t, 3> steps{i, j, k};
                    bool outside = false, inside = true, white = false, black = true;
                    for (int axis = 0; axis < 3; ++axis) {
                        const auto a = static_cast<std::size_t>(axis);
                        const std::int32_t at =
                            cell.low[axis] + quarter * static_cast<std::int32_t>(steps[a]);
                        outside |= at < leaf.low[a] || at > leaf.high[a];
                        inside &= at > leaf.low[a] && at < leaf.high[a];
                        white |= at + quarter <= leaf.low[a] || at >= leaf.high[a];
                        black &= at >= leaf.low[a] && at + quarter <= leaf.high[a];
                    }
                    EXPECT_EQ(outside, (brick.corners.out.layer[k] >> (i + 5 * j) & 1) != 0);
                    EXPECT_EQ(inside, (brick.corners.in.layer[k] >> (i + 5 * j) & 1) != 0);
                    if (i == 4 || j == 4 || k == 4) continue;
                    EXPECT_EQ(white, (BrickCell{i, j, k}.in(brick.white)));
                    EXPECT_EQ(black, (BrickCell{i, j, k}.in(brick.black)));
                }
    }
}

TEST(PointColors, OctantsWithACornerAreTheNeighboursOfIt) {
    for (int p = 0; p < PointColors::corners; ++p) {
        unsigned expected = 0;
        for (int octant = 0; octant < 8; ++octant) {
            const int x = p % 3 - (octant & 1), y = p / 3 % 3 - (octant >> 1 & 1), z = p / 9 - (octant >> 2);
            expected |= static_cast<unsigned>((x | 1) == 1 && (y | 1) == 1 && (z | 1) == 1) << octant;
        }
        EXPECT_EQ(octants_with_corner(std::uint64_t{1} << p), expected);
    }
    for (std::uint32_t k = 0; k < 5; ++k)
        for (std::uint32_t bit = 0; bit < 25; ++bit) {
            Layers corner;
            corner.layer[k] = std::uint32_t{1} << bit;
            const Layers cells = cells_with_corner(corner);
            for (std::uint32_t z = 0; z < 4; ++z)
                for (std::uint32_t y = 0; y < 4; ++y)
                    for (std::uint32_t x = 0; x < 4; ++x) {
                        const bool touches = bit % 5 - x <= 1 && bit / 5 - y <= 1 && k - z <= 1;
                        EXPECT_EQ((BrickCell{x, y, z}.in(cells)), touches);
                    }
        }
}

/// Against certificates in rationals and integers: what is missed does not meet, what is entered is not apart.
TEST(BodyInCells, IsNeverWrongAndSeldomSilent) {
    tests::RandomSolids random(75);
    int asked = 0, missed = 0, entered = 0;
    for (int round = 0; round < 400; ++round) {
        const Cell brick = random_cell(random, 3, 18);
        std::vector<LatticePlane> planes;
        std::vector<SecondOrderCone> cones;
        std::vector<BrickSurface> surfaces;
        std::vector<Layers> matters;
        Layers open = Layers::cells();
        for (int i = 1 + random.below(10); i > 0; --i) {
            BrickSurface surface;
            BrickSides sides;
            if (random.below(3)) {
                planes.push_back(random_plane(random, brick));
                sides = brick_sides(planes.back(), brick, surface);
            } else {
                cones.push_back(random_cone(random, brick));
                sides = brick_sides(Quadric(cones.back()), brick, surface);
                if (!surface.plain) {
                    cones.pop_back();
                    continue;
                }
            }
            surfaces.push_back(surface);
            matters.push_back(without(Layers::cells(), sides.black));
            open = without(open, sides.white);
        }
        if (surfaces.empty()) continue;
        std::vector<const SecondOrderCone*> cone_pointers;
        for (const SecondOrderCone& cone : cones) cone_pointers.push_back(&cone);
        BodyInCells body;
        BodiesInCells bodies;
        for_each_cell(open, [&](BrickCell cell) { bodies.ask(surfaces, matters.data(), cell, body); });
        bodies.finish();
        EXPECT_FALSE((body.missed & body.entered).any());
        EXPECT_FALSE(without(body.missed | body.entered, open).any());
        const std::int32_t side = brick.side() / 4;
        for_each_cell(open, [&](BrickCell next) {
            const auto at = [&](std::int32_t low, std::uint32_t steps) {
                return low + side * static_cast<std::int32_t>(steps);
            };
            const Cell cell{{at(brick.low.x, next.x), at(brick.low.y, next.y), at(brick.low.z, next.z)},
                            brick.level + 2};
            const Overlap truth = overlap(cell, planes, cone_pointers);
            ++asked;
            if (next.in(body.missed)) {
                ++missed;
                EXPECT_NE(truth, Overlap::meets);
            }
            if (next.in(body.entered)) {
                ++entered;
                EXPECT_NE(truth, Overlap::apart);
            }
        });
    }
    EXPECT_GT(missed, asked / 50);
    EXPECT_GT(entered, asked / 10);
    EXPECT_GT(missed + entered, asked * 3 / 4) << "the rest costs a slower look";
}

TEST(Layers, MortonOrderIsThatOfOctants) {
    for (unsigned outer = 0; outer < 8; ++outer)
        for (unsigned inner = 0; inner < 8; ++inner) {
            Layers cells;
            BrickCell::of(outer, inner).add_to(cells);
            const std::uint64_t bit = std::uint64_t{1} << (8 * outer + inner);
            const InMortonOrder one(cells, without(Layers::cells(), cells));
            EXPECT_EQ(one.first, bit);
            EXPECT_EQ(one.second, ~bit);
        }
    const InMortonOrder all(Layers::corners(), Layers{});
    EXPECT_EQ(all.first, ~std::uint64_t{0}) << "bits that are no cells do not count";
    EXPECT_EQ(all.second, 0U);
}

/// Two levels at once say nothing else than one level after the other: where both decide they agree, and a cell with
/// points on both sides is decided by neither.
TEST(Brick, AgreesWithOneLevelAfterTheOther) {
    tests::RandomSolids random(74);
    int decided = 0, proved = 0;
    for (int round = 0; round < 600; ++round) {
        std::vector<Expr> leaves;
        for (int i = 1 + random.below(6); i > 0; --i) leaves.push_back(random.placed());
        Expr expression = leaves[0];
        for (std::size_t i = 1; i < leaves.size(); ++i)
            expression = random.below(2) ? symmetric_difference({expression, leaves[i]})
                                         : subtract({unite({leaves[i], leaves[0]}), expression});
        CompileOptions options;
        options.universe = Box3{{-5, -5, -5}, {5, 5, 5}};
        const Result<Program> program = compile(expression, options);
        ASSERT_TRUE(program);
        if (program->words.empty()) continue;
        const Cell cell = random_cell(random, 0, 3);
        Brick brick;
        const Brick::Colors seen = brick.evaluate(*program, program->words, cell);
        const Layers both = without(neither(seen.cells, Layers::cells()), seen.unproved);
        for (unsigned outer = 0; outer < 8; ++outer) {
            Pruner pruner;
            const Cell octant = cell.child(static_cast<int>(outer));
            const OctantColors colors = pruner.evaluate(*program, program->words, octant).octants;
            for (unsigned inner = 0; inner < 8; ++inner) {
                const BrickCell place = BrickCell::of(outer, inner);
                const bool white = place.in(seen.cells.out), black = place.in(seen.cells.in);
                const octree::Color color = colors[static_cast<int>(inner)];
                EXPECT_FALSE(white && black);
                EXPECT_FALSE(white && color == octree::Color::black);
                EXPECT_FALSE(black && color == octree::Color::white);
                decided += white || black;
                if (!place.in(both)) continue;
                ++proved;
                EXPECT_EQ(color, octree::Color::gray);
                EXPECT_FALSE(white || black);
            }
        }
    }
    EXPECT_GT(decided, 1000);
    EXPECT_GT(proved, 300);
}

}  // namespace
}  // namespace octavo::csg
