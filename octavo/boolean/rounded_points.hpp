// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/boolean/point_table.hpp>
#include <octavo/exact/sign.hpp>

// The points of the arrangement as the numbers that leave the library, doubles or floats, and exact predicates on
// these.
//
// Problem: what rounding does to the surface must be told without rounding. Idea: each coordinate goes to the nearest
// double of world units, but to none finer than 2^-36 lattice units (2^-24 for floats); so all of them are integers of
// 62 bits in that unit, what is written is what is tested, and predicates fit 192 bits. Floats are coarser than the
// lattice where it reaches past 2^24 units from the world's origin, so vertices of the soup may move too. Where they
// are coarser than 2^-14 of the lattice they hold no shape. The nearest double is found from the lattice cell and the
// exact rest in it: a quotient of the whole numerator and weight is off by 2^-26 units far from the lattice's corner,
// although the world's origin, where doubles are fine, may be there. Cost: about 60 ns a constructed point; vertices of
// the soup are scaled when asked for.

namespace octavo::boolean {

/// What coordinates of a result are rounded to.
enum class Numbers : std::uint8_t { doubles, floats };

class RoundedPoints {
  public:
    using Point = std::array<std::int64_t, 3>;
    static constexpr int fraction_bits = 36;

    /// `numbers` must hold shapes on the soup's lattice. Cancellation leaves points without a place.
    RoundedPoints(const Soup& soup, const PointTable& points, Numbers numbers = Numbers::doubles,
                  const Context& context = {});

    Numbers numbers() const { return numbers_; }
    std::size_t size() const { return first_ + fixed_.size(); }
    Point operator[](PointId id) const {
        if (id >= first_) return fixed_[id - first_];
        const exact::Point at = vertices_[id];
        return {std::int64_t{at.x} << fraction_bits, std::int64_t{at.y} << fraction_bits,
                std::int64_t{at.z} << fraction_bits};
    }
    Vec3 world(PointId id) const;
    /// Whether the point has no place among the numbers, so that rounding has moved it.
    bool is_moved(PointId id) const { return id >= first_ && moved_[id - first_] != 0; }
    /// Whether that may be so of vertices of the soup.
    bool moves_vertices() const { return first_ < vertices_.size(); }
    /// No coordinate has moved farther, in world units.
    double largest_rounding() const { return largest_rounding_; }

    /// The distance from coordinate `axis` of a point to the numbers beside it.
    std::int64_t spacing(int axis, PointId id) const;
    /// Takes a point that has moved to another place, on such numbers.
    void move(PointId id, Point to);

  private:
    bool is_place(exact::Point point) const;
    /// How far the point moves at most, in lattice units. `number` is its place in `fixed_`.
    double round(exact::Point point, std::size_t number);
    template <class P>
    double round(const P& point, exact::Point cell, std::size_t number);

    std::span<const exact::Point> vertices_;  ///< of the soup, which must stay
    exact::Lattice lattice_;
    Numbers numbers_;
    PointId first_;             ///< before it all points are vertices that stay where they are
    std::vector<Point> fixed_;  ///< from there on
    std::vector<char> moved_;
    double largest_rounding_ = 0;
};

/// Whether the numbers are fine enough all over the lattice for results to be rounded to them.
bool hold_shapes(const exact::Lattice& lattice, Numbers numbers);

/// Rounding moves no coordinate of any point of a lattice farther, in lattice units.
double rounding_bound(const exact::Lattice& lattice, Numbers numbers);

/// The signs of exact::orient2d and exact::orient3d.
exact::Sign orient2d(int axis, const RoundedPoints::Point& p, const RoundedPoints::Point& q,
                     const RoundedPoints::Point& r);
exact::Sign orient3d(const RoundedPoints::Point& p, const RoundedPoints::Point& q,
                     const RoundedPoints::Point& r, const RoundedPoints::Point& s);

}  // namespace octavo::boolean
