// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <octavo/base/check.hpp>
#include <octavo/csg/lattice_plane.hpp>

namespace octavo::csg {
namespace {

// Offsets are whole multiples of this many lattice units: coarse beside the rounding of the products that a plane
// comes from (2^-26 units), so that coplanar faces agree, and fine beside the lattice.
constexpr int offset_fraction_bits = 8;

// Coplanar faces whose coefficients straddle a rounding border differ by one step.
constexpr std::int64_t normal_step = 1;
constexpr std::int64_t offset_step = std::int64_t{1} << (LatticePlane::normal_bits - offset_fraction_bits);

bool nearly_equal(const LatticePlane& a, const LatticePlane& b) {
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (std::abs(a.normal[axis] - b.normal[axis]) > normal_step) return false;
    return std::abs(a.offset - b.offset) <= offset_step;
}

template <class Real>
Real largest_of(const std::array<Real, 3>& normal) {
    return std::max({std::fabs(normal[0]), std::fabs(normal[1]), std::fabs(normal[2])});
}

/// `component` has 1 or -1 for its largest.
SnappedPlane rounded(const std::array<double, 3>& component, long double offset) {
    SnappedPlane result;
    LatticePlane plane;
    constexpr double scale = static_cast<double>(std::int64_t{1} << LatticePlane::normal_bits);
    int components = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        plane.normal[axis] = static_cast<std::int64_t>(std::nearbyint(component[axis] * scale));
        components += plane.normal[axis] != 0;
    }
    // Beyond this no point of the universe, where the three products are at most 3 · 2^26, changes the sign.
    constexpr long double far = 4.0L * exact::universe_side;
    if (!(std::fabs(static_cast<double>(offset)) <= static_cast<double>(far))) {
        result.whole = offset > 0;
        return result;
    }
    const int fraction_bits = components == 1 ? 0 : offset_fraction_bits;
    const auto steps =
        static_cast<std::int64_t>(std::nearbyint(static_cast<double>(offset * (1 << fraction_bits))));
    plane.offset = steps * (std::int64_t{1} << (LatticePlane::normal_bits - fraction_bits));
    result.plane = plane;
    return result;
}

}  // namespace

int same_plane(const LatticePlane& a, const LatticePlane& b) {
    if (nearly_equal(a, b)) return 1;
    return nearly_equal(a, b.flipped()) ? -1 : 0;
}

SnappedPlane snap_plane(Vec3 normal, Vec3 through) {
    const double divisor = largest_of(std::array{normal.x, normal.y, normal.z});
    OCTAVO_CHECK(divisor > 0, "a plane needs a normal");
    std::array<double, 3> component{};
    long double offset = 0;
    for (int axis = 0; axis < 3; ++axis) {
        // Divided before they are multiplied: a normal may be as small or large as doubles go.
        component[static_cast<std::size_t>(axis)] = normal[axis] / divisor;
        offset -= static_cast<long double>(component[static_cast<std::size_t>(axis)]) * through[axis];
    }
    return rounded(component, offset);
}

SnappedPlane snap_plane(const std::array<long double, 3>& normal, long double offset) {
    const long double divisor = largest_of(normal);
    OCTAVO_CHECK(divisor > 0, "a plane needs a normal");
    std::array<double, 3> component{};
    for (std::size_t axis = 0; axis < 3; ++axis)
        component[axis] = static_cast<double>(normal[axis] / divisor);
    return rounded(component, offset / divisor);
}

}  // namespace octavo::csg
