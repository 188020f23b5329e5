// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>
#include <octavo/render/camera.hpp>
#include <octavo/render/convex.hpp>
#include <octavo/render/patches.hpp>

// What of patches and lines can be seen: hidden parts removed, in the plane of the picture.
//
// The picture is divided into squares, and these into four, until few patches touch a square; what lies behind a patch
// that covers a square is dropped on the way. In a square, the area that nothing covers yet is a set of convex
// polygons, the square itself at first. Patch by patch from the front, what of it lies in the patch is a visible piece,
// and the rest goes on. So pieces never overlap, and together they are all that the patches cover, by construction: a
// wrong answer is impossible, rounding moves borders by 10^-8 pixels.
//
// A line is hidden where it lies in a patch, in the picture, and behind its plane by more than `tolerance` units of the
// lattice; the order of patches is not needed for it. What has no area can lie in a face and must not vanish there.
// Cost: about 2 µs a patch and square. Source: the subdivision is Warnock's (1969), the order that of BSP trees.

namespace octavo::render {

struct WorldLine {
    Vec3 from, to;
};

/// A visible part of a patch: a convex polygon.
struct Piece {
    std::uint32_t patch = 0;
    std::uint32_t begin = 0, count = 0;  ///< corners
};

/// A part of a line, in shares of its way in the picture.
struct LinePart {
    std::uint32_t line = 0;
    double from = 0, to = 1;
};

struct Visible {
    std::vector<Point2> corners;
    std::vector<Piece> pieces;
    std::vector<LinePart> hidden;  ///< by line, from its start to its end, not overlapping

    std::span<const Point2> corners_of(const Piece& piece) const {
        return {corners.data() + piece.begin, piece.count};
    }
};

/// For a picture of `width` × `height` pixels. Error: cancelled.
Result<Visible> visible_parts(const Patches& patches, std::span<const WorldLine> lines, const Camera& camera,
                              int width, int height, const Context& context = {});

}  // namespace octavo::render
