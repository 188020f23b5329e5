// SPDX-License-Identifier: Apache-2.0
#include <random>

#include <gtest/gtest.h>

#include <octavo/hexmesh/quality.hpp>

namespace octavo::hexmesh {
namespace {

CellCorners cube() {
    CellCorners corners;
    for (unsigned i = 0; i < 8; ++i) corners[i] = {double(i & 1), double(i >> 1 & 1), double(i >> 2)};
    return corners;
}

/// The determinant of the trilinear map at a point, from derivatives written out.
double determinant_at(const CellCorners& p, double u, double v, double w) {
    std::array<Vec3, 3> derivative{};
    for (unsigned i = 0; i < 8; ++i) {
        const double fu = i & 1 ? u : 1 - u, fv = i & 2 ? v : 1 - v, fw = i & 4 ? w : 1 - w;
        const double du = i & 1 ? 1 : -1, dv = i & 2 ? 1 : -1, dw = i & 4 ? 1 : -1;
        derivative[0] = derivative[0] + (du * fv * fw) * p[i];
        derivative[1] = derivative[1] + (fu * dv * fw) * p[i];
        derivative[2] = derivative[2] + (fu * fv * dw) * p[i];
    }
    return dot(derivative[0], cross(derivative[1], derivative[2]));
}

TEST(Quality, KnowsCubesSlabsAndFolds) {
    EXPECT_DOUBLE_EQ(scaled_jacobian(cube()), 1);
    EXPECT_TRUE(is_positive_everywhere(cube()));
    CellCorners sheared = cube();
    for (Vec3& p : sheared) p.x += p.z;  // 45 degrees
    EXPECT_NEAR(scaled_jacobian(sheared), std::sqrt(0.5), 1e-15);
    CellCorners mirrored = cube();
    for (Vec3& p : mirrored) p.x = -p.x;
    EXPECT_DOUBLE_EQ(scaled_jacobian(mirrored), -1);
    EXPECT_FALSE(is_positive_everywhere(mirrored));
    CellCorners flat = cube();
    for (Vec3& p : flat) p.z = 0;
    EXPECT_FALSE(is_positive_everywhere(flat));
    CellCorners point{};
    EXPECT_EQ(scaled_jacobian(point), 0);
    EXPECT_FALSE(is_positive_everywhere(point));
}

TEST(Quality, KnowsVolumesOfCellsWithBentFaces) {
    EXPECT_DOUBLE_EQ(volume_of(cube()), 1);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> offset(-0.3, 0.3);
    for (int round = 0; round < 100; ++round) {
        CellCorners corners = cube();
        for (Vec3& p : corners) p = p + Vec3{offset(random), offset(random), offset(random)};
        // The determinant has degree 2 along each axis, so Gauss' rule of two points is exact.
        const double near = 0.5 - std::sqrt(1.0 / 12), far = 1 - near;
        double integral = 0;
        for (const double u : {near, far})
            for (const double v : {near, far})
                for (const double w : {near, far}) integral += determinant_at(corners, u, v, w) / 8;
        EXPECT_NEAR(volume_of(corners), integral, 1e-14);
    }
}

TEST(Quality, ProvesOnlyWhatIsPositiveEverywhere) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> offset(-0.6, 0.6), place(0, 1);
    int proved = 0, corners_alone_deceive = 0;
    for (int round = 0; round < 20000; ++round) {
        CellCorners corners = cube();
        for (Vec3& p : corners) p = p + Vec3{offset(random), offset(random), offset(random)};
        double least = 1e9;
        for (int sample = 0; sample < 60; ++sample)
            least = std::min(least, determinant_at(corners, place(random), place(random), place(random)));
        const bool is_proved = is_positive_everywhere(corners);
        proved += is_proved;
        if (is_proved) {
            ASSERT_GT(least, 0) << round;
        }
        corners_alone_deceive += scaled_jacobian(corners) > 0 && least < 0;
    }
    EXPECT_GT(proved, 500);
    EXPECT_GT(corners_alone_deceive, 3) << "cells whose corners look well and that fold inside must occur";
}

TEST(Quality, CountsCells) {
    mesh::HexMesh mesh;
    const CellCorners corners = cube();
    mesh.positions.assign(corners.begin(), corners.end());
    mesh.corners = {{0, 1, 2, 3, 4, 5, 6, 7}, {1, 0, 3, 2, 5, 4, 7, 6}};  // the second inside out
    const Quality quality = measure_quality(mesh);
    EXPECT_EQ(quality.least, -1);
    EXPECT_EQ(quality.mean, 0);
    EXPECT_EQ(quality.histogram[0], 1u);
    EXPECT_EQ(quality.histogram[9], 1u);
    EXPECT_EQ(quality.not_proved_positive, 1u);
}

}  // namespace
}  // namespace octavo::hexmesh
