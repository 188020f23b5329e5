// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <octavo/bp_octree/direction.hpp>
#include <octavo/bp_octree/polytope.hpp>

// A bounding plane in 28 bits: a direction u and an offset, in the coordinates of its cell, [0, 65536]^3:
//
//     u · x <= 2048 · offset − 65536 · N          N = sum of |negative components of u|
//
// so that offset 0 is the corner of the cell that lies farthest back and 4064 the one farthest ahead (12 bits). Offsets
// are rounded up, that is outwards, when a plane is made; everything that is certified is the rounded plane.

namespace octavo::bp_octree {

inline constexpr std::int32_t offset_step = 2048;
inline constexpr std::int32_t largest_offset = direction_length * 65536 / offset_step;

struct BoundingPlane {
    DirectionCode direction = 0;
    std::uint16_t offset = 0;

    /// The least plane of this direction that lets u · x reach `reach`.
    static BoundingPlane at(Direction u, std::int32_t reach) {
        const std::int32_t from_back = reach + 65536 * (direction_length - positive_part(u));
        const std::int32_t steps = (from_back + offset_step - 1) / offset_step;
        return {code_of(u), static_cast<std::uint16_t>(steps < 0                ? 0
                                                       : steps > largest_offset ? largest_offset
                                                                                : steps)};
    }

    /// The bound on u · x.
    std::int32_t reach() const {
        const Direction u = direction_of(direction);
        return offset_step * offset - 65536 * (direction_length - positive_part(u));
    }
    HalfSpace half_space() const {
        const Direction u = direction_of(direction);
        return {{static_cast<double>(u.a), static_cast<double>(u.b), static_cast<double>(u.c)},
                static_cast<double>(reach())};
    }
    friend bool operator==(const BoundingPlane&, const BoundingPlane&) = default;
};

static_assert(sizeof(BoundingPlane) == 4);
static_assert(largest_offset < 4096, "12 bits in the file");

}  // namespace octavo::bp_octree
