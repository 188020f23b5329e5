// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include <octavo/base/vec3.hpp>
#include <octavo/exact/bit_budget.hpp>
#include <octavo/exact/point.hpp>
#include <octavo/exact/wide_int.hpp>

// Exact points that are no lattice points: (x/w, y/w, z/w) with integer x, y, z, w.
//
// Two kinds, by how they came about, because one is half as wide as the other:
//   EdgePoint    where a lattice edge (two lattice points) meets a plane      109 and 81 bits,  88 bytes
//   TriplePoint  where three planes meet, or the line of two meets a third    190 and 162 bits, 120 bytes
// Only these are ever constructed. A point must not be built from constructed points (no midpoints, no planes
// through them): widths would grow without bound. Cut with planes of lattice points instead.
//
// Invariant: w > 0, so that no predicate asks for its sign. Each coordinate x/w is kept as a double too, with
// a relative error of at most 4u (u = 2^-53): one rounding of x, one of w, one of the quotient, so that (1 +
// u)^2 / (1 - u) <= 1 + 4u. That is what the filters work with; nothing underflows, since |x| >= 1 or x = 0
// and w < 2^162.

namespace octavo::exact {

template <int NumeratorBits, int WeightBits>
class HomogeneousPoint {
  public:
    static constexpr int numerator_bits = NumeratorBits, weight_bits = WeightBits;
    using Numerator = WideInt<budget::limbs(NumeratorBits)>;
    using Weight = WideInt<budget::limbs(WeightBits)>;

    /// The origin.
    constexpr HomogeneousPoint() : weight_(1) {}

    /// (x/w, y/w, z/w); w must not be zero, it may be negative.
    constexpr HomogeneousPoint(const Numerator& x, const Numerator& y, const Numerator& z, const Weight& w)
        : numerators_{negate_if(w.negative(), x), negate_if(w.negative(), y), negate_if(w.negative(), z)},
          weight_(negate_if(w.negative(), w)) {
        const double denominator = to_double(weight_);
        for (int axis = 0; axis < 3; ++axis)
            approximations_[axis] = to_double(numerators_[axis]) / denominator;
    }

    /// A lattice point.
    constexpr explicit HomogeneousPoint(Point p)
        : numerators_{Numerator(p.x), Numerator(p.y), Numerator(p.z)},
          weight_(1),
          approximations_{static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)} {}

    constexpr const Numerator& numerator(int axis) const { return numerators_[axis]; }
    constexpr const Weight& weight() const { return weight_; }  ///< always positive

    /// Coordinate `axis`, in lattice units, off by at most 4u times itself.
    constexpr double approximation(int axis) const { return approximations_[axis]; }
    constexpr Vec3 approximation() const {
        return {approximations_[0], approximations_[1], approximations_[2]};
    }

  private:
    std::array<Numerator, 3> numerators_;
    Weight weight_;
    std::array<double, 3> approximations_{};
};

using EdgePoint = HomogeneousPoint<budget::edge_numerator, budget::edge_weight>;
using TriplePoint = HomogeneousPoint<budget::triple_numerator, budget::triple_weight>;
static_assert(sizeof(EdgePoint) == 88 && sizeof(TriplePoint) == 120);

/// A lattice point among the homogeneous ones, for predicates that take any kind.
using LatticePoint = HomogeneousPoint<budget::coordinate, 1>;

constexpr LatticePoint homogeneous(Point p) { return LatticePoint(p); }
template <int NumeratorBits, int WeightBits>
constexpr const HomogeneousPoint<NumeratorBits, WeightBits>& homogeneous(
    const HomogeneousPoint<NumeratorBits, WeightBits>& p) {
    return p;
}

/// Point, EdgePoint or TriplePoint.
template <class P>
concept AnyPoint = requires(const P& p) {
    homogeneous(p).weight();
};

}  // namespace octavo::exact
