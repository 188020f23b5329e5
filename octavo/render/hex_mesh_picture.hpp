// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>
#include <octavo/mesh/hex_mesh.hpp>
#include <octavo/render/image.hpp>

namespace octavo::render {

struct HexMeshPictureOptions {
    /// A number for each cell, shown as a colour, with a scale of the colours at the right (color_scale.hpp); without
    /// them cells have the colours of their solids.
    std::span<const double> values = {};
    int width = 1200, height = 900;  ///< in pixels
};

/// The mesh with the edges of its cells, in the middle of what the scale leaves free. Errors: bad_input for a mesh
/// without cells or a size outside the limits, limit, cancelled.
Result<Image> picture_of(const mesh::HexMesh& mesh, const HexMeshPictureOptions& options = {},
                         const Context& context = {});

}  // namespace octavo::render
