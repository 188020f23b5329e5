// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <octavo/hexmesh/build.hpp>

namespace octavo::hexmesh {
namespace {

using mesh::Mesh;
using mesh::VertexIndex;

/// Half of the box [0, 8]² × [0, 4], cut off along the diagonal, which halves cells of side 1 exactly. The flat face
/// there has n · n random vertices.
Mesh wedge(std::uint32_t seed, std::size_t n) {
    std::mt19937 random(seed);
    const auto dyadic = [&](double low, double high) {
        return std::round(1024 * std::uniform_real_distribution<double>(low, high)(random)) / 1024;
    };
    const auto cuts = [&](double end) {
        std::vector<double> at{0};
        for (std::size_t i = 0; i < n; ++i) at.push_back(dyadic(0.2, end - 0.2));
        std::sort(at.begin(), at.end());
        at.push_back(end);
        return at;
    };
    const std::vector<double> across = cuts(8), up = cuts(4);
    const std::size_t last = n + 1;
    Mesh mesh;
    const auto vertex = [&](std::size_t i, std::size_t k) {
        return static_cast<VertexIndex>(i * (n + 2) + k);
    };
    for (std::size_t i = 0; i <= last; ++i)
        for (std::size_t k = 0; k <= last; ++k) {
            const bool is_inner = i > 0 && i < last && k > 0 && k < last;
            const double s = across[i] + (is_inner ? dyadic(-0.01, 0.01) : 0);
            mesh.vertices.push_back({8 - s, s, up[k] + (is_inner ? dyadic(-0.01, 0.01) : 0)});
        }
    const auto low = static_cast<VertexIndex>(mesh.vertices.size()), high = low + 1;
    mesh.vertices.push_back({0, 0, 0});
    mesh.vertices.push_back({0, 0, 4});
    for (std::size_t i = 0; i < last; ++i) {
        for (std::size_t k = 0; k < last; ++k) {
            mesh.triangles.push_back({vertex(i, k), vertex(i + 1, k), vertex(i + 1, k + 1)});
            mesh.triangles.push_back({vertex(i, k), vertex(i + 1, k + 1), vertex(i, k + 1)});
        }
        mesh.triangles.push_back({low, vertex(i + 1, 0), vertex(i, 0)});
        mesh.triangles.push_back({high, vertex(i, last), vertex(i + 1, last)});
        mesh.triangles.push_back({low, vertex(0, i), vertex(0, i + 1)});
        mesh.triangles.push_back({high, vertex(last, i + 1), vertex(last, i)});
    }
    mesh.triangles.push_back({low, vertex(0, last), high});
    mesh.triangles.push_back({high, vertex(last, 0), low});
    return mesh;
}

TEST(KeepHalf, TakesCellsThatAreExactlyHalfFilledHoweverTheSurfaceIsCutIntoTriangles) {
    std::size_t not_half = 0;
    for (const std::size_t n : {0, 1, 3, 7, 12})
        for (std::uint32_t seed = 0; seed < 4; ++seed) {
            const Mesh solid = wedge(seed, n);
            const Result<Built> built =
                build(std::span(&solid, 1), {.precision = 1, .largest = 1, .keep = Keep::half});
            ASSERT_TRUE(built) << built.error().describe();
            EXPECT_EQ(built->mesh.cell_count(), 144u) << "seed " << seed << ", " << n << " cuts";
            for (const double fraction : built->mesh.fractions) {
                EXPECT_NEAR(fraction, 0.5, 1e-12);
                not_half += fraction != 0.5;
            }
        }
    EXPECT_GT(not_half, 0u) << "sums are rounded, or this tests nothing";
}

TEST(KeepHalf, LeavesCellsOutThatAreHardlyLessThanHalfFilled) {
    // The diagonal moved inwards by 2^-18 of a cell.
    Mesh solid = wedge(1, 5);
    for (Vec3& vertex : solid.vertices)
        if (vertex.x != 0 || vertex.y != 0)
            vertex = {vertex.x * (1 - 0x1p-18), vertex.y * (1 - 0x1p-18), vertex.z};
    const Result<Built> built =
        build(std::span(&solid, 1), {.precision = 1, .largest = 1, .keep = Keep::half});
    ASSERT_TRUE(built) << built.error().describe();
    EXPECT_EQ(built->mesh.cell_count(), 28u * 4);
}

}  // namespace
}  // namespace octavo::hexmesh
