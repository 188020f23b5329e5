// SPDX-License-Identifier: Apache-2.0
#include <numeric>

#include <octavo/exact/plane.hpp>
#include <octavo/exact/wide_int.hpp>

namespace octavo::exact {
namespace {

/// The greatest common divisor of a 64-bit number and the magnitude of a wide one.
std::int64_t divisor_with(std::int64_t number, int128 other) {
    // One division brings `other` below `number`; from there 64 bits suffice.
    return number == 0 ? 0 : std::gcd(number, static_cast<std::int64_t>(other % number));
}

}  // namespace

PlaneRelation relation(const Plane& first, const Plane& second) {
    OCTAVO_CHECK(!first.degenerate() && !second.degenerate(), "a degenerate plane has no relation to others");
    static_assert(budget::line_direction < 127);
    const auto minor = [&](int i, int j) {
        return wide(first.normal(i)) * second.normal(j) - wide(first.normal(j)) * second.normal(i);
    };
    if (minor(1, 2) != 0 || minor(2, 0) != 0 || minor(0, 1) != 0) return PlaneRelation::crossing;

    // The normals are multiples of one another; a component that is not zero in one is not zero in the other.
    const int axis = first.dominant_axis();
    const bool same_way = (first.normal(axis) < 0) == (second.normal(axis) < 0);
    static_assert(budget::line_moment < Int192::bits - 1);
    const bool same_points = multiply<3>(WideInt<2>(first.d()), WideInt<1>(second.normal(axis))) ==
                             multiply<3>(WideInt<2>(second.d()), WideInt<1>(first.normal(axis)));
    if (same_points) return same_way ? PlaneRelation::same : PlaneRelation::opposite;
    return same_way ? PlaneRelation::parallel : PlaneRelation::antiparallel;
}

Plane primitive(const Plane& plane) {
    if (plane.degenerate()) return {};
    const std::int64_t divisor = divisor_with(std::gcd(std::gcd(plane.a(), plane.b()), plane.c()), plane.d());
    return Plane::from_coefficients(plane.a() / divisor, plane.b() / divisor, plane.c() / divisor,
                                    plane.d() / divisor);
}

}  // namespace octavo::exact
