// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <octavo/bp_octree/support.hpp>

namespace octavo::bp_octree {

std::int32_t PointSet::farthest_value(Direction u) const {
    const std::int32_t *x = x_.data(), *y = y_.data(), *z = z_.data();
    const std::size_t count = size();
    std::int32_t most = -(1 << 30);
    for (std::size_t i = 0; i < count; ++i) {
        const std::int32_t value = u.a * x[i] + u.b * y[i] + u.c * z[i];
        most = value > most ? value : most;
    }
    return most;
}

std::size_t PointSet::farthest(Direction u) const {
    const std::int32_t most = farthest_value(u);
    for (std::size_t i = 0; i < size(); ++i)
        if (u.a * x_[i] + u.b * y_[i] + u.c * z_[i] == most) return i;
    return 0;
}

CellContent::CellContent(const CellBox& box, PointSet& points) : box_(box), points_(points) {
    for (int axis = 0; axis < 3; ++axis)
        scale_[axis] = PointSet::cell_side / static_cast<double>(box.side(axis));
}

void CellContent::add(Vec3 x) {
    // Points lie in the cell, so what the slack let out of it may be taken back.
    const auto inward = [](double v) {
        return std::clamp(static_cast<std::int32_t>(std::floor(v)), 0, PointSet::cell_side);
    };
    points_.add(inward(x.x), inward(x.y), inward(x.z));
}

void CellContent::add_corner(int index) {
    const auto at = [index](int axis) { return index >> axis & 1 ? PointSet::cell_side : 0; };
    points_.add(at(0), at(1), at(2));
}

void CellContent::add_cuts(exact::Point p, exact::Point q, exact::Point r) {
    // A triangle gains at most one vertex a clip.
    struct Corner {
        Vec3 x;
        bool cut;
    };
    std::array<Corner, 12> polygon{{{map(p), false}, {map(q), false}, {map(r), false}}}, clipped;
    std::size_t count = 3;
    for (int side = 0; side < 6 && count > 0; ++side) {
        const int axis = side / 2;
        const bool high = side & 1;
        const double bound = high ? PointSet::cell_side + clip_slack : -clip_slack;
        const auto outside = [&](const Corner& corner) {
            return high ? corner.x[axis] > bound : corner.x[axis] < bound;
        };
        std::size_t kept = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const Corner &a = polygon[i], &b = polygon[i + 1 == count ? 0 : i + 1];
            const bool a_out = outside(a), b_out = outside(b);
            if (!a_out) clipped[kept++] = a;
            if (a_out == b_out) continue;
            const double t = (bound - a.x[axis]) / (b.x[axis] - a.x[axis]);
            Corner cut{a.x + t * (b.x - a.x), true};
            cut.x[axis] = bound;
            clipped[kept++] = cut;
        }
        count = kept;
        std::swap(polygon, clipped);
    }
    for (std::size_t i = 0; i < count; ++i)
        if (polygon[i].cut) add(polygon[i].x);
}

}  // namespace octavo::bp_octree
