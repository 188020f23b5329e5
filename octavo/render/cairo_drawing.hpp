// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>
#include <octavo/render/drawing.hpp>

// Drawings through cairo: to PDF, and to pixels.

namespace octavo::render {

/// Writes one page of the drawing's size, a pixel being 3/4 of a point as in CSS, to the file `path`, which appears
/// whole or not at all, or to standard output when it is "-". No date goes in: the same drawing gives the same bytes.
/// Errors: io, cancelled.
Status write_pdf(const std::string& path, const Drawing& drawing, const Context& context = {});

/// The drawing in pixels, from 4 × 4 samples each, areas unsmoothed, so that no seams show between them.
/// Errors: limit when there is no memory for it, cancelled.
Result<Image> paint(const Drawing& drawing, const Context& context = {});

}  // namespace octavo::render
