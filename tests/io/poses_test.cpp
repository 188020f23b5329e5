// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <octavo/io/poses.hpp>

namespace octavo::io {
namespace {

TEST(Poses, AreThreeNumbersOrTwelve) {
    const Result<std::vector<Affine>> poses =
        read_poses(bytes_of("x,y,z\n1, 2.5, -3\n# a comment\n0 1 0 4;-1 0 0 5\t0 0 1 6 # turned\n"));
    ASSERT_TRUE(poses);
    ASSERT_EQ(poses->size(), 2U);
    EXPECT_EQ((*poses)[0]({1, 1, 1}), (Vec3{2, 3.5, -2}));
    EXPECT_EQ((*poses)[1]({1, 2, 3}), (Vec3{6, 4, 9}));
}

TEST(Poses, ErrorsNameTheLine) {
    const Result<std::vector<Affine>> four = read_poses(bytes_of("1,2,3\n1,2,3,4\n"));
    ASSERT_FALSE(four);
    EXPECT_EQ(four.error().place.line, 2U);
    for (const char* text : {"1,2,3\n1,two,3\n", "1,2,3\n1,nan,3\n", "1,2,3\n1,inf,3\n"}) {
        const Result<std::vector<Affine>> poses = read_poses(bytes_of(text));
        ASSERT_FALSE(poses) << text;
        EXPECT_EQ(poses.error().code, ErrorCode::bad_input);
        EXPECT_EQ(poses.error().place.line, 2U);
    }
    // What begins like a number is no name.
    const Result<std::vector<Affine>> dots = read_poses(bytes_of("1.2.3 4.5.6 7.8.9\n1 2 3\n"));
    ASSERT_FALSE(dots);
    EXPECT_EQ(dots.error().place.line, 1U);
    EXPECT_FALSE(read_poses(bytes_of("")));
    EXPECT_FALSE(read_poses(bytes_of("# nothing\n")));
    EXPECT_FALSE(read_poses(std::string("/nowhere/poses.csv")));
}

}  // namespace
}  // namespace octavo::io
