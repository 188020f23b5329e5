// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

// Colours and pictures in memory: what drawing makes and files take.

namespace octavo::render {

/// Red, green and blue in [0, 1], as displayed (sRGB).
struct Color {
    float red = 0, green = 0, blue = 0;
    friend bool operator==(const Color&, const Color&) = default;
};

inline Color mix(Color a, Color b, float share_of_b) {
    const auto channel = [&](float from, float to) { return from + (to - from) * share_of_b; };
    return {channel(a.red, b.red), channel(a.green, b.green), channel(a.blue, b.blue)};
}

/// Rows from the top, `width` pixels each.
struct Image {
    int width = 0, height = 0;
    std::vector<Color> pixels;

    Color& at(int column, int row) { return pixels[static_cast<std::size_t>(row) * width + column]; }
    const Color& at(int column, int row) const {
        return pixels[static_cast<std::size_t>(row) * width + column];
    }
};

}  // namespace octavo::render
