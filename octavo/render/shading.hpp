// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include <octavo/render/camera.hpp>
#include <octavo/render/image.hpp>

// How bright a face is: light comes from over the viewer's left shoulder and, weakly, from the right. Both engines
// (raster.hpp, hidden_parts.hpp) ask here, so that their pictures can be compared.

namespace octavo::render {

/// Where a closed surface is cut open, one sees the back of its farther side exactly where the solid was cut. Lit
/// evenly, those backs look like the cut itself.
inline constexpr float cap_light = 1;

/// For a unit normal that points towards the viewer.
inline float lightness(Vec3 normal, const Camera& camera) {
    const Vec3 towards = -camera.forward();
    const Vec3 key = towards + 0.9 * camera.up() - 0.6 * camera.right();
    const Vec3 fill = towards - 0.5 * camera.up() + 0.9 * camera.right();
    const double from_key = std::max(0.0, dot(normal, key) / length(key));
    const double from_fill = std::max(0.0, dot(normal, fill) / length(fill));
    return static_cast<float>(0.50 + 0.62 * from_key + 0.16 * from_fill);
}

inline Color shade(Color color, float light) {
    const auto channel = [&](float value) { return std::min(1.0F, value * light); };
    return {channel(color.red), channel(color.green), channel(color.blue)};
}

}  // namespace octavo::render
