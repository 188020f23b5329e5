// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include <octavo/base/vec3.hpp>
#include <octavo/exact/point.hpp>

// A half space of the lattice, with integer coefficients: the points with a x + b y + c z + d >= 0.
//
// Flat primitives are put on the lattice by their planes: the largest component of the normal becomes ±2^34 and
// the others are rounded to that scale, the offset is rounded to 1/256 of a lattice unit, and to whole units when
// the plane is normal to an axis. That is the only rounding; it moves the plane by less than 1/64 of a unit
// inside the universe (half a unit when normal to an axis, as any vertex would be moved). From then on every sign
// is one 64-bit integer sum, and two faces that lie in one plane nearly always have the same four integers,
// whatever products of matrices they came from.
//
// Bits: |a|, |b|, |c| <= 2^34 and coordinates <= 2^26 give |a x + b y + c z| <= 3 · 2^60; |d| <= 2^62; the sum is
// below 7 · 2^60 < 2^63.

namespace octavo::csg {

struct LatticePlane {
    std::array<std::int64_t, 3> normal{};
    std::int64_t offset = 0;

    static constexpr int normal_bits = 34;
    static constexpr int offset_bits = 62;
    static_assert((std::int64_t{3} << (normal_bits + exact::coordinate_bits)) <=
                      (std::int64_t{1} << 62) - 1 +
                          ((std::int64_t{1} << 62) - (std::int64_t{1} << offset_bits)),
                  "the sum of three products and an offset fits 64 bits");

    /// Positive in the half space, zero on the plane. Coordinates in [0, 2^26].
    std::int64_t at(std::int32_t x, std::int32_t y, std::int32_t z) const {
        return normal[0] * x + normal[1] * y + normal[2] * z + offset;
    }
    LatticePlane flipped() const { return {{-normal[0], -normal[1], -normal[2]}, -offset}; }

    friend bool operator==(const LatticePlane&, const LatticePlane&) = default;
};

/// Whether two planes are one up to the rounding that put them on the lattice, with equal (1) or opposite (-1)
/// sides; 0 when they differ.
int same_plane(const LatticePlane& a, const LatticePlane& b);

/// The half space of the points p with normal · (p − through) >= 0, both in lattice coordinates. When the plane
/// misses the universe by far, `plane` is empty and `whole` says whether the half space holds all of it.
struct SnappedPlane {
    std::optional<LatticePlane> plane;
    bool whole = false;
};
SnappedPlane snap_plane(Vec3 normal, Vec3 through);
/// The same of the points with normal · p + offset >= 0.
SnappedPlane snap_plane(const std::array<long double, 3>& normal, long double offset);

}  // namespace octavo::csg
