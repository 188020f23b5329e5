// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <octavo/base/vec3.hpp>

namespace octavo {
namespace {

Affine diagonal(double x, double y, double z) { return {{{{x, 0, 0, 7}, {0, y, 0, 7}, {0, 0, z, 7}}}}; }

TEST(Affine, MirrorsWhateverItsScaleIs) {
    for (const double size : {1.0, 1e-120, 1e-300, 1e120, 1e300}) {
        EXPECT_FALSE(diagonal(size, size, size).mirrors()) << size;
        EXPECT_TRUE(diagonal(-size, size, size).mirrors()) << size;
        EXPECT_FALSE(diagonal(-size, -size, size).mirrors()) << size;
        EXPECT_TRUE(diagonal(-size, 1, 1 / size).mirrors()) << size;
    }
    EXPECT_FALSE(diagonal(0, -1, 1).mirrors()) << "a flat map has no side";
    EXPECT_TRUE((Affine{{{{0, 1, 0, 0}, {1, 0, 0, 0}, {0, 0, 1, 0}}}}.mirrors()));
}

TEST(Affine, MirrorsIsDecidedBeyondRounding) {
    // The upper left minor is -2^-60, which products rounded to doubles lose.
    const double step = 0x1p-30;
    Affine map{{{{1 + step, 1, 0, 0}, {1, 1 - step, 0, 0}, {0, 0, 1, 0}}}};
    EXPECT_TRUE(map.mirrors());
    std::swap(map.m[0], map.m[1]);
    EXPECT_FALSE(map.mirrors());
}

}  // namespace
}  // namespace octavo
