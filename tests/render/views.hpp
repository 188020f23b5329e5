// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <octavo/render/scene.hpp>

// Views and scenes for the tests of drawings.

namespace octavo::tests {

/// From everywhere, also along axes and through planes of what is drawn; orthographic and not.
inline std::vector<render::View> all_views() {
    std::vector<render::View> views;
    for (const double perspective : {0.0, 35.0, 100.0})
        for (const auto& [azimuth, elevation] :
             {std::pair{35.0, 25.0}, {0.0, 0.0}, {90.0, 0.0}, {45.0, 0.0}, {-120.0, 90.0}, {200.0, -60.0}})
            views.push_back({azimuth, elevation, perspective, 0.04});
    return views;
}

/// Some of them, for what takes time.
inline std::vector<render::View> few_views() {
    return {{}, {150, -20, 50, 0.04}, {0, 0, 0, 0.04}, {0, 90, 70, 0.04}};
}

inline render::Camera camera_for(const render::Scene& scene, const render::View& view, int width,
                                 int height) {
    const Result<render::Camera> camera = render::Camera::look_at(scene.corners(), view, width, height);
    EXPECT_TRUE(camera);
    return *camera;
}

/// Triangles that cross one another, of any size and direction; some in common planes.
inline render::Scene random_facets(std::size_t count, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> place(-1, 1);
    render::Scene scene;
    for (std::size_t i = 0; i < count; ++i) {
        const double size = i % 3 ? 0.4 : 1.2;
        const Vec3 centre{place(random), place(random), place(random)};
        render::Facet facet;
        for (Vec3& corner : facet.corners)
            corner = centre + size * Vec3{place(random), place(random), i % 4 ? place(random) : 0.0};
        if (i % 4 == 0)
            for (Vec3& corner : facet.corners) corner.z = std::round(2 * centre.z) / 2;
        scene.facets.push_back(facet);
    }
    return scene;
}

}  // namespace octavo::tests
