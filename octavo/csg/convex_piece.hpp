// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <octavo/base/vec3.hpp>

// A convex body as corners and faces in doubles, which can be cut by planes.
//
// For constructions (hulls, sums, shadows), not for decisions: a corner nearer to a cutting plane than a 2^-36th of
// the body's surroundings counts as on it, so that repeated cuts by the planes of one facet do not shave slivers.

namespace octavo::csg {

struct Cut {
    Vec3 normal;  ///< of length one
    double offset = 0;

    double height(Vec3 p) const { return dot(normal, p) - offset; }
};

struct ConvexPiece {
    std::vector<Vec3> corners;
    std::vector<std::vector<std::uint32_t>> faces;  ///< counter-clockwise seen from outside

    static ConvexPiece box(const Box3& box);
    bool empty() const { return faces.size() < 4; }
    Vec3 middle() const;
};

/// The part with height <= 0. `tolerance` is the height that counts as zero.
ConvexPiece below(const ConvexPiece& piece, const Cut& cut, double tolerance);
/// The part with height >= 0.
inline ConvexPiece above(const ConvexPiece& piece, const Cut& cut, double tolerance) {
    return below(piece, {-cut.normal, -cut.offset}, tolerance);
}

}  // namespace octavo::csg
