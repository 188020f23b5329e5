// SPDX-License-Identifier: Apache-2.0
#include <octavo/exact/intersect.hpp>

namespace octavo::exact {
namespace {

// The other two axes, in cyclic order.
constexpr int after(int axis) { return axis == 2 ? 0 : axis + 1; }
constexpr int before(int axis) { return axis == 0 ? 2 : axis - 1; }

}  // namespace

Line::Line(const Plane& first, const Plane& second) {
    static_assert(budget::line_direction < 127 && budget::line_moment < Int192::bits - 1);
    for (int axis = 0; axis < 3; ++axis) {
        const int i = after(axis), j = before(axis);
        direction_[axis] =
            wide(first.normal(i)) * second.normal(j) - wide(first.normal(j)) * second.normal(i);
        moment_[axis] = multiply<3>(WideInt<2>(first.d()), WideInt<1>(second.normal(axis))) -
                        multiply<3>(WideInt<2>(second.d()), WideInt<1>(first.normal(axis)));
    }
}

std::optional<TriplePoint> intersect(const Line& line, const Plane& plane) {
    static_assert(budget::triple_weight < Int192::bits - 1 && budget::triple_numerator < Int192::bits - 1);
    const WideInt<1> a(plane.a()), b(plane.b()), c(plane.c());
    const WideInt<2> d(plane.d());
    const WideInt<2> mx(line.direction(0)), my(line.direction(1)), mz(line.direction(2));
    const Int192 &kx = line.moment(0), &ky = line.moment(1), &kz = line.moment(2);

    const Int192 w = multiply<3>(mx, a) + multiply<3>(my, b) + multiply<3>(mz, c);
    if (w == Int192{}) return std::nullopt;
    return TriplePoint(multiply<3>(kz, b) - multiply<3>(ky, c) - multiply<3>(mx, d),
                       multiply<3>(kx, c) - multiply<3>(kz, a) - multiply<3>(my, d),
                       multiply<3>(ky, a) - multiply<3>(kx, b) - multiply<3>(mz, d), w);
}

std::optional<TriplePoint> intersect(const Plane& first, const Plane& second, const Plane& third) {
    return intersect(Line(first, second), third);
}

std::optional<TriplePoint> intersect(const Plane& first, const Plane& second, const AxisPlane& third) {
    // In the plane, where the third coordinate is twice / 2: n1 u + n2 v = -e / 2 for either plane.
    const int i = after(third.axis), j = before(third.axis);
    static_assert(budget::axis_offset < 127);
    const auto offset = [&](const Plane& plane) {
        return wide(plane.normal(third.axis)) * third.twice + 2 * plane.d();
    };
    const int128 w = wide(first.normal(i)) * second.normal(j) - wide(first.normal(j)) * second.normal(i);
    if (w == 0) return std::nullopt;
    static_assert(budget::axis_numerator <= budget::triple_numerator &&
                  budget::axis_weight <= budget::triple_weight);
    const WideInt<2> e1(offset(first)), e2(offset(second));
    std::array<Int192, 3> x;
    x[third.axis] = multiply<3>(WideInt<2>(w), WideInt<1>(std::int64_t{third.twice}));
    x[i] = multiply<3>(e2, WideInt<1>(first.normal(j))) - multiply<3>(e1, WideInt<1>(second.normal(j)));
    x[j] = multiply<3>(e1, WideInt<1>(second.normal(i))) - multiply<3>(e2, WideInt<1>(first.normal(i)));
    return TriplePoint(x[0], x[1], x[2], Int192(2 * w));
}

}  // namespace octavo::exact
