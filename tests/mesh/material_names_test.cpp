// SPDX-License-Identifier: Apache-2.0
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <octavo/mesh/material_names.hpp>

namespace octavo::mesh {
namespace {

using Names = std::vector<std::string>;

NameRules short_rules() {
    return {.joint = "_AND_",
            .allows = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'; },
            .upper_case = true,
            .before_other_than_letters = "S",
            .longest = 8};
}

TEST(DistinctNames, AreSpelledByTheRulesAndNumberedWhereTheyAreAlike) {
    EXPECT_EQ(distinct_names(Names{"a b", "7up", ""}, short_rules()), (Names{"A_B", "S7UP", "S"}));
    EXPECT_EQ(distinct_names(Names{"a-b", "a_b", "a b"}, short_rules()), (Names{"A_B", "A_B_2", "A_B_3"}));
    EXPECT_EQ(distinct_names(Names{"a", "a", "A"}), (Names{"a", "a_2", "A"}));
}

TEST(DistinctNames, TakeNoNameThatAnotherOneHasByItself) {
    EXPECT_EQ(distinct_names(Names{"a-b", "a_b", "a_b_2"}, short_rules()), (Names{"A_B", "A_B_3", "A_B_2"}));
}

TEST(DistinctNames, StayWithinTheLongestWhenNumbered) {
    Names wanted(120, "abcdefghijkl");
    const Names names = distinct_names(wanted, short_rules());
    EXPECT_EQ(names[0], "ABCDEFGH");
    EXPECT_EQ(names[1], "ABCDEF_2");
    EXPECT_EQ(names[119], "ABCD_120");
    EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
}

TEST(NameMaterials, KeepTheNamesOfSolidsAndNumberOverlapsAndTheOutside) {
    Materials materials;
    materials.solids = {{}, {0}, {0, 1}, {1}, {2}, {3}};
    const Names solids{"a", "b", "a+b", "outside"};
    const MaterialNames named = name_materials(materials, solids, {});
    EXPECT_EQ(named.solids, solids);
    EXPECT_EQ(named.outside, "outside_2");
    EXPECT_EQ(named.materials, (Names{"outside_2", "a", "a+b_2", "b", "a+b", "outside"}));
}

TEST(NameMaterials, NameSolidsAlikeWhetherTheyHaveCellsOrNot) {
    Materials materials;
    materials.solids = {{1}, {4}};
    const Names solids{"a b", "a_b"};
    const MaterialNames named = name_materials(materials, solids, word_rules());
    EXPECT_EQ(named.materials, (Names{"a_b_2", "solid_4"}));
    EXPECT_EQ(named.solids[0], "a_b");
}

}  // namespace
}  // namespace octavo::mesh
