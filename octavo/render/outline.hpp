// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/render/drawing.hpp>

// Loops and lines with no more points than one can see.

namespace octavo::render {

/// The loop without points that lie, within rounding, on the way from the point before to the point after them.
Polyline without_needless_points(const Polyline& loop);

/// The same of a line, which keeps its ends.
Polyline line_without_needless_points(const Polyline& line);

/// Whether a loop encloses enough to be drawn: a 200th of a square pixel.
bool has_area(const Polyline& loop);

}  // namespace octavo::render
