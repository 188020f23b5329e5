// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <octavo/io/face_list.hpp>

// Which way the faces of a file look, for formats that do not say.
//
// The facets of TetGen's files have no sides. If they close, the space falls into regions, of which those with a hole
// point, and all that is outside, are empty; a face belongs to the solid's boundary when it has the solid on one side,
// and then it looks to the other. Without hole points the file says nothing about empty regions inside; then
// directions that agree among themselves are taken for meant, and cavities told from bodies by them.
//
// Across edges of more than two faces nothing is concluded, and an open or one-sided surface has no empty side: what is
// wrong with such is for validation to say.
// Cost: that of a triangulation, an edge table and shells: about 2 µs a face.

namespace octavo::io {

struct FaceDirections {
    std::size_t turned = 0;          ///< faces that now look the other way
    std::size_t inner = 0;           ///< faces with the solid, or none of it, on both sides: left out
    std::size_t lost_holes = 0;      ///< hole points outside of everything
    std::vector<bool> turns, drops;  ///< by face; empty when nothing is to be changed
};

/// What to do to the faces so that they look away from the solid.
FaceDirections directions_away_from_solid(std::span<const Vec3> vertices, const FaceList& faces,
                                          std::span<const Vec3> hole_points);

/// The list with these faces turned and left out.
FaceList with_directions(const FaceList& faces, const FaceDirections& directions);

}  // namespace octavo::io
