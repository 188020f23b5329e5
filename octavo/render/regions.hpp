// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <octavo/render/drawing.hpp>
#include <octavo/render/visible.hpp>

// From visible pieces to regions: connected pieces of one colour become one area.
//
// Faces come in many pieces, cut by octants, by planes of trees and by squares of the picture. Their borders are rings
// of directed edges. An edge is first cut at all corners of its colour that lie on it, within a step of rounding. Then
// equal edges that run opposite ways cancel, and join the two pieces; what is left are the borders of regions. Edges
// that rounding keeps from cancelling do no harm: rings stay rings, and the area inside them is what it was.
// Cost: about 1 µs a piece.

namespace octavo::render {

/// The regions of `visible`, whose patches have these colours, each as it is displayed (in 256 steps a channel).
/// Regions come sorted by colour.
std::vector<Region> regions_of(const Visible& visible, std::span<const Patch> patches);

}  // namespace octavo::render
