// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include <octavo/base/result.hpp>
#include <octavo/base/vec3.hpp>
#include <octavo/exact/point.hpp>

// The integer lattice of one job: world = (origin + point) * unit, with a power-of-two unit and an integer
// origin.
//
// Problem: decisions in floating point contradict each other. Idea: round every input vertex once to a grid
// that all solids of the job share; from then on arithmetic is exact and bounded. Because the unit is a power
// of two and the origin a multiple of it, lattice → double is exact, and so is double → lattice for every
// input that already lies on the grid (short floats often do).
//
// Invariant: `fit` leaves at least one free unit on each side of the content, so that the half-open universe
// [0, 2^26)^3 strictly contains it. The content's longest side spans between 2^25 - 3 and 2^26 - 3 units, unless
// the content lies so far from the world's origin that doubles there are coarser; then the unit is the coarsest
// spacing of doubles in the content, and what the input could tell apart stays apart.
// Not guaranteed: detail finer than half a unit (1.5e-8 of the universe); SnapReport says what was moved.

namespace octavo::exact {

class Lattice {
  public:
    Lattice() = default;

    /// The finest lattice whose universe strictly contains `content`.
    /// Errors: bad_input when a bound is not finite; limit when the longest side is below 2^-975 (but not 0) or
    /// above 2^926.
    static Result<Lattice> fit(const Box3& content);

    /// A lattice with unit 2^exponent and this origin, in units; both as stored in a file. The origin must
    /// lie in [-2^53, 2^53 - 2^26 + 1] and the exponent in [-1000, 900], or bad_input comes back.
    static Result<Lattice> from_parts(int exponent, std::array<std::int64_t, 3> origin);

    double unit() const { return unit_; }
    int exponent() const { return exponent_; }
    const std::array<std::int64_t, 3>& origin() const { return origin_; }

    /// The nearest lattice point, ties to even. `p` must lie in the content that the lattice was fitted to.
    Point snap(Vec3 p) const;

    /// The unit cell that holds a world position, exactly: cell <= p < cell + 1 in units, in each coordinate.
    /// None when the position lies outside the universe or is not a number.
    std::optional<Point> cell_at(Vec3 p) const;

    /// The world position of a lattice point; exact.
    Vec3 to_world(Point p) const {
        return {static_cast<double>(origin_[0] + p.x) * unit_, static_cast<double>(origin_[1] + p.y) * unit_,
                static_cast<double>(origin_[2] + p.z) * unit_};
    }

    friend bool operator==(const Lattice&, const Lattice&) = default;

  private:
    double unit_ = 1;
    int exponent_ = 0;
    std::array<std::int64_t, 3> origin_{};
};

}  // namespace octavo::exact
