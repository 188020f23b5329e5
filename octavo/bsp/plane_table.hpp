// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <octavo/exact/plane.hpp>

// The planes of a solid, each once.
//
// Problem: coplanar faces must be recognised as such, for ever, or a plane splits what lies in itself. Idea: a plane
// is stored without an orientation, with coprime coefficients and a positive first one, so that equal planes are
// equal bytes and get one number. What lies in it says which way it faces with one bit (Facing).
//
// Invariant: every plane goes through three lattice points, which are kept: 27 bits a coordinate say in
// a file what coefficients say in 240. No operation ever makes a plane from constructed points, so widths never grow
// (exact/bit_budget.hpp), however long a chain of operations is.
// Cost: about 0.4 µs an insertion, most of it divisors; 84 bytes a plane and 8 for the table.

namespace octavo::bsp {

using PlaneId = std::uint32_t;

/// A plane of the table and the way that a face in it looks.
struct Facing {
    std::uint32_t bits = 0;  ///< 2 · plane + 1 when the face looks against the plane's normal

    static constexpr Facing of(PlaneId plane, bool reversed) { return {plane << 1 | (reversed ? 1U : 0U)}; }
    constexpr PlaneId plane() const { return bits >> 1; }
    constexpr bool reversed() const { return bits & 1; }
    constexpr Facing opposite() const { return {bits ^ 1}; }
    friend constexpr auto operator<=>(Facing, Facing) = default;
};

class PlaneTable {
  public:
    using Points = std::array<exact::Point, 3>;

    PlaneTable() : slots_(64, none) {}

    /// The plane through three lattice points that are not collinear, and the way in which they run
    /// counter-clockwise.
    Facing add(exact::Point p, exact::Point q, exact::Point r);

    std::size_t size() const { return planes_.size(); }
    const exact::Plane& operator[](PlaneId id) const { return planes_[id]; }
    /// The points that it was made from, counter-clockwise seen from where its normal points.
    const Points& points(PlaneId id) const { return points_[id]; }

    std::size_t bytes() const {
        return planes_.capacity() * sizeof(exact::Plane) + points_.capacity() * sizeof(Points) +
               slots_.capacity() * sizeof(PlaneId);
    }

    static constexpr PlaneId most = PlaneId{1} << 30;  ///< planes that a table can hold

  private:
    static constexpr PlaneId none = ~PlaneId{0};
    void grow();

    std::vector<exact::Plane> planes_;
    std::vector<Points> points_;
    std::vector<PlaneId> slots_;
};

}  // namespace octavo::bsp
