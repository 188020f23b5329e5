// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <octavo/base/result.hpp>

namespace octavo {
namespace {

Result<int> half(int number) {
    if (number % 2) return Error{ErrorCode::bad_input, "the number is odd", {}};
    return number / 2;
}

TEST(Result, HoldsTheValueOrTheError) {
    EXPECT_EQ(*half(8), 4);
    const Result<int> bad = half(7);
    ASSERT_FALSE(bad);
    EXPECT_EQ(bad.error().code, ErrorCode::bad_input);
    EXPECT_EQ(bad.error().describe(), "the number is odd");
}

TEST(Result, DescribeNamesThePlace) {
    Error error{ErrorCode::bad_input, "expected 3 indices", {}};
    error.place.file = "a.off";
    error.place.line = 12;
    error.place.column = 4;
    error.place.faces = {3, 17};
    EXPECT_EQ(error.describe(), "a.off:12:4: expected 3 indices (facets 3, 17)");
}

TEST(Result, DescribeNamesTheOperandAndTheOption) {
    Error error{ErrorCode::limit, "has more than 7 cells", {}, "max_cells"};
    error.place.operand = 2;
    EXPECT_EQ(error.describe(), "operand 2: has more than 7 cells (max_cells)");
}

TEST(ResultDeathTest, ReadingAValueThatIsNotThereStopsTheProgram) {
    EXPECT_DEATH(static_cast<void>(*half(3)), "the number is odd");
}

}  // namespace
}  // namespace octavo
