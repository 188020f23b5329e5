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
    Int192 w;
    std::array<Int192, 3> x;
    const WideInt<2> d(plane.d());
    for (int axis = 0; axis < 3; ++axis) {
        const WideInt<2> direction(line.direction(axis));
        const int i = after(axis), j = before(axis);
        w += multiply<3>(direction, WideInt<1>(plane.normal(axis)));
        x[axis] = multiply<3>(line.moment(j), WideInt<1>(plane.normal(i))) -
                  multiply<3>(line.moment(i), WideInt<1>(plane.normal(j))) - multiply<3>(d, direction);
    }
    if (w == Int192{}) return std::nullopt;
    return TriplePoint(x[0], x[1], x[2], w);
}

std::optional<TriplePoint> intersect(const Plane& first, const Plane& second, const Plane& third) {
    return intersect(Line(first, second), third);
}

}  // namespace octavo::exact
