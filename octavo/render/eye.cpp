// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <octavo/render/eye.hpp>

namespace octavo::render {

Eye::Eye(const Camera& camera, const exact::Lattice& lattice) {
    const double limit = std::ldexp(1.0, bits);
    Vec3 place;
    if (camera.is_perspective()) {
        const Vec3 world = camera.eye();
        for (int axis = 0; axis < 3; ++axis)
            place[axis] = world[axis] / lattice.unit() - static_cast<double>(lattice.origin()[axis]);
        // An eye that far away sees what an infinitely far one sees.
        is_far_ = !(std::max({std::fabs(place.x), std::fabs(place.y), std::fabs(place.z)}) < limit / 2);
    }
    if (is_far_) place = limit / 2 * -camera.forward();
    for (int axis = 0; axis < 3; ++axis) at_[static_cast<std::size_t>(axis)] = std::llround(place[axis]);
}

exact::Sign Eye::side(const exact::Plane& plane) const {
    const exact::int128 along =
        exact::wide(plane.a()) * at_[0] + exact::wide(plane.b()) * at_[1] + exact::wide(plane.c()) * at_[2];
    return exact::sign_of(is_far_ ? along : along + plane.d());
}

int Eye::nearest_octant(const octree::Cell& cell) const {
    // Walls lie half a unit below lattice points (bsp/fragment.hpp), so no eye lies on one.
    const exact::Point middle = cell.centre();
    int octant = 0;
    for (int axis = 0; axis < 3; ++axis)
        if (at_[static_cast<std::size_t>(axis)] >= (is_far_ ? 0 : middle[axis])) octant |= 1 << axis;
    return octant;
}

}  // namespace octavo::render
