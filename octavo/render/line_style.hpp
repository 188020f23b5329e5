// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

// How drawings are drawn, whatever they are written to. Widths in pixels.

namespace octavo::render::line_style {

/// Viewers smooth each area for itself, so that the paper shines through where two meet. A stroke in the area's own
/// colour closes the seam: half a pixel on either side is what it takes for no paper to be left in any pixel (a quarter
/// leaves 6 %), and lines cover as much at silhouettes.
inline constexpr double seam_width = 1;

/// Of a hidden line, as a share of a visible one's, and its dashes and gaps, in widths of a visible line.
inline constexpr double hidden_share = 0.6;
inline constexpr std::array<double, 2> dashes{3.5, 2.5};

}  // namespace octavo::render::line_style
