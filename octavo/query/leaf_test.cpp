// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <octavo/exact/linear_form.hpp>
#include <octavo/query/leaf_test.hpp>

// The path from the leaf's low corner R to the point q goes along x, then y, then z:
//
//     R = (Rx, Ry, Rz) → (qx, Ry, Rz) → (qx, qy, Rz) → q,      every point displaced by (ε₁, ε₂, ε₃)
//
// The first step only meets facets whose projection along x contains (Ry, Rz), the second only facets that reach down
// to Rz; most facets meet neither. The third is the work: the facets whose projection along z contains (qx, qy) and
// that lie between Rz and qz. A facet with q in its plane and (qx, qy) in its closed projection holds q, so the test
// for "on" costs nothing extra, but for facets parallel to z.

namespace octavo::query {
namespace {

using classic::FacetCorners;
using classic::Normal;
using Corner = std::array<std::int32_t, 3>;

/// A point whose coordinates are those of the query point for axes in `free`, and whole numbers for the others.
struct MixedPoint {
    const LatticePlace& place;
    const exact::Lattice& lattice;
    Corner fixed;
    unsigned free;  ///< bit k for axis k

    bool is_free(std::size_t axis) const { return free >> axis & 1U; }
};

/// The sign of Σ coefficient · (coordinate − anchor), exactly.
int exact_sign(const MixedPoint& point, const std::array<std::int64_t, 3>& coefficients,
               const Corner& anchor) {
    // Coefficients have 54 bits, the origin 53: the offset of a free axis fits 108, the sum 110 bits.
    std::array<std::int64_t, 3> free{};
    exact::int128 offset = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::int64_t c = coefficients[axis];
        if (point.is_free(axis)) {
            free[axis] = c;
            offset -= exact::int128{c} * (point.lattice.origin()[axis] + anchor[axis]);
        } else {
            offset += exact::int128{c} * (point.fixed[axis] - anchor[axis]);
        }
    }
    const exact::LinearForm form(free[0], free[1], free[2], offset, point.lattice.exponent());
    return static_cast<int>(form.exact_at(point.place.world));
}

/// The same by a filter first. Differences round once (26 bits and a part of at most one), products once, the sums
/// twice, 2^-53 each of terms that `bulk` adds up: 4 and a little; 8 is proved. A part is off by 2^-54 at most, however
/// small the difference, so `bulk` also holds the coefficients of free axes.
inline int sign_at(const MixedPoint& point, const std::array<std::int64_t, 3>& coefficients,
                   const Corner& anchor) {
    double sum = 0, bulk = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto coefficient = static_cast<double>(coefficients[axis]);
        const double difference =
            point.is_free(axis)
                ? static_cast<double>(point.place.whole[axis] - anchor[axis]) + point.place.part[axis]
                : static_cast<double>(point.fixed[axis] - anchor[axis]);
        const double term = coefficient * difference;
        sum += term;
        bulk += std::fabs(term) + (point.is_free(axis) ? std::fabs(coefficient) : 0);
    }
    if (std::fabs(sum) > 8 * 0x1p-53 * bulk) [[likely]]
        return sum > 0 ? 1 : -1;
    return exact_sign(point, coefficients, anchor);
}

/// The sign after the displacement: never zero while a coefficient is not.
inline bool is_positive_displaced(int sign, const std::array<std::int64_t, 3>& c) {
    if (sign != 0) return sign > 0;
    return c[0] != 0 ? c[0] > 0 : c[1] != 0 ? c[1] > 0 : c[2] > 0;
}

inline bool is_above(const MixedPoint& point, const FacetCorners& facet, const Normal& n) {
    const std::array<std::int64_t, 3> coefficients{n.x, n.y, n.z};
    return is_positive_displaced(sign_at(point, coefficients, facet[0]), coefficients);
}

/// Where a point lies in the projection of a facet along an axis.
struct InProjection {
    bool within_closed;     ///< inside, on an edge or on a corner
    bool within_displaced;  ///< inside after the displacement
};

/// `first` < `second` are the axes that are kept. A projection without area holds its line, and no displaced point.
inline InProjection in_projection(const MixedPoint& point, const FacetCorners& facet, std::size_t first,
                                  std::size_t second) {
    bool any_left = false, any_right = false, all_left = true, all_right = true;
    for (std::size_t i = 0; i < 3; ++i) {
        const Corner &a = facet[i], &b = facet[(i + 1) % 3];
        std::array<std::int64_t, 3> coefficients{};
        coefficients[first] = a[second] - b[second];
        coefficients[second] = b[first] - a[first];
        const int sign = sign_at(point, coefficients, a);
        const bool left = is_positive_displaced(sign, coefficients);
        any_left = any_left || sign > 0;
        any_right = any_right || sign < 0;
        if (any_left && any_right) return {false, false};
        all_left = all_left && left;
        all_right = all_right && !left;
    }
    return {true, all_left || all_right};
}

