// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>
#include <octavo/render/drawing.hpp>

// SVG 1.1: groups `faces`, `hidden-lines` and `edges`, in them a group for each colour, one path a region or stroke,
// coordinates as short as they can be. Written directly: what cairo writes has no groups, and several times the bytes.

namespace octavo::render {

/// Writes to the file `path`, which appears whole or not at all, or to standard output when it is "-". The same drawing
/// gives the same bytes. Errors: io, cancelled.
Status write_svg(const std::string& path, const Drawing& drawing, const Context& context = {});

}  // namespace octavo::render
