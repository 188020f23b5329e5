// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <span>

#include <octavo/boolean/facet_prism.hpp>
#include <octavo/boolean/lanes.hpp>

namespace octavo::boolean {

FacetPrism::FacetPrism(const FacetBlock& block, int lane, double reach) {
    double point[3][3];
    for (int corner = 0; corner < 3; ++corner)
        for (int axis = 0; axis < 3; ++axis) point[corner][axis] = block.point[corner][axis][lane];
    const auto edge = [&](int corner, int axis) { return point[corner][axis] - point[0][axis]; };
    double normal[3];
    for (int axis = 0; axis < 3; ++axis) {
        const int i = (axis + 1) % 3, j = (axis + 2) % 3;
        normal[axis] = edge(1, i) * edge(2, j) - edge(1, j) * edge(2, i);
    }
    const auto set = [&](Plane& plane, const double(&at)[3]) {
        plane.offset = -(plane.normal[0] * at[0] + plane.normal[1] * at[1] + plane.normal[2] * at[2]);
        // As in facet_filter.cpp: coordinates of 26 bits, a normal of 53, three products and sums that round.
        plane.bound = (0x1p-23 + reach) *
                      (std::fabs(plane.normal[0]) + std::fabs(plane.normal[1]) + std::fabs(plane.normal[2]));
    };
    for (int axis = 0; axis < 3; ++axis) {
        planes_[0].normal[axis] = normal[axis];
        planes_[1].normal[axis] = -normal[axis];
    }
    set(planes_[0], point[0]);
    set(planes_[1], point[0]);
    int axis = 0;
    for (int other = 1; other < 3; ++other)
        if (std::fabs(normal[other]) > std::fabs(normal[axis])) axis = other;
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    const double turn = normal[axis] > 0 ? 1 : -1;
    for (int corner = 0; corner < 3; ++corner) {
        Plane& plane = planes_[2 + corner];
        const double(&from)[3] = point[corner], (&to)[3] = point[(corner + 1) % 3];
        plane.normal[axis] = 0;
        plane.normal[i] = turn * (to[j] - from[j]);
        plane.normal[j] = turn * (from[i] - to[i]);
        set(plane, from);
    }
}

FacetPrism FacetPrism::turned(const TurnedFrame& frame) const {
    FacetPrism prism = *this;
    for (Plane& plane : prism.planes_) {
        // A point x is the sum of (place + origin) / stretch along the axes. Boxes hold their facets' places but for
        // less than a unit of rounding down. The axes are off by some 2^-52 of their lengths.
        double normal[3], offset = plane.offset, unit = 0;
        for (int k = 0; k < 3; ++k) {
            const double along = plane.normal[0] * frame.axis[k][0] + plane.normal[1] * frame.axis[k][1] +
                                 plane.normal[2] * frame.axis[k][2];
            normal[k] = along / frame.stretch[k];
            offset += normal[k] * frame.origin[k];
            unit += std::fabs(normal[k]);
        }
        plane.bound += unit + 0x1p-21 * (std::fabs(plane.normal[0]) + std::fabs(plane.normal[1]) +
                                         std::fabs(plane.normal[2]));
        std::copy(normal, normal + 3, plane.normal);
        plane.offset = offset;
    }
    return prism;
}

unsigned FacetPrism::meeting(const BoxNode& node, unsigned candidates) const {
    for (const Plane& plane : planes_) {
        if (!candidates) break;
        // The corner of each box that lies farthest behind the plane.
        const std::int32_t* const x = plane.normal[0] > 0 ? node.low[0] : node.high[0];
        const std::int32_t* const y = plane.normal[1] > 0 ? node.low[1] : node.high[1];
        const std::int32_t* const z = plane.normal[2] > 0 ? node.low[2] : node.high[2];
        const auto behind = [&](int first) {
            const Reals value = plane.normal[0] * load_reals(x + first) +
                                plane.normal[1] * load_reals(y + first) +
                                (plane.normal[2] * load_reals(z + first) + plane.offset);
            return bits(value <= plane.bound);
        };
        candidates &= behind(0) | behind(half_block) << half_block;
    }
    return candidates;
}

unsigned FacetPrism::meeting(const FacetBlock& others, unsigned candidates) const {
    for (const Plane& edge : std::span(planes_).subspan<2>()) {
        unsigned beyond = candidates;
        for (int corner = 0; corner < 3 && beyond; ++corner) {
            const auto in_front = [&](int first) {
                const Reals value =
                    edge.normal[0] * load_reals(others.point[corner][0] + first) +
                    edge.normal[1] * load_reals(others.point[corner][1] + first) +
                    (edge.normal[2] * load_reals(others.point[corner][2] + first) + edge.offset);
                return bits(value > edge.bound);
            };
            beyond &= in_front(0) | in_front(half_block) << half_block;
        }
        candidates &= ~beyond;
        if (!candidates) break;
    }
    return candidates;
}

}  // namespace octavo::boolean
