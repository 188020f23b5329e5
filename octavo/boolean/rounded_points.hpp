// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <octavo/boolean/point_table.hpp>
#include <octavo/exact/sign.hpp>

// The points of the arrangement as the doubles that leave the library, and exact predicates on these.
//
// Idea: every point is rounded to a finer lattice of 2^-26 units (coarser where doubles so far from the origin are): its
// coordinates are integers of 52 bits that a double of world units holds exactly. So what is written is what is
// tested, and what rounding did to the surface can be told without rounding.
// Cost: about 20 ns a constructed point; lattice points are only scaled.

namespace octavo::boolean {

class RoundedPoints {
  public:
    using Point = std::array<std::int64_t, 3>;

    RoundedPoints(const Soup& soup, const PointTable& points);

    std::size_t size() const { return fixed_.size(); }
    const Point& operator[](PointId id) const { return fixed_[id]; }
    Vec3 world(PointId id) const;
    /// The nearest lattice point.
    exact::Point nearest(PointId id) const;
    /// Whether the point was not a lattice point, so that rounding has moved it.
    bool is_moved(PointId id) const { return moved_[id] != 0; }
    /// No coordinate has moved farther, in world units.
    double largest_rounding() const { return largest_rounding_; }

  private:
    std::vector<Point> fixed_;
    std::vector<char> moved_;
    std::array<std::int64_t, 3> origin_;
    int fraction_bits_ = 0;
    double unit_ = 1, largest_rounding_ = 0;
};

/// The signs of exact::orient2d and exact::orient3d.
exact::Sign orient2d(int axis, const RoundedPoints::Point& p, const RoundedPoints::Point& q,
                     const RoundedPoints::Point& r);
exact::Sign orient3d(const RoundedPoints::Point& p, const RoundedPoints::Point& q,
                     const RoundedPoints::Point& r, const RoundedPoints::Point& s);

}  // namespace octavo::boolean