struct Bounds {
    Corner low, high;  ///< both inclusive
};
inline Bounds bounds_of(const FacetCorners& facet) {
    Bounds bounds;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        bounds.low[axis] = std::min({facet[0][axis], facet[1][axis], facet[2][axis]});
        bounds.high[axis] = std::max({facet[0][axis], facet[1][axis], facet[2][axis]});
    }
    return bounds;
}

/// True when the coordinate q of an axis lies in a facet's bounds.
inline bool in_bounds(const LatticePlace& place, const Bounds& bounds, std::size_t axis) {
    const std::int32_t whole = place.whole[axis];
    return whole >= bounds.low[axis] &&
           (whole < bounds.high[axis] || (whole == bounds.high[axis] && place.part[axis] == 0));
}

/// Whether the point, known to be in the facet's bounds, lies on a facet parallel to z or on one without area.
bool is_on_upright_facet(const MixedPoint& point, const FacetCorners& facet, const Normal& n) {
    // A segment is where its bounds and its line are, and its line where that is in every projection.
    if (n.is_zero())
        return in_projection(point, facet, 1, 2).within_closed &&
               in_projection(point, facet, 0, 2).within_closed &&
               in_projection(point, facet, 0, 1).within_closed;
    if (sign_at(point, {n.x, n.y, n.z}, facet[0]) != 0) return false;
    return n.x != 0 ? in_projection(point, facet, 1, 2).within_closed
                    : in_projection(point, facet, 0, 2).within_closed;
}

/// The change of the winding number along a step between two displaced points that differ in `axis`, +1 on entering,
/// when the line of the step meets the facet's projection.
int change_between(const MixedPoint& from, const MixedPoint& to, const FacetCorners& facet, const Normal& n) {
    const bool above = is_above(from, facet, n);
    return above == is_above(to, facet, n) ? 0 : above ? 1 : -1;
}

}  // namespace

LeafAnswer test_in_leaf(const LatticePlace& place, const std::array<std::int32_t, 3>& low,
                        std::int32_t winding, std::span<const std::uint32_t> references,
                        std::span<const FacetCorners> facets, const exact::Lattice& lattice) {
    const MixedPoint start{place, lattice, low, 0}, after_x{place, lattice, low, 1},
        after_y{place, lattice, low, 3}, point{place, lattice, low, 7};
    for (const std::uint32_t reference : references) {
        const FacetCorners& facet = facets[reference];
        const Bounds bounds = bounds_of(facet);
        const bool x_in = in_bounds(place, bounds, 0), y_in = in_bounds(place, bounds, 1);
        // Displaced whole coordinates lie within bounds [a, b] iff a ≤ v < b.
        const auto low_within = [&](std::size_t axis) {
            return bounds.low[axis] <= low[axis] && low[axis] < bounds.high[axis];
        };
        const bool z_low_within = low_within(2);
        const bool third = x_in && y_in, second = x_in && z_low_within, first = z_low_within && low_within(1);
        if (!third && !second && !first) continue;
        const Normal n = classic::normal_of(facet);
        if (first && n.x != 0 && in_projection(start, facet, 1, 2).within_displaced)
            winding += change_between(start, after_x, facet, n);
        if (second && n.y != 0 && in_projection(after_x, facet, 0, 2).within_displaced)
            winding += change_between(after_x, after_y, facet, n);
        if (!third) continue;
        if (n.z == 0) {
            if (in_bounds(place, bounds, 2) && is_on_upright_facet(point, facet, n)) return {true, 0};
            continue;
        }
        const InProjection seen = in_projection(point, facet, 0, 1);
        if (!seen.within_closed) continue;
        const std::array<std::int64_t, 3> coefficients{n.x, n.y, n.z};
        const int side = sign_at(point, coefficients, facet[0]);
        if (side == 0) return {true, 0};
        if (!seen.within_displaced) continue;
        // A facet wholly above the low side has the step's start below it.
        const bool starts_above = bounds.low[2] > low[2] ? n.z < 0 : is_above(after_y, facet, n);
        if (starts_above != (side > 0)) winding += starts_above ? 1 : -1;
    }
    return {false, winding};
}

}  // namespace octavo::query
