// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <polyclipping/clipper.hpp>

#include <octavo/base/any_scale.hpp>
#include <octavo/csg/region.hpp>

namespace octavo::csg {
namespace {

namespace clipper = ClipperLib;

// Bits of the largest coordinate. Clipper's own limit is 62; its offsetting multiplies by doubles, and 40 leaves it
// room without rounding.
constexpr int coordinate_bits = 40;

/// The power of two that takes coordinates up to `extent` to the integer grid.
double grid_scale(double extent) {
    return extent > 0 ? std::ldexp(1.0, coordinate_bits - 1 - std::ilogb(extent)) : 1;
}

double extent_of(const Region& region) {
    double extent = 0;
    for (const Contour& contour : region.contours)
        for (const Vec2& p : contour) extent = std::max({extent, std::fabs(p.x), std::fabs(p.y)});
    return extent;
}

double extent_of(std::span<const Region> regions) {
    double extent = 0;
    for (const Region& region : regions) extent = std::max(extent, extent_of(region));
    return extent;
}

clipper::Paths to_paths(const Region& region, double scale) {
    clipper::Paths paths;
    for (const Contour& contour : region.contours) {
        clipper::Path path;
        for (const Vec2& p : contour)
            path.emplace_back(static_cast<clipper::cInt>(std::nearbyint(p.x * scale)),
                              static_cast<clipper::cInt>(std::nearbyint(p.y * scale)));
        paths.push_back(std::move(path));
    }
    return paths;
}

Region from_paths(const clipper::Paths& paths, double scale) {
    Region region;
    for (const clipper::Path& path : paths) {
        if (path.size() < 3) continue;
        Contour contour;
        for (const clipper::IntPoint& p : path)
            contour.push_back({static_cast<double>(p.X) / scale, static_cast<double>(p.Y) / scale});
        region.contours.push_back(std::move(contour));
    }
    return region;
}

clipper::Paths execute(clipper::Clipper& engine, clipper::ClipType type,
                       clipper::PolyFillType fill = clipper::pftNonZero) {
    clipper::Paths result;
    engine.StrictlySimple(true);
    engine.Execute(type, result, fill, fill);
    return result;
}

}  // namespace

Region make_region(const std::vector<Contour>& contours, FillRule rule) {
    const Region raw{contours};
    const double scale = grid_scale(extent_of(raw));
    clipper::Clipper engine;
    engine.AddPaths(to_paths(raw, scale), clipper::ptSubject, true);
    return from_paths(execute(engine, clipper::ctUnion,
                              rule == FillRule::even_odd ? clipper::pftEvenOdd : clipper::pftNonZero),
                      scale);
}

Region unite(std::span<const Region> regions) {
    const double scale = grid_scale(extent_of(regions));
    clipper::Clipper engine;
    for (const Region& region : regions) engine.AddPaths(to_paths(region, scale), clipper::ptSubject, true);
    // Holes run clockwise: where one region's hole lies in another's inside the numbers still add to one or more.
    clipper::Paths result;
    engine.StrictlySimple(true);
    engine.Execute(clipper::ctUnion, result, clipper::pftPositive, clipper::pftPositive);
    return from_paths(result, scale);
}

Region intersect(std::span<const Region> regions) {
    if (regions.empty()) return {};
    const double scale = grid_scale(extent_of(regions));
    clipper::Paths paths = to_paths(regions[0], scale);
    for (const Region& region : regions.subspan(1)) {
        clipper::Clipper engine;
        engine.AddPaths(paths, clipper::ptSubject, true);
        engine.AddPaths(to_paths(region, scale), clipper::ptClip, true);
        paths = execute(engine, clipper::ctIntersection);
    }
    return from_paths(paths, scale);
}

Region subtract(std::span<const Region> regions) {
    if (regions.empty()) return {};
    const double scale = grid_scale(extent_of(regions));
    const Region removed = unite(regions.subspan(1));
    clipper::Clipper engine;
    engine.AddPaths(to_paths(regions[0], scale), clipper::ptSubject, true);
    engine.AddPaths(to_paths(removed, scale), clipper::ptClip, true);
    return from_paths(execute(engine, clipper::ctDifference), scale);
}

Region offset(const Region& region, double distance, const OffsetOptions& options) {
    if (distance == 0) return region;
    const double scale = grid_scale(extent_of(region) + std::fabs(distance));
    const double radius = std::fabs(distance) * scale;
    // Clipper asks how far an arc may be from its chords; its miter limit of 1e6 cuts no corner that a polygon
    // would have.
    const double tolerance = radius * (1 - std::cos(std::acos(-1.0) / std::max(options.segments, 3)));
    clipper::ClipperOffset engine(1e6, std::max(tolerance, 1e-3));
    const clipper::JoinType join = options.join == OffsetOptions::Join::round   ? clipper::jtRound
                                   : options.join == OffsetOptions::Join::miter ? clipper::jtMiter
                                                                                : clipper::jtSquare;
    engine.AddPaths(to_paths(region, scale), join, clipper::etClosedPolygon);
    clipper::Paths result;
    engine.Execute(result, distance * scale);
    return from_paths(result, scale);
}

Region convex_hull(std::vector<Vec2> points) {
    std::sort(points.begin(), points.end(),
              [](Vec2 a, Vec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.size() < 3) return {};
    // Andrew's monotone chain.
    Contour hull(2 * points.size());
    std::size_t count = 0;
    const auto turn = [](Vec2 a, Vec2 b, Vec2 c) {
        return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    };
    for (const Vec2& p : points) {
        while (count >= 2 && turn(hull[count - 2], hull[count - 1], p) <= 0) --count;
        hull[count++] = p;
    }
    const std::size_t lower = count + 1;
    for (std::size_t i = points.size() - 1; i-- > 0;) {
        while (count >= lower && turn(hull[count - 2], hull[count - 1], points[i]) <= 0) --count;
        hull[count++] = points[i];
    }
    hull.resize(count - 1);
    if (hull.size() < 3) return {};
    return Region{{std::move(hull)}};
}

Region minkowski_sum(const Region& a, const Region& b) {
    const double scale = grid_scale(extent_of(a) + extent_of(b));
    const clipper::Paths paths_a = to_paths(a, scale), paths_b = to_paths(b, scale);
    clipper::Clipper engine;
    for (const clipper::Path& outline_b : paths_b) {
        // Clipper sweeps b's outline along a's outlines; what lies deep inside is a itself, moved to a point of b.
        clipper::Paths swept;
        for (const clipper::Path& outline_a : paths_a) {
            clipper::Paths part;
            clipper::MinkowskiSum(outline_b, outline_a, part, true);
            swept.insert(swept.end(), part.begin(), part.end());
        }
        engine.AddPaths(swept, clipper::ptSubject, true);
        clipper::Paths moved = paths_a;
        for (clipper::Path& path : moved)
            for (clipper::IntPoint& p : path) p.X += outline_b[0].X, p.Y += outline_b[0].Y;
        engine.AddPaths(moved, clipper::ptSubject, true);
    }
    clipper::Paths result;
    engine.Execute(clipper::ctUnion, result, clipper::pftPositive, clipper::pftPositive);
    return from_paths(result, scale);
}

Region transform(const Affine& map, const Region& region) {
    Region result = region;
    const Affine flat{{{{map.m[0][0], map.m[0][1], 0, 0}, {map.m[1][0], map.m[1][1], 0, 0}, {0, 0, 1, 0}}}};
    const int sign = determinant_sign(flat);
    if (sign == 0) return {};
    for (Contour& contour : result.contours) {
        for (Vec2& p : contour)
            p = {map.m[0][0] * p.x + map.m[0][1] * p.y + map.m[0][3],
                 map.m[1][0] * p.x + map.m[1][1] * p.y + map.m[1][3]};
        if (sign < 0) std::reverse(contour.begin(), contour.end());
    }
    return result;
}

double area(const Region& region) {
    double sum = 0;
    for (const Contour& contour : region.contours)
        for (std::size_t i = 0; i < contour.size(); ++i) {
            const Vec2 p = contour[i], q = contour[(i + 1) % contour.size()];
            sum += p.x * q.y - p.y * q.x;
        }
    return 0.5 * sum;
}

Box3 bounds(const Region& region) {
    Box3 box;
    for (const Contour& contour : region.contours)
        for (const Vec2& p : contour) box.add(Vec3{p.x, p.y, 0});
    return box;
}

}  // namespace octavo::csg
