// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/boolean/point_table.hpp>
#include <octavo/exact/sign.hpp>

// The points of the arrangement as the doubles that leave the library, and exact predicates on these.
//
// Problem: what rounding does to the surface must be told without rounding. Idea: each coordinate goes to the nearest
// double of world units, but to none finer than 2^-36 lattice units; so all of them are integers of 62 bits in that
// unit, what is written is what is tested, and predicates fit 192 bits.
// The nearest double is found from the lattice cell and the exact rest in it: a quotient of the whole numerator and
// weight is off by 2^-26 units far from the lattice's corner, although the world's origin, where doubles are fine, may
// be there.
// Cost: about 60 ns a constructed point; vertices of the soup are scaled when asked for.

namespace octavo::boolean {

class RoundedPoints {
  public:
    using Point = std::array<std::int64_t, 3>;
    static constexpr int fraction_bits = 36;

    /// Cancellation leaves points without a place.
    RoundedPoints(const Soup& soup, const PointTable& points, const Context& context = {});

    std::size_t size() const { return vertices_.size() + fixed_.size(); }
    Point operator[](PointId id) const {
        if (id >= vertices_.size()) return fixed_[id - vertices_.size()];
        const exact::Point at = vertices_[id];
        return {std::int64_t{at.x} << fraction_bits, std::int64_t{at.y} << fraction_bits,
                std::int64_t{at.z} << fraction_bits};
    }
    Vec3 world(PointId id) const;
    /// Whether the point has no place among the doubles, so that rounding has moved it.
    bool is_moved(PointId id) const { return id >= vertices_.size() && moved_[id - vertices_.size()] != 0; }
    /// No coordinate has moved farther, in world units.
    double largest_rounding() const { return largest_rounding_; }

    /// The distance from coordinate `axis` of a point to the doubles beside it.
    std::int64_t spacing(int axis, PointId id) const;
    /// Takes a point that has moved to another place, on doubles.
    void move(PointId id, Point to);

  private:
    /// How far the point moves at most, in lattice units.
    template <class P>
    double round(const P& point, exact::Point cell, std::size_t number);

    std::span<const exact::Point> vertices_;  ///< of the soup, which must stay
    exact::Lattice lattice_;
    std::vector<Point> fixed_;  ///< of constructed points
    std::vector<char> moved_;
    double largest_rounding_ = 0;
};

/// Rounding moves no coordinate of any point of a lattice farther, in lattice units.
double rounding_bound(const exact::Lattice& lattice);

/// The signs of exact::orient2d and exact::orient3d.
exact::Sign orient2d(int axis, const RoundedPoints::Point& p, const RoundedPoints::Point& q,
                     const RoundedPoints::Point& r);
exact::Sign orient3d(const RoundedPoints::Point& p, const RoundedPoints::Point& q,
                     const RoundedPoints::Point& r, const RoundedPoints::Point& s);

}  // namespace octavo::boolean
