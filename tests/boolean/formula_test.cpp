// SPDX-License-Identifier: Apache-2.0
#include <random>

#include <gtest/gtest.h>

#include <octavo/boolean/formula.hpp>

namespace octavo::boolean {
namespace {

/// The value of a formula when the operands of the given letters hold.
bool value(const Formula& formula, const std::string& holding) {
    Indicator indicator(formula.program);
    for (std::uint32_t k = 0; k < formula.names.size(); ++k)
        if (holding.find(formula.names[k]) != std::string::npos) indicator.set(k, true);
    return indicator.value();
}

/// The truth table over a, b, c: bit k of an index says whether the k-th letter holds.
std::string table(const std::string& text) {
    const Result<Formula> formula = parse_formula(text);
    if (!formula) return formula.error().sentence;
    std::string result;
    for (unsigned bits = 0; bits < 8; ++bits) {
        std::string holding;
        for (unsigned k = 0; k < 3; ++k)
            if (bits >> k & 1) holding += static_cast<char>('a' + k);
        result += value(*formula, holding) ? '1' : '0';
    }
    return result;
}

TEST(Formula, MeansWhatItsTruthTableSays) {
    EXPECT_EQ(table("a"), "01010101");
    EXPECT_EQ(table("a | b"), "01110111");
    EXPECT_EQ(table("a+b"), "01110111");
    EXPECT_EQ(table("a & b"), "00010001");
    EXPECT_EQ(table("a*b"), "00010001");
    EXPECT_EQ(table("a - b"), "01000100");
    EXPECT_EQ(table("a ^ b"), "01100110");
    EXPECT_EQ(table("a - b - c"), "01000000");
    EXPECT_EQ(table("a - (b - c)"), "01000101");
    EXPECT_EQ(table("a | b & c"), "01010111");
    EXPECT_EQ(table("(a | b) & c"), "00000111");
    EXPECT_EQ(table("a ^ b ^ c"), "01101001");
    EXPECT_EQ(table("a - a"), "00000000");
    EXPECT_EQ(table("a ^ a ^ b"), "00110011");
    EXPECT_EQ(table("((((a))))"), "01010101");
}

/// A random formula over a, b, c, with its truth table.
std::pair<std::string, unsigned> random_formula(std::mt19937& random, int depth) {
    const auto number = [&](int low, int high) {
        return std::uniform_int_distribution<int>(low, high)(random);
    };
    if (depth == 0 || number(0, 4) == 0) {
        constexpr unsigned letters[3] = {0xaa, 0xcc, 0xf0};
        const int k = number(0, 2);
        return {std::string(1, static_cast<char>('a' + k)), letters[k]};
    }
    const auto [left, l] = random_formula(random, depth - 1);
    const auto [right, r] = random_formula(random, depth - 1);
    switch (number(0, 3)) {
        case 0:
            return {"(" + left + " | " + right + ")", l | r};
        case 1:
            return {"(" + left + " & " + right + ")", l & r};
        case 2:
            return {"(" + left + " - " + right + ")", l & ~r & 0xff};
        default:
            return {"(" + left + " ^ " + right + ")", l ^ r};
    }
}

TEST(Formula, FollowsOperandsThatStandInManyPlacesThroughAllChanges) {
    for (unsigned run = 0; run < 500; ++run) {
        std::mt19937 random(run);
        const auto [text, truth] = random_formula(random, 6);
        const Result<Formula> formula = parse_formula(text);
        ASSERT_TRUE(formula);
        Indicator indicator(formula->program);
        unsigned bits = 0;
        for (int step = 0; step < 30; ++step) {
            const unsigned letter = std::uniform_int_distribution<unsigned>(0, 2)(random);
            bits ^= 1u << letter;
            for (std::uint32_t k = 0; k < formula->names.size(); ++k)
                if (formula->names[k][0] == static_cast<char>('a' + letter))
                    indicator.set(k, (bits >> letter & 1) != 0);
            ASSERT_EQ(indicator.value(), (truth >> bits & 1) != 0)
                << text << " run " << run << " step " << step;
        }
    }
}

TEST(Formula, KeepsNamesInTheOrderOfTheirFirstUse) {
    const Result<Formula> formula = parse_formula("lid_2 - (bore | body) & lid_2");
    ASSERT_TRUE(formula);
    EXPECT_EQ(formula->names, (std::vector<std::string>{"lid_2", "bore", "body"}));
}

TEST(Formula, NamesTheColumnOfAMistake) {
    EXPECT_EQ(table(""), "a name or an opening parenthesis is missing at column 1 of the expression");
    EXPECT_EQ(table("a |"), "a name or an opening parenthesis is missing at column 4 of the expression");
    EXPECT_EQ(table("a b"), "an operator is missing at column 3 of the expression");
    EXPECT_EQ(table("(a | b"), "a closing parenthesis is missing at column 7 of the expression");
    EXPECT_EQ(table("a) - b"), "an operator is missing at column 2 of the expression");
    EXPECT_EQ(table("a % b"), "an operator is missing at column 3 of the expression");
    EXPECT_NE(table(std::string(5000, '(')).find("1000 parentheses"), std::string::npos);
}

}  // namespace
}  // namespace octavo::boolean
