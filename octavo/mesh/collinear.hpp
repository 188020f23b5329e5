// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include <octavo/base/vec3.hpp>

// Which points of a file lie on one line, and the range of numbers in which such questions have exact answers. What has
// no area in a file is for the file to say, not for the lattice, so the answer is that of the doubles (orient2d.hpp).

namespace octavo::mesh {

/// Brings coordinates into the range where orient2d is exact: by one power of two, which loses nothing. Only where they
/// span more than 2^980 the small ones become 0. False, and nothing is done, when one is not finite.
bool scale_for_orient2d(std::span<Vec3> positions);

/// Whether three points lie on one line, exactly but for what scale_for_orient2d says; not when one is not finite.
bool collinear(Vec3 a, Vec3 b, Vec3 c);

}  // namespace octavo::mesh
