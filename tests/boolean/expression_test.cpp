// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <functional>

#include <gtest/gtest.h>

#include <octavo/boolean/expression.hpp>
#include <octavo/mesh/transform.hpp>

#include "effort.hpp"
#include "solids.hpp"

namespace octavo::boolean {
namespace {

constexpr int side = 5;

/// An expression and the cells of a grid in which it holds.
struct Counted {
    csg::Expr expression;
    std::array<bool, side * side * side> cells;
};

template <class Random>
Counted random_leaf(Random& random) {
    const auto number = [&](int low, int high) {
        return std::uniform_int_distribution<int>(low, high)(random);
    };
    std::array<int, 3> low{}, high{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        low[axis] = number(0, side - 1);
        high[axis] = number(low[axis] + 1, side);
    }
    Counted leaf;
    for (int cell = 0; cell < side * side * side; ++cell) {
        const int at[3] = {cell % side, cell / side % side, cell / side / side};
        leaf.cells[static_cast<std::size_t>(cell)] = low[0] <= at[0] && at[0] < high[0] && low[1] <= at[1] &&
                                                     at[1] < high[1] && low[2] <= at[2] && at[2] < high[2];
    }
    const auto corner = [](const std::array<int, 3>& p) {
        return Vec3{static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
    };
    // A unit cube scaled and moved into place, by a map that mirrors it half of the time.
    const Vec3 size = corner(high) - corner(low);
    if (number(0, 1) == 0)
        leaf.expression = csg::transform(compose(mesh::translation(corner(low)), mesh::scaling(size)),
                                         csg::Expr(csg::Cuboid{{0, 0, 0}, {1, 1, 1}}));
    else
        leaf.expression = csg::transform(compose(mesh::translation(corner(high)), mesh::scaling(-size)),
                                         csg::Expr(csg::Cuboid{{0, 0, 0}, {1, 1, 1}}));
    return leaf;
}

template <class Random>
Counted random_tree(Random& random, int depth) {
    const auto number = [&](int low, int high) {
        return std::uniform_int_distribution<int>(low, high)(random);
    };
    if (depth == 0 || number(0, 3) == 0) return random_leaf(random);
    const int kind = number(0, 4);
    if (kind == 4) {
        Counted inner = random_tree(random, depth - 1);
        inner.expression = csg::complement(inner.expression);
        for (bool& cell : inner.cells) cell = !cell;
        return inner;
    }
    std::vector<Counted> inputs;
    for (int i = number(1, 3); i > 0; --i) inputs.push_back(random_tree(random, depth - 1));
    Counted tree = inputs[0];
    std::vector<csg::Expr> operands;
    for (const Counted& input : inputs) operands.push_back(input.expression);
    for (std::size_t i = 1; i < inputs.size(); ++i)
        for (std::size_t cell = 0; cell < tree.cells.size(); ++cell) {
            const bool a = tree.cells[cell], b = inputs[i].cells[cell];
            tree.cells[cell] = kind == 0 ? a || b : kind == 1 ? a && b : kind == 2 ? a && !b : a != b;
        }
    tree.expression = kind == 0   ? csg::unite(operands)
                      : kind == 1 ? csg::intersect(operands)
                      : kind == 2 ? csg::subtract(operands)
                                  : csg::symmetric_difference(operands);
    return tree;
}

TEST(Expression, HoldsWhereItHoldsCellByCell) {
    for (int run = 0; run < 300 * tests::effort() && !HasFailure(); ++run) {
        std::mt19937 random(static_cast<unsigned>(run));
        const Counted tree = random_tree(random, 4), world = random_leaf(random);
        // Any expression within a box is bounded.
        const Result<Evaluated> result = evaluate(csg::intersect({tree.expression, world.expression}));
        ASSERT_TRUE(result) << "run " << run << ": " << result.error().describe();
        std::size_t volume = 0;
        for (std::size_t cell = 0; cell < tree.cells.size(); ++cell)
            volume += tree.cells[cell] && world.cells[cell];
        EXPECT_EQ(tests::manifold_defect(result->mesh), "") << "run " << run;
        EXPECT_EQ(tests::exact_volume(result->mesh), volume) << "run " << run;
    }
}

TEST(Expression, RefusesWhatIsUnboundedOrHasNoFacets) {
    const csg::Expr box(csg::Cuboid{{0, 0, 0}, {1, 1, 1}});
    EXPECT_EQ(evaluate(csg::complement(box)).error().code, ErrorCode::bad_input);
    EXPECT_EQ(evaluate(csg::everything()).error().code, ErrorCode::bad_input);
    EXPECT_EQ(evaluate(csg::unite({box, csg::Expr(csg::Ball{1})})).error().code, ErrorCode::unsupported);
}

TEST(Expression, IsEmptyWithAWarningWhereNothingIsLeft) {
    const Result<Evaluated> result = evaluate(csg::nothing());
    ASSERT_TRUE(result);
    EXPECT_TRUE(result->mesh.triangles.empty());
    EXPECT_EQ(result->report.warnings.size(), 1u);
}

}  // namespace
}  // namespace octavo::boolean
