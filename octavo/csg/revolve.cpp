// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <octavo/csg/extrude.hpp>
#include <octavo/csg/revolve.hpp>

namespace octavo::csg {
namespace {

struct Side {
    double bottom, top;  // radii
};

/// The sides of the region that span a slab, from the axis outwards.
std::vector<Side> sides_between(const Region& region, double low, double high, double mirror) {
    std::vector<Side> sides;
    for (const Contour& contour : region.contours)
        for (std::size_t i = 0; i < contour.size(); ++i) {
            Vec2 p = contour[i], q = contour[(i + 1) % contour.size()];
            if (p.y > q.y) std::swap(p, q);
            if (!(p.y <= low && q.y >= high)) continue;
            const auto radius_at = [&](double y) {
                if (y == p.y) return mirror * p.x;
                if (y == q.y) return mirror * q.x;
                return mirror * (p.x + (y - p.y) / (q.y - p.y) * (q.x - p.x));
            };
            sides.push_back({radius_at(low), radius_at(high)});
        }
    std::sort(sides.begin(), sides.end(),
              [](const Side& a, const Side& b) { return a.bottom + a.top < b.bottom + b.top; });
    return sides;
}

/// Half of space on the left of the ray from the z axis in this direction.
Expr left_of(double degrees) { return Expr(HalfSpace{{sin_degrees(degrees), -cos_degrees(degrees), 0}, 0}); }

Expr wedge(double angle) {
    const double from = angle < 0 ? angle : 0, to = angle < 0 ? 0 : angle;
    const Expr begin = left_of(from), end = complement(left_of(to));
    return to - from <= 180 ? intersect({begin, end}) : unite({begin, end});
}

}  // namespace

Result<Expr> revolve(const Region& region, double angle) {
    if (region.empty() || angle == 0) return nothing();
    const Box3 box = bounds(region);
    if (box.low.x < 0 && box.high.x > 0)
        return Error{ErrorCode::bad_input, "the profile lies on both sides of the axis x = 0", {}};
    std::vector<double> heights;
    for (const Contour& contour : region.contours)
        for (const Vec2& p : contour) heights.push_back(p.y);
    std::sort(heights.begin(), heights.end());
    heights.erase(std::unique(heights.begin(), heights.end()), heights.end());

    const bool negative = box.low.x < 0;
    std::vector<Expr> slabs;
    for (std::size_t h = 0; h + 1 < heights.size(); ++h) {
        const double low = heights[h], high = heights[h + 1];
        const std::vector<Side> sides = sides_between(region, low, high, negative ? -1 : 1);
        for (std::size_t s = 0; s + 1 < sides.size(); s += 2) {
            const Side &inner = sides[s], &outer = sides[s + 1];
            Expr solid(Frustum{low, high, outer.bottom, outer.top});
            if (inner.bottom + inner.top > 0)
                solid = subtract({std::move(solid), Expr(Frustum{low, high, inner.bottom, inner.top})});
            slabs.push_back(std::move(solid));
        }
    }
    Expr whole = unite(std::move(slabs));
    if (std::fabs(angle) >= 360) return whole;
    Expr part = intersect({std::move(whole), wedge(angle)});
    if (!negative) return part;
    // A profile at x < 0 starts on the −x axis.
    Affine half_turn;
    half_turn.m[0][0] = half_turn.m[1][1] = -1;
    return transform(half_turn, std::move(part));
}

}  // namespace octavo::csg
