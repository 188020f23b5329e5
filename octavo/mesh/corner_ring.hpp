// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <octavo/mesh/orient2d.hpp>

// A plane polygon as one ring of corners with its inside on the left, ready for clipping ears. Holes are
// joined to the outer contour by bridges: a corner of the hole and a corner that sees it are both doubled,
// and the ring runs over the bridge once in either direction (D. Eberly, "Triangulation by ear clipping",
// 2002). The ring then touches itself but nowhere crosses itself.
//
// All choices are made with exact orientation signs. Eberly compares where a horizontal ray hits edges; here
// two edges on the ray are compared by orientations alone, which needs no intersection point.

namespace octavo::mesh {

struct RingCorner {
    Point2 position;
    std::uint32_t corner = 0;  ///< number of the corner in the input
    std::uint32_t previous = 0, next = 0;
};

struct CornerRing {
    std::vector<RingCorner> nodes;  ///< every one is on the ring
    std::uint32_t start = 0;
};

/// The ring of the contours, which are corners [contour_begin[c], contour_begin[c + 1]); the first is the
/// outer one and must run counter-clockwise. Holes may run either way. Near-linear where holes are spread out. `ring`
/// is refilled, so that its memory can be used again.
void build_ring(std::span<const Point2> positions, std::span<const std::uint32_t> contour_begin,
                CornerRing& ring);

}  // namespace octavo::mesh
