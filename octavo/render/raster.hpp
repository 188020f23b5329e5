// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/base/context.hpp>
#include <octavo/render/camera.hpp>
#include <octavo/render/image.hpp>
#include <octavo/render/picture_size.hpp>
#include <octavo/render/scene.hpp>

// A scene drawn by depth buffer.
//
// Each facet is filled at `samples` × `samples` sub-pixels with a depth test; lines are tested against the same depths
// with a small bias towards the viewer, so that an edge is not hidden by its own facets; the samples are averaged at
// the end. Light comes from over the viewer's left shoulder and, weakly, from the right. Facets seen from behind
// take their back colour, flat when the scene is cut, so that a closed surface looks capped there; the cap is outlined.
// Cost: facets + covered samples; memory: 20 bytes a sample.

namespace octavo::render {

struct DrawOptions {
    int width = 1200, height = 900;  ///< in pixels, 1 to `largest_picture`
    int samples = 3;                 ///< per pixel and direction, 1 to 8
    double line_width = 1.2;         ///< in pixels
    /// World points with position[cut_axis] beyond this are not drawn.
    double cut_at = Box3::infinity;
    int cut_axis = 0;
    bool outline_cap = true;  ///< a line round what was cut through
    Color background = palette::paper;
};

/// Errors: bad_input for sizes outside the limits, cancelled.
Result<Image> draw(const Scene& scene, const Camera& camera, const DrawOptions& options,
                   const Context& context = {});

}  // namespace octavo::render
