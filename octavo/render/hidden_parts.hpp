// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>
#include <octavo/render/camera.hpp>
#include <octavo/render/drawing.hpp>
#include <octavo/render/patches.hpp>
#include <octavo/render/scene.hpp>

// Drawings with hidden parts removed: of any scene, and of BSP-octrees.
//
//   Scene ───────┐ order by octree and BSP   ┌ visible_parts ┐ pieces ─▶ regions_of ─▶ areas  ┐
//                ├───────▶ Patches ──────────┤               ├                                ├▶ Drawing
//   BspOctree ───┘         front to back     └───────────────┘ parts  ─▶ strokes_of ─▶ lines  ┘
//
// The other engine is the depth buffer of raster.hpp. It draws the same scenes to pixels and knows nothing of this one.

namespace octavo::render {

enum class HiddenLines : std::uint8_t { leave_out, dash };

struct DrawingOptions {
    int width = 1200, height = 900;  ///< in pixels, 1 to `largest_picture`
    double line_width = 1.2;         ///< in pixels
    HiddenLines hidden_lines = HiddenLines::leave_out;
    Color background = palette::paper;
};

/// Errors: bad_input for sizes outside the limits or a scene that is not finite, cancelled.
Result<Drawing> remove_hidden_parts(const Scene& scene, const Camera& camera, const DrawingOptions& options,
                                    const Context& context = {});

/// The same for patches that are sorted already, and lines that lie on them.
Result<Drawing> remove_hidden_parts(const Patches& patches, std::span<const Line> lines, const Camera& camera,
                                    const DrawingOptions& options, const Context& context = {});

}  // namespace octavo::render
