// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdlib>

#include <octavo/render/outline.hpp>

namespace octavo::render {
namespace {

std::int64_t turn(DrawingPoint a, DrawingPoint b, DrawingPoint c) {
    return std::int64_t{b.x - a.x} * (c.y - a.y) - std::int64_t{c.x - a.x} * (b.y - a.y);
}

/// How far off the way a point may be, in steps: it and the ends of the way were rounded, by up to 0.7 each.
constexpr double tolerance = 1.5;

bool is_needless(DrawingPoint before, DrawingPoint point, DrawingPoint after) {
    const double dx = after.x - before.x, dy = after.y - before.y, size = std::hypot(dx, dy);
    const double along = dx * (point.x - before.x) + dy * (point.y - before.y);
    if (size == 0) return true;  // a spike
    return along >= 0 && along <= size * size &&
           std::fabs(static_cast<double>(turn(before, point, after))) <= tolerance * size;
}

}  // namespace

Polyline without_needless_points(const Polyline& loop) {
    Polyline kept;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const DrawingPoint next = loop[i + 1 == loop.size() ? 0 : i + 1];
        if (!kept.empty() && is_needless(kept.back(), loop[i], next)) continue;
        kept.push_back(loop[i]);
    }
    // The first point was kept unseen.
    if (kept.size() > 2 && is_needless(kept.back(), kept[0], kept[1])) kept.erase(kept.begin());
    return kept;
}

Polyline line_without_needless_points(const Polyline& line) {
    Polyline kept;
    for (std::size_t i = 0; i < line.size(); ++i)
        if (i == 0 || i + 1 == line.size() || !is_needless(kept.back(), line[i], line[i + 1]))
            kept.push_back(line[i]);
    return kept;
}

bool has_area(const Polyline& loop) {
    constexpr std::int64_t least = steps_of_pixel * steps_of_pixel / 200;
    std::int64_t twice = 0;
    for (std::size_t i = 2; i < loop.size(); ++i) twice += turn(loop[0], loop[i - 1], loop[i]);
    return std::abs(twice) >= 2 * least;
}

}  // namespace octavo::render
