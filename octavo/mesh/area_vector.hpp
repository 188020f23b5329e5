// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include <octavo/base/vec3.hpp>

// The direction and the size of a contour that need not be flat.

namespace octavo::mesh {

/// Normal times twice the area, after Newell; rounded.
inline Vec3 area_vector(std::span<const Vec3> contour) {
    Vec3 sum;
    for (std::size_t i = 1; i + 1 < contour.size(); ++i)
        sum = sum + cross(contour[i] - contour[0], contour[i + 1] - contour[0]);
    return sum;
}

}  // namespace octavo::mesh
