// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <octavo/render/drawing.hpp>
#include <octavo/render/scene.hpp>
#include <octavo/render/visible.hpp>

// From parts of lines to strokes: what meets end to end, where nothing branches off, becomes one stroke, so that
// corners are joined and dashes run on. Parts that come twice are drawn once.

namespace octavo::render {

struct LineStrokes {
    std::vector<Strokes> visible, hidden;  ///< by colour
};

/// The strokes of a scene's lines, with what of them is hidden.
LineStrokes strokes_of(std::span<const Line> lines, std::span<const LinePart> hidden, const Camera& camera);

}  // namespace octavo::render
