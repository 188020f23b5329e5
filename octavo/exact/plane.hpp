// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include <octavo/base/check.hpp>
#include <octavo/exact/bit_budget.hpp>
#include <octavo/exact/int128.hpp>
#include <octavo/exact/point.hpp>
#include <octavo/exact/sign.hpp>

// Oriented planes with integer coefficients: a x + b y + c z + d = 0, positive where the normal points.
//
// Orientation: the plane through p, q, r has the normal (q - p) x (r - p), so that p, q, r run
// counter-clockwise seen from its positive side; for a facet of a solid that is the outside.
//
// Invariant: |a|, |b|, |c| < 2^53 and |d| < 2^81 (bit_budget.hpp). Every plane through lattice points
// satisfies it; `from_coefficients` checks. Three collinear points give the degenerate plane, whose normal is
// zero.
//
// The 16-byte alignment of d leaves a hole of 8 bytes; it holds d as a double for the filters.

namespace octavo::exact {

class Plane {
  public:
    /// The degenerate plane: all coefficients are zero.
    constexpr Plane() = default;

    /// The plane through three lattice points; degenerate when they are collinear.
    static constexpr Plane through(Point p, Point q, Point r);

    /// Coordinate `axis` equals `coordinate`; positive where it is greater.
    static constexpr Plane across_axis(int axis, std::int32_t coordinate);

    /// The plane that holds p, q and the direction of `axis`: the edge as seen along that axis. A point is on
    /// its positive side when it lies to the left of the edge from p to q seen from the axis' far end,
    /// exactly as orient2d says. Degenerate when p and q lie on one parallel to the axis.
    static constexpr Plane along_axis(int axis, Point p, Point q);

    /// Any plane within the bit budget: |a|, |b|, |c| < 2^53, |d| < 2^81.
    static constexpr Plane from_coefficients(std::int64_t a, std::int64_t b, std::int64_t c, int128 d);

    constexpr std::int64_t a() const { return normal_[0]; }
    constexpr std::int64_t b() const { return normal_[1]; }
    constexpr std::int64_t c() const { return normal_[2]; }
    constexpr int128 d() const { return d_; }
    constexpr std::int64_t normal(int axis) const { return normal_[axis]; }
    constexpr double d_approximation() const { return d_approximation_; }  ///< the double nearest to d

    constexpr bool degenerate() const { return (a() | b() | c()) == 0; }
    constexpr Plane reversed() const { return {-a(), -b(), -c(), -d_}; }

    /// The axis along which the plane is seen best: that of the normal's greatest component, the first of
    /// equals.
    constexpr int dominant_axis() const;

    /// a x + b y + c z + d; |value| < 2^82.
    constexpr int128 value_at(Point p) const {
        static_assert(budget::side < 127);
        return wide(a()) * p.x + wide(b()) * p.y + wide(c()) * p.z + d_;
    }

    /// The same coefficients; planes that only have the same points differ. See `relation` and `primitive`.
    friend constexpr bool operator==(const Plane& first, const Plane& second) {
        return first.normal_ == second.normal_ && first.d_ == second.d_;
    }

  private:
    constexpr Plane(std::int64_t a, std::int64_t b, std::int64_t c, int128 d)
        : normal_{a, b, c}, d_approximation_(nearest_double(d)), d_(d) {}

    /// Both halves are exact doubles because |d| < 2^85, so there is one rounding; the compiler's own
    /// conversion handles all 128 bits and takes 6.7 ns instead of 1.8.
    static constexpr double nearest_double(int128 d) {
        static_assert(budget::offset <= 32 + 53);
        constexpr double two_to_32 = 4294967296.0;
        return static_cast<double>(static_cast<std::int64_t>(d >> 32)) * two_to_32 +
               static_cast<double>(static_cast<std::int64_t>(d & 0xffffffff));
    }

    std::array<std::int64_t, 3> normal_{};
    double d_approximation_ = 0;
    int128 d_ = 0;
};

static_assert(sizeof(Plane) == 48);

/// How two planes that are not degenerate lie to one another.
enum class PlaneRelation : std::uint8_t {
    crossing,      ///< they meet in a line
    parallel,      ///< no common point, normals the same way
    antiparallel,  ///< no common point, normals opposite
    same,          ///< the same points, normals the same way
    opposite,      ///< the same points, normals opposite
};

PlaneRelation relation(const Plane& first, const Plane& second);

/// The same plane and orientation with coprime coefficients: two planes are `same` exactly when their
/// primitive forms are equal, so it can be hashed and sorted.
Plane primitive(const Plane& plane);

/// A plane across an axis at a multiple of one half: coordinate `axis` equals `twice` / 2, positive where it
/// is greater. Octree cells and cuts that no lattice point can lie on; their predicates are cheaper than a
/// Plane's.
struct AxisPlane {
    int axis = 0;
    std::int32_t twice = 0;  ///< in [0, 2^27]

    constexpr Plane plane() const {
        return Plane::from_coefficients(axis == 0 ? 2 : 0, axis == 1 ? 2 : 0, axis == 2 ? 2 : 0,
                                        -int128{twice});
    }
};

constexpr Plane Plane::through(Point p, Point q, Point r) {
    // Differences are below 2^26, so a product is below 2^52 and int64 arithmetic is exact.
    static_assert(budget::normal < 63);
    const std::int64_t ux = q.x - p.x, uy = q.y - p.y, uz = q.z - p.z;
    const std::int64_t vx = r.x - p.x, vy = r.y - p.y, vz = r.z - p.z;
    const std::int64_t a = uy * vz - uz * vy, b = uz * vx - ux * vz, c = ux * vy - uy * vx;
    static_assert(budget::offset < 127);
    return {a, b, c, -(wide(a) * p.x + wide(b) * p.y + wide(c) * p.z)};
}

constexpr Plane Plane::across_axis(int axis, std::int32_t coordinate) {
    return {axis == 0 ? 1 : 0, axis == 1 ? 1 : 0, axis == 2 ? 1 : 0, -int128{coordinate}};
}

constexpr Plane Plane::along_axis(int axis, Point p, Point q) {
    const std::int64_t ux = q.x - p.x, uy = q.y - p.y, uz = q.z - p.z;
    const std::int64_t a = axis == 0 ? 0 : axis == 1 ? uz : -uy;
    const std::int64_t b = axis == 0 ? -uz : axis == 1 ? 0 : ux;
    const std::int64_t c = axis == 0 ? uy : axis == 1 ? -ux : 0;
    return {a, b, c, -(wide(a) * p.x + wide(b) * p.y + wide(c) * p.z)};
}

constexpr Plane Plane::from_coefficients(std::int64_t a, std::int64_t b, std::int64_t c, int128 d) {
    constexpr std::int64_t normal_limit = std::int64_t{1} << budget::normal;
    constexpr int128 offset_limit = int128{1} << budget::offset;
    OCTAVO_CHECK(-normal_limit < a && a < normal_limit && -normal_limit < b && b < normal_limit &&
                     -normal_limit < c && c < normal_limit,
                 "a plane's normal is out of the bit budget");
    OCTAVO_CHECK(-offset_limit < d && d < offset_limit, "a plane's offset is out of the bit budget");
    return {a, b, c, d};
}

constexpr int Plane::dominant_axis() const {
    const auto magnitude = [this](int axis) { return normal_[axis] < 0 ? -normal_[axis] : normal_[axis]; };
    const int axis = magnitude(1) > magnitude(0) ? 1 : 0;
    return magnitude(2) > magnitude(axis) ? 2 : axis;
}

}  // namespace octavo::exact
