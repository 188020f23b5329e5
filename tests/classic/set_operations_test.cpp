// SPDX-License-Identifier: Apache-2.0
#include <random>

#include <gtest/gtest.h>

#include <octavo/classic/set_operations.hpp>

namespace octavo::classic {
namespace {

using octree::Color;
using octree::DfCode;
using octree::Node;

/// A random tree with colours in runs, so that siblings merge now and then.
void append_random(DfCode& code, int levels, std::mt19937& engine) {
    if (levels > 0 && engine() % 3 != 0) {
        code.append(Node::split);
        for (int i = 0; i < 8; ++i) append_random(code, levels - 1, engine);
    } else {
        code.append(static_cast<Node>(engine() % 5 == 0 ? 2 : engine() % 2));
    }
}

DfCode random_code(std::uint32_t seed, int levels = 4) {
    std::mt19937 engine(seed);
    DfCode code;
    append_random(code, levels, engine);
    return code;
}

/// The colours of all cells of one level: the dense oracle.
std::vector<Color> dense(const DfCode& code, int level) {
    std::vector<Color> cells;
    for (octree::DfCursor cursor(code); !cursor.done(); cursor.next())
        if (is_leaf(cursor.node()))
            cells.insert(cells.end(), std::size_t{1} << (3 * (level - cursor.level())),
                         color_of(cursor.node()));
    return cells;
}

/// No split node has eight leaves of one decided colour.
bool is_condensed(const DfCode& code) {
    for (std::size_t i = 0; i + 8 < code.size(); ++i) {
        if (code[i] != Node::split || code[i + 1] == Node::split || code[i + 1] == Node::gray) continue;
        bool equal = true;
        for (std::size_t k = 2; k <= 8; ++k) equal = equal && code[i + k] == code[i + 1];
        if (equal) return false;
    }
    return true;
}

Color apply(SetOperation operation, Color a, Color b) {
    switch (operation) {
        case SetOperation::union_of:
            return octree::unite(a, b);
        case SetOperation::intersection:
            return octree::intersect(a, b);
        case SetOperation::difference:
            return octree::subtract(a, b);
        default:
            return octree::symmetric_difference(a, b);
    }
}

constexpr SetOperation operations[] = {SetOperation::union_of, SetOperation::intersection,
                                       SetOperation::difference, SetOperation::symmetric_difference};

TEST(SetOperations, AgreeWithTheColourOfEveryCell) {
    for (std::uint32_t seed = 0; seed < 60; ++seed) {
        const DfCode a = random_code(2 * seed), b = random_code(2 * seed + 1);
        const std::vector<Color> cells_a = dense(a, 4), cells_b = dense(b, 4);
        for (const SetOperation operation : operations) {
            const DfCode c = combine(operation, a, b);
            ASSERT_TRUE(octree::check_tree(c, 4));
            const std::vector<Color> cells_c = dense(c, 4);
            ASSERT_EQ(cells_c.size(), cells_a.size());
            for (std::size_t i = 0; i < cells_c.size(); ++i)
                ASSERT_EQ(cells_c[i], apply(operation, cells_a[i], cells_b[i]));
        }
        const std::vector<Color> inverse = dense(complement(a), 4);
        for (std::size_t i = 0; i < inverse.size(); ++i)
            ASSERT_EQ(inverse[i], octree::complement(cells_a[i]));
        EXPECT_EQ(complement(complement(a)), a);
    }
}

TEST(SetOperations, CondenseWhatBecameEqual) {
    for (std::uint32_t seed = 100; seed < 160; ++seed) {
        DfCode white;
        white.append(Node::white);
        // The union with nothing condenses nothing by itself, so start from condensed operands.
        DfCode a = random_code(seed), b = random_code(seed + 1000);
        a = combine(SetOperation::intersection, a, random_code(seed + 2000));
        b = combine(SetOperation::union_of, b, random_code(seed + 3000));
        if (!is_condensed(a) || !is_condensed(b)) continue;
        for (const SetOperation operation : operations) EXPECT_TRUE(is_condensed(combine(operation, a, b)));
        EXPECT_EQ(combine(SetOperation::union_of, a, white), a);
        EXPECT_EQ(combine(SetOperation::intersection, a, white), white);
        EXPECT_EQ(combine(SetOperation::union_of, a, b), combine(SetOperation::union_of, b, a));
    }
}

TEST(SetOperations, RefuseDifferentLattices) {
    const octree::Octree a(*exact::Lattice::from_parts(0, {0, 0, 0}), 4, random_code(1));
    const octree::Octree b(*exact::Lattice::from_parts(1, {0, 0, 0}), 4, random_code(2));
    EXPECT_EQ(combine(SetOperation::union_of, a, b).error().code, ErrorCode::bad_input);
    EXPECT_TRUE(combine(SetOperation::union_of, a, a));
}

}  // namespace
}  // namespace octavo::classic
