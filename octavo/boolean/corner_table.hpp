// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/base/uninitialised.hpp>
#include <octavo/mesh/mesh.hpp>

// The corners of triangles by the points that they are at.
//
// Threads share the work by ranges of points. Each looks at the blocks of triangles that have corners in its range,
// which are few where meshes are numbered in some order. Cost: one scattered write a corner.

namespace octavo::boolean {

/// A corner k of a triangle t as one number, 4 t + k.
struct CornerTable {
    std::vector<std::uint32_t> begin;            ///< per point, and one past the last
    UninitialisedVector<std::uint32_t> corners;  ///< those of a point ascend

    std::span<const std::uint32_t> at(std::size_t point) const {
        return {corners.data() + begin[point], begin[point + 1] - begin[point]};
    }
};

/// `points` is one more than the greatest corner may be; the first triangle has the number `first_number`.
CornerTable corners_by_point(std::span<const mesh::Triangle> triangles, std::uint32_t first_number,
                             std::size_t points, const Context& context);

}  // namespace octavo::boolean
