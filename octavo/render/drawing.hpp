// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include <octavo/render/image.hpp>
#include <octavo/render/palette.hpp>

// A drawing: areas and lines in the plane of the picture, nothing hidden, nothing twice. What SVG, PDF and PNG are
// written from.
//
// Coordinates are whole hundredths of a pixel: finer than any printer, written in few characters, and equal where two
// areas share a border.

namespace octavo::render {

/// x to the right, y down.
struct DrawingPoint {
    std::int32_t x = 0, y = 0;
    friend constexpr auto operator<=>(DrawingPoint, DrawingPoint) = default;
};

inline constexpr int steps_of_pixel = 100;

using Polyline = std::vector<DrawingPoint>;

/// What of one colour is connected. Loops are closed without repeating their first point; the area is on one side of
/// all of them, so that holes run the other way round (the non-zero rule fills it).
struct Region {
    Color color;
    std::vector<Polyline> loops;
};

/// Lines of one colour; a closed one ends in the point that it begins with.
struct Strokes {
    Color color;
    std::vector<Polyline> lines;
};

struct Drawing {
    int width = 0, height = 0;  ///< in pixels
    Color background = palette::paper;
    std::vector<Region> regions;
    std::vector<Strokes> hidden;  ///< drawn thin and dashed, over the regions
    std::vector<Strokes> edges;   ///< drawn last
    double line_width = 1.2;      ///< of edges, in pixels
};

}  // namespace octavo::render
