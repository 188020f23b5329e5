// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include <octavo/hexmesh/options.hpp>

// Sizes of cells in option values; none when the text is not of the form.

namespace octavo::cli {

/// FILE:SURFACE or FILE:SURFACE:INTERIOR.
struct FileSizes {
    std::string file;
    double surface = 0, interior = 0;
};
std::optional<FileSizes> parse_sizes(const std::string& text);

/// x0,y0,z0,x1,y1,z1:SIZE.
std::optional<hexmesh::BoxSize> parse_box(const std::string& text);

/// SIZE or SIZE:DEGREES.
std::optional<hexmesh::CurvatureSize> parse_curvature(const std::string& text);

}  // namespace octavo::cli
