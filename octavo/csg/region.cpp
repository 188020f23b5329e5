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

/// The exponent of the power of two, which may be no double, that takes coordinates up to twice `half` to the integer
/// grid.
int grid_exponent(double half) { return half > 0 ? coordinate_bits - 2 - std::ilogb(half) : 0; }

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

int grid_exponent_for(const Region& region) { return grid_exponent(0.5 * extent_of(region)); }
int grid_exponent_for(std::span<const Region> regions) { return grid_exponent(0.5 * extent_of(regions)); }

clipper::Paths to_paths(const Region& region, int exponent) {
    const auto on_grid = [&](double coordinate) {
        return static_cast<clipper::cInt>(std::nearbyint(std::ldexp(coordinate, exponent)));
    };
    clipper::Paths paths;
    for (const Contour& contour : region.contours) {
        clipper::Path path;
        for (const Vec2& p : contour) path.emplace_back(on_grid(p.x), on_grid(p.y));
        paths.push_back(std::move(path));
    }
    return paths;
}

Region from_paths(const clipper::Paths& paths, int exponent) {
    Region region;
    for (const clipper::Path& path : paths) {
        if (path.size() < 3) continue;
        Contour contour;
        for (const clipper::IntPoint& p : path)
            contour.push_back({std::ldexp(static_cast<double>(p.X), -exponent),
                               std::ldexp(static_cast<double>(p.Y), -exponent)});
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
    const int exponent = grid_exponent_for(raw);
    clipper::Clipper engine;
    engine.AddPaths(to_paths(raw, exponent), clipper::ptSubject, true);
    return from_paths(execute(engine, clipper::ctUnion,
                              rule == FillRule::even_odd ? clipper::pftEvenOdd : clipper::pftNonZero),
                      exponent);
}

Region unite(std::span<const Region> regions) {
    const int exponent = grid_exponent_for(regions);
    clipper::Clipper engine;
    for (const Region& region : regions)
        engine.AddPaths(to_paths(region, exponent), clipper::ptSubject, true);
    // Holes run clockwise: where one region's hole lies in another's inside the numbers still add to one or more.
    clipper::Paths result;
    engine.StrictlySimple(true);
    engine.Execute(clipper::ctUnion, result, clipper::pftPositive, clipper::pftPositive);
    return from_paths(result, exponent);
}

Region intersect(std::span<const Region> regions) {
    if (regions.empty()) return {};
    const int exponent = grid_exponent_for(regions);
    clipper::Paths paths = to_paths(regions[0], exponent);
    for (const Region& region : regions.subspan(1)) {
        clipper::Clipper engine;
        engine.AddPaths(paths, clipper::ptSubject, true);
        engine.AddPaths(to_paths(region, exponent), clipper::ptClip, true);
        paths = execute(engine, clipper::ctIntersection);
    }
    return from_paths(paths, exponent);
}

Region subtract(std::span<const Region> regions) {
    if (regions.empty()) return {};
    const int exponent = grid_exponent_for(regions);
    const Region removed = unite(regions.subspan(1));
    clipper::Clipper engine;
    engine.AddPaths(to_paths(regions[0], exponent), clipper::ptSubject, true);
    engine.AddPaths(to_paths(removed, exponent), clipper::ptClip, true);
    return from_paths(execute(engine, clipper::ctDifference), exponent);
}

Region offset(const Region& region, double distance, const OffsetOptions& options) {
    if (distance == 0) return region;
    const int exponent = grid_exponent(0.5 * extent_of(region) + 0.5 * std::fabs(distance));
    const double step = std::ldexp(distance, exponent), radius = std::fabs(step);
    // Clipper asks how far an arc may be from its chords; its miter limit of 1e6 cuts no corner that a polygon
    // would have.
    const double tolerance = radius * (1 - std::cos(std::acos(-1.0) / std::max(options.segments, 3)));
    clipper::ClipperOffset engine(1e6, std::max(tolerance, 1e-3));
    const clipper::JoinType join = options.join == OffsetOptions::Join::round   ? clipper::jtRound
                                   : options.join == OffsetOptions::Join::miter ? clipper::jtMiter
                                                                                : clipper::jtSquare;
    engine.AddPaths(to_paths(region, exponent), join, clipper::etClosedPolygon);
    clipper::Paths result;
    engine.Execute(result, step);
    return from_paths(result, exponent);
}

Region convex_hull(std::vector<Vec2> points) {
    std::sort(points.begin(), points.end(),
              [](Vec2 a, Vec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.size() < 3) return {};
    // Andrew's monotone chain.
    Contour hull(2 * points.size());
    std::size_t count = 0;
    // Brought near one first: squares of lengths overflow from 1e154 on and vanish below 1e-162.
    const double scale = std::ldexp(1.0, std::clamp(-std::ilogb(extent_of(Region{{points}})), -1000, 1000));
    const auto turn = [scale](Vec2 a, Vec2 b, Vec2 c) {
        const double ax = scale * a.x, ay = scale * a.y;
        return (scale * b.x - ax) * (scale * c.y - ay) - (scale * b.y - ay) * (scale * c.x - ax);
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
    const int exponent = grid_exponent(0.5 * extent_of(a) + 0.5 * extent_of(b));
    const clipper::Paths paths_a = to_paths(a, exponent), paths_b = to_paths(b, exponent);
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
    return from_paths(result, exponent);
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
