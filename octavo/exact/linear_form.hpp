// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include <octavo/base/vec3.hpp>
#include <octavo/exact/counters.hpp>
#include <octavo/exact/lattice.hpp>
#include <octavo/exact/plane.hpp>

// The exact sign of a x + b y + c z + d 2^e at arbitrary finite doubles x, y, z: on which side of a lattice
// plane a query point lies that is on no lattice.
//
// Problem: a query point may have any exponent, so that neither snapping it nor dividing it by the lattice's
// unit is exact (both can over- or underflow). Idea: leave the point as it is and scale the plane's offset
// instead; it is an integer, so its exponent is free. A filter in doubles answers nearly always; the exact
// path is integer arithmetic on the mantissas.
//
// Filter, u = 2^-53: a, b, c and d round once each, a product once, the sum twice: off by at most 4u (1 + 4u)
// times |a x| + |b y| + |c z| + |d 2^e|, less than 6u times its computed value M. A product cannot underflow:
// an integer times a double below the normal range is an exact double there. The bound itself could, so the
// smallest normal number is added to it. Overflow makes M infinite, and no sum exceeds that: the exact path
// decides.
//
// Cost: about 3 ns by the filter, 75 ns exactly; no memory.

namespace octavo::exact {

class LinearForm {
  public:
    /// a x + b y + c z + d 2^exponent, with -1074 <= exponent <= 900; |d| < 2^120.
    LinearForm(std::int64_t a, std::int64_t b, std::int64_t c, int128 d, int exponent = 0);

    /// The plane of a lattice, as seen by world coordinates: positive where the plane is.
    static LinearForm of(const Lattice& lattice, const Plane& plane);

    /// The sign at a point with finite coordinates.
    Sign at(Vec3 p) const {
        const double ax = static_cast<double>(coefficients_[0]) * p.x;
        const double by = static_cast<double>(coefficients_[1]) * p.y;
        const double cz = static_cast<double>(coefficients_[2]) * p.z;
        const double sum = (ax + by) + (cz + offset_approximation_);
        const double magnitude =
            (std::fabs(ax) + std::fabs(by)) + (std::fabs(cz) + std::fabs(offset_approximation_));
        constexpr double six_u = 3 * 0x1p-52, smallest_normal = 0x1p-1022;
        if (std::fabs(sum) > six_u * magnitude + smallest_normal) [[likely]] {
            count_filtered(Predicate::linear_form);
            return sum > 0 ? Sign::positive : Sign::negative;
        }
        count_exact(Predicate::linear_form);
        return exact_at(p);
    }

    /// The exact path of `at`. It counts nothing.
    Sign exact_at(Vec3 p) const;

  private:
    std::array<std::int64_t, 3> coefficients_;
    double offset_approximation_;
    int128 offset_;
    int exponent_;
};

static_assert(sizeof(LinearForm) == 64, "one cache line");

}  // namespace octavo::exact
