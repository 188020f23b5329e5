// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include <octavo/csg/form_bounds.hpp>
#include <octavo/csg/normal_form.hpp>

#include "random_solids.hpp"

namespace octavo::csg {
namespace {

using tests::RandomSolids;
using tests::Side;

/// Membership by the tokens of a normal form.
Side side(const NormalForm& form, std::size_t& at, Vec3 p) {
    const NormalToken token = form.tokens[at++];
    if (token.kind == NormalKind::constant) return token.complemented ? Side::inside : Side::outside;
    if (token.kind == NormalKind::leaf) {
        const PlacedPrimitive& leaf = form.leaves[token.leaf];
        const Side s = tests::side(transform(leaf.place, Expr(*leaf.primitive)), p, 1e-9);
        return token.complemented ? tests::flip(s) : s;
    }
    const std::size_t end = at - 1 + token.size;
    Side result = token.kind == NormalKind::intersection ? Side::inside : Side::outside;
    if (token.kind == NormalKind::symmetric_difference && token.complemented) result = Side::inside;
    while (at < end) {
        const Side s = side(form, at, p);
        if (token.kind == NormalKind::intersection)
            result = tests::both(result, s);
        else if (token.kind == NormalKind::union_of)
            result = tests::flip(tests::both(tests::flip(result), tests::flip(s)));
        else if (result == Side::unsure || s == Side::unsure)
            result = Side::unsure;
        else
            result = result == s ? Side::outside : Side::inside;
    }
    return result;
}

void expect_well_formed(const NormalForm& form) {
    struct Open {
        NormalKind kind;
        std::size_t end;
        int operands;
    };
    std::vector<Open> open;
    for (std::size_t at = 0; at < form.tokens.size(); ++at) {
        const NormalToken& token = form.tokens[at];
        while (!open.empty() && open.back().end == at) {
            EXPECT_GE(open.back().operands, 2);
            open.pop_back();
        }
        if (token.kind == NormalKind::constant) {
            EXPECT_EQ(form.tokens.size(), 1U);
        }
        if (!open.empty()) {
            ++open.back().operands;
            EXPECT_NE(
                open.back().kind == NormalKind::symmetric_difference ? NormalKind::leaf : open.back().kind,
                token.kind == NormalKind::leaf ? NormalKind::constant : token.kind)
                << "an operation must not hold one of its own kind";
        }
        if (token.kind == NormalKind::leaf)
            EXPECT_LT(token.leaf, form.leaves.size());
        else if (token.kind != NormalKind::constant)
            open.push_back({token.kind, at + token.size, 0});
    }
}

TEST(NormalForm, KeepsTheMembershipOfEveryPoint) {
    RandomSolids random(11);
    for (int round = 0; round < 300; ++round) {
        const Expr expression = random.tree(1 + random.below(12));
        const Result<NormalForm> form = normal_form(expression);
        ASSERT_TRUE(form);
        expect_well_formed(*form);
        const Box3 box = bounds(*form);
        for (int i = 0; i < 40; ++i) {
            const Vec3 p{random.uniform(-4, 4), random.uniform(-4, 4), random.uniform(-4, 4)};
            const Side expected = tests::side(expression, p, 1e-9);
            std::size_t at = 0;
            const Side actual = side(*form, at, p);
            EXPECT_EQ(at, form->tokens.size());
            if (expected == Side::unsure || actual == Side::unsure) continue;
            EXPECT_EQ(actual, expected);
            if (expected == Side::inside) {
                const bool in_box = p.x >= box.low.x && p.y >= box.low.y && p.z >= box.low.z &&
                                    p.x <= box.high.x && p.y <= box.high.y && p.z <= box.high.z;
                EXPECT_TRUE(in_box) << "bounds must hold the solid";
            }
        }
    }
}

TEST(FormBounds, WhatIsOutOfReachCanGo) {
    RandomSolids random(12);
    std::size_t before = 0, after = 0;
    for (int round = 0; round < 300; ++round) {
        // Far enough apart that many operands do nothing.
        std::vector<Expr> operands;
        for (int i = 2 + random.below(4); i > 0; --i) {
            Affine shift;
            for (std::size_t axis = 0; axis < 3; ++axis) shift.m[axis][3] = random.uniform(-4, 4);
            operands.push_back(transform(shift, random.tree(1 + random.below(5))));
        }
        const Expr expression = random.below(2)   ? subtract(operands)
                                : random.below(2) ? unite({subtract(operands), intersect(operands)})
                                                  : symmetric_difference({operands[0], subtract(operands)});
        Result<NormalForm> form = normal_form(expression);
        ASSERT_TRUE(form);
        before += form->tokens.size();
        drop_out_of_reach(*form, form_bounds(*form), 1e-6);
        for (const NormalToken& token : form->tokens) after += token.kind != NormalKind::constant;
        for (int i = 0; i < 60; ++i) {
            const Vec3 p{random.uniform(-6, 6), random.uniform(-6, 6), random.uniform(-6, 6)};
            std::size_t at = 0;
            const Side expected = tests::side(expression, p, 1e-9), actual = side(*form, at, p);
            EXPECT_EQ(at, form->tokens.size());
            if (expected != Side::unsure && actual != Side::unsure) {
                EXPECT_EQ(actual, expected);
            }
        }
    }
    EXPECT_LT(after, before * 3 / 4);
}

TEST(FormBounds, BodiesThatTouchStayAndBodiesApartGo) {
    const auto box_at = [](double x) { return Expr(Cuboid{{x, 0, 0}, {x + 1, 1, 1}}); };
    const auto leaves_left = [](const Expr& expression) {
        Result<NormalForm> form = normal_form(expression);
        drop_out_of_reach(*form, form_bounds(*form), 0.01);
        return std::count_if(form->tokens.begin(), form->tokens.end(),
                             [](const NormalToken& token) { return token.kind == NormalKind::leaf; });
    };
    EXPECT_EQ(leaves_left(subtract({box_at(0), box_at(1)})), 2) << "faces in one plane are within the margin";
    EXPECT_EQ(leaves_left(subtract({box_at(0), box_at(2)})), 1);
    EXPECT_EQ(leaves_left(intersect({box_at(0), box_at(2)})), 0);
    EXPECT_EQ(leaves_left(unite({box_at(0), box_at(2)})), 2);
    EXPECT_EQ(leaves_left(intersect({unite({box_at(0), box_at(3)}), unite({box_at(0.5), box_at(9)})})), 3);
    EXPECT_EQ(leaves_left(symmetric_difference({box_at(0), intersect({box_at(4), box_at(6)})})), 1);
    EXPECT_EQ(leaves_left(complement(subtract({box_at(0), box_at(2)}))), 1);
    EXPECT_EQ(leaves_left(subtract({box_at(0), subtract({box_at(0.5), box_at(4)})})), 2);
    EXPECT_EQ(leaves_left(complement(symmetric_difference({box_at(0), complement(box_at(3))}))), 2);
}

TEST(NormalForm, ConstantsDisappear) {
    const Expr ball(Ball{1});
    const auto constant_of = [](const Expr& expression) {
        const Result<NormalForm> form = normal_form(expression);
        return form->is_constant() ? (form->tokens[0].complemented ? "everything" : "nothing") : "solid";
    };
    EXPECT_STREQ(constant_of(nothing()), "nothing");
    EXPECT_STREQ(constant_of(everything()), "everything");
    EXPECT_STREQ(constant_of(unite({ball, everything()})), "everything");
    EXPECT_STREQ(constant_of(subtract({ball, everything()})), "nothing");
    EXPECT_STREQ(constant_of(subtract({nothing(), ball})), "nothing");
    EXPECT_STREQ(constant_of(intersect({ball, nothing()})), "nothing");
    EXPECT_STREQ(constant_of(intersect({})), "everything");
    EXPECT_STREQ(constant_of(unite({ball, nothing()})), "solid");
    EXPECT_STREQ(constant_of(Expr(Ball{0})), "nothing");
    EXPECT_STREQ(constant_of(complement(Expr(Cuboid{{0, 0, 0}, {1, 1, 0}}))), "everything");
    EXPECT_STREQ(constant_of(complement(symmetric_difference({everything(), everything()}))), "everything");
    EXPECT_EQ(normal_form(unite({unite({ball, ball}), unite({ball, nothing()})}))->tokens[0].size, 4U);
}

TEST(NormalForm, SingularMapsGiveNothingWhateverTheyMap) {
    Affine flat;
    flat.m[2][2] = 0;
    for (const Expr& solid : {Expr(Ball{1}), complement(Expr(Ball{1})), everything()}) {
        const Result<NormalForm> form = normal_form(transform(flat, solid));
        ASSERT_TRUE(form->is_constant());
        EXPECT_FALSE(form->tokens[0].complemented);
    }
    EXPECT_TRUE(normal_form(complement(transform(flat, Expr(Ball{1}))))->tokens[0].complemented);
    Affine thin;  // thin is not singular
    thin.m[2][2] = 1e-9;
    EXPECT_FALSE(normal_form(transform(thin, Expr(Ball{1})))->is_constant());
}

TEST(NormalForm, RefusesNumbersThatAreNotFinite) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    Affine broken;
    broken.m[1][2] = nan;
    EXPECT_EQ(normal_form(transform(broken, Expr(Ball{1}))).error().code, ErrorCode::bad_input);
    EXPECT_EQ(normal_form(Expr(Ball{std::numeric_limits<double>::infinity()})).error().code,
              ErrorCode::bad_input);
    EXPECT_EQ(normal_form(Expr(HalfSpace{{0, 0, 0}, 1})).error().code, ErrorCode::bad_input);
}

TEST(NormalForm, DeepTreesAndSharedSubtreesAreNoTrouble) {
    Expr deep(Ball{1});
    for (int i = 0; i < 200'000; ++i)
        deep = i % 2 ? unite({deep, Expr(Ball{0.5})}) : complement(subtract({deep, Expr(Ball{0.25})}));
    EXPECT_TRUE(normal_form(deep));
    Expr doubled(Ball{1});
    for (int i = 0; i < 60; ++i) doubled = unite({doubled, doubled});
    NormalFormOptions options;
    options.max_leaves = 1000;
    EXPECT_EQ(normal_form(doubled, options).error().code, ErrorCode::limit);
}

}  // namespace
}  // namespace octavo::csg
