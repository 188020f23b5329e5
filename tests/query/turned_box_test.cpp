// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include <octavo/query/turned_box.hpp>

namespace octavo::query {
namespace {

/// A place along the axes of a box, in steps.
Vec3 along_axes(const TurnedBox& box, Vec3 place, double step) {
    Vec3 along;
    for (int k = 0; k < 3; ++k) {
        const auto& axis = box.axes[static_cast<std::size_t>(k)];
        along[k] = (axis[0] * place.x + axis[1] * place.y + axis[2] * place.z) / TurnedBox::unit / step;
    }
    return along;
}

/// Patches of few triangles round a plane, thinner and thinner, some of them slivers or without area.
mesh::LatticeMesh patch(unsigned seed, std::int32_t size) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1, 1);
    mesh::LatticeMesh mesh;
    const Vec3 u{unit(random), unit(random), unit(random)}, v{unit(random), unit(random), unit(random)},
        n = cross(u, v);
    const double thickness = std::pow(0.2, seed % 8), half = 0.5 * size;
    for (unsigned i = 0; i < 9; ++i) {
        const Vec3 p = unit(random) * u + unit(random) * v + thickness * unit(random) * n;
        const auto coordinate = [&](double x) { return static_cast<std::int32_t>(half + 0.15 * x * half); };
        mesh.points.push_back({coordinate(p.x), coordinate(p.y), coordinate(p.z)});
    }
    const auto any = [&] { return static_cast<mesh::VertexIndex>(random() % 9); };
    for (unsigned i = 0; i < 8; ++i) mesh.triangles.push_back({any(), any(), seed % 5 == 0 ? 0 : any()});
    return mesh;
}

TEST(TurnedBox, HoldsItsPatchAndIsNeverFartherThanIt) {
    std::mt19937 random(31);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (unsigned seed = 0; seed < 400; ++seed) {
        const std::int32_t size = 1 << (3 + seed % 24);
        const mesh::LatticeMesh mesh = patch(seed, size);
        std::vector<mesh::FaceIndex> faces(mesh.triangles.size());
        std::iota(faces.begin(), faces.end(), 0U);
        const std::array<std::int32_t, 3> origin{size / 2, size / 2, size / 2};
        const double step = (size / 2 + 1) / TurnedBox::reach;
        const TurnedBox box = TurnedBox::round(mesh, faces, origin, step);
        const Vec3 far{unit(random) * 3 * size, unit(random) * 3 * size, unit(random) * 3 * size};
        const Vec3 far_along = along_axes(box, far, step);
        double gap = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double x = far_along[static_cast<int>(k)];
            gap += std::pow(std::max({box.low[k] - x, x - box.high[k], 0.0}) * step, 2);
        }
        for (const mesh::Triangle& t : mesh.triangles)
            for (const mesh::VertexIndex vertex : t) {
                const exact::Point p = mesh.points[vertex];
                const Vec3 place{static_cast<double>(p.x - origin[0]), static_cast<double>(p.y - origin[1]),
                                 static_cast<double>(p.z - origin[2])};
                const Vec3 along = along_axes(box, place, step);
                for (std::size_t k = 0; k < 3; ++k) {
                    ASSERT_LE(box.low[k] + 0.99 * TurnedBox::slack, along[static_cast<int>(k)]) << seed;
                    ASSERT_GE(box.high[k] - 0.99 * TurnedBox::slack, along[static_cast<int>(k)]) << seed;
                }
                ASSERT_LE(std::sqrt(gap) * (1 - 1e-4), length(far - place)) << seed;
            }
    }
}

TEST(TurnedBox, LiesOnASlantingPatch) {
    // A flat square across a diagonal: the box along the axes is a cube, a turned one is flat.
    mesh::LatticeMesh mesh;
    mesh.points = {{0, 0, 0}, {1000, 0, 1000}, {1000, 1000, 2000}, {0, 1000, 1000}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    const std::vector<mesh::FaceIndex> faces{0, 1};
    const TurnedBox box = TurnedBox::round(mesh, faces, {500, 500, 1000}, 1);
    std::int32_t thinnest = 1 << 20;
    for (std::size_t k = 0; k < 3; ++k) thinnest = std::min<std::int32_t>(thinnest, box.high[k] - box.low[k]);
    EXPECT_LE(thinnest, 4);
}

}  // namespace
}  // namespace octavo::query
