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

}  // namespace octavo::exact
