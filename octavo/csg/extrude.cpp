// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <octavo/csg/extrude.hpp>
#include <octavo/mesh/triangulate.hpp>

namespace octavo::csg {
namespace {

constexpr double pi = 3.14159265358979323846;

std::size_t corner_count(const Region& region) {
    std::size_t count = 0;
    for (const Contour& contour : region.contours) count += contour.size();
    return count;
}

bool winds_around(const Contour& contour, Vec2 p) {
    bool inside = false;
    for (std::size_t i = 0, j = contour.size() - 1; i < contour.size(); j = i++) {
        const Vec2 a = contour[j], b = contour[i];
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x))
            inside = !inside;
    }
    return inside;
}

/// Contours by polygon: an outline first, then the holes directly inside it. A hole that finds no outline, because
/// it touches its own in a corner, becomes a polygon of its own: its triangles count negative and all is covered
/// once nevertheless.
std::vector<std::vector<std::size_t>> polygons_of(const Region& region) {
    std::vector<std::vector<std::size_t>> polygons;
    std::vector<double> size;
    for (const Contour& contour : region.contours) size.push_back(area(Region{{contour}}));
    for (std::size_t c = 0; c < size.size(); ++c)
        if (size[c] > 0) polygons.push_back({c});
    const std::size_t outlines = polygons.size();
    for (std::size_t c = 0; c < size.size(); ++c) {
        if (size[c] > 0) continue;
        std::size_t best = outlines;
        for (std::size_t p = 0; p < outlines; ++p)
            if (winds_around(region.contours[polygons[p][0]], region.contours[c][0]) &&
                (best == outlines || size[polygons[p][0]] < size[polygons[best][0]]))
                best = p;
        if (best == outlines)
            polygons.push_back({c});
        else
            polygons[best].push_back(c);
    }
    return polygons;
}

/// Adds the triangles of the region as a cap on the ring of vertices that begins at `first`.
void add_cap(mesh::Mesh& mesh, const Region& region, std::size_t first, bool facing_up) {
    std::vector<std::size_t> begin{first};
    std::vector<Vec3> flat(first);  // the region itself, numbered like the ring
    for (const Contour& contour : region.contours) {
        begin.push_back(begin.back() + contour.size());
        for (const Vec2& p : contour) flat.push_back({p.x, p.y, 0});
    }
    mesh::Triangulator triangulate;
    for (const std::vector<std::size_t>& polygon : polygons_of(region)) {
        std::vector<mesh::VertexIndex> corners;
        std::vector<std::uint32_t> contour_begin{0};
        for (const std::size_t c : polygon) {
            for (std::size_t v = begin[c]; v < begin[c + 1]; ++v)
                corners.push_back(static_cast<mesh::VertexIndex>(v));
            contour_begin.push_back(static_cast<std::uint32_t>(corners.size()));
        }
        for (mesh::Triangle t : triangulate(flat, corners, contour_begin).triangles) {
            if (!facing_up) std::swap(t[1], t[2]);
            mesh.triangles.push_back(t);
        }
    }
}

}  // namespace

double sin_degrees(double degrees) {
    double x = std::fmod(degrees, 360.0);
    if (x < 0) x += 360;
    double sign = 1;
    if (x >= 180) x -= 180, sign = -1;
    if (x > 90) x = 180 - x;
    if (x == 30) return sign * 0.5;
    if (x == 45) return sign * std::sqrt(0.5);
    if (x == 60) return sign * std::sqrt(0.75);
    return sign * (x > 45 ? std::cos((90 - x) * (pi / 180)) : std::sin(x * (pi / 180)));
}

double cos_degrees(double degrees) { return sin_degrees(90 - std::fabs(std::fmod(degrees, 360.0))); }

mesh::Mesh linear_extrude(const Region& region, const LinearExtrude& options) {
    mesh::Mesh mesh;
    if (region.empty() || !(options.height > 0)) return mesh;
    const int slices = std::max(options.slices, 1);
    const double bottom = options.centered ? -options.height / 2 : 0;
    for (int slice = 0; slice <= slices; ++slice) {
        const double t = static_cast<double>(slice) / slices;
        const double s = sin_degrees(-options.twist * t), c = cos_degrees(-options.twist * t);
        const double sx = 1 - (1 - options.scale.x) * t, sy = 1 - (1 - options.scale.y) * t;
        for (const Contour& contour : region.contours)
            for (const Vec2& p : contour)
                mesh.vertices.push_back(
                    {sx * (c * p.x - s * p.y), sy * (s * p.x + c * p.y), bottom + options.height * t});
    }
    const std::size_t ring = corner_count(region);
    for (int slice = 0; slice < slices; ++slice) {
        std::size_t first = static_cast<std::size_t>(slice) * ring;
        // The diagonal that makes the outer sides of a twisted solid bulge rather than dent.
        const bool rising = options.twist / slices < 0;
        for (const Contour& contour : region.contours) {
            const bool hole = area(Region{{contour}}) < 0;
            for (std::size_t i = 0; i < contour.size(); ++i) {
                const auto a = static_cast<mesh::VertexIndex>(first + i);
                const auto b = static_cast<mesh::VertexIndex>(first + (i + 1) % contour.size());
                const auto up = static_cast<mesh::VertexIndex>(ring);
                if (rising != hole) {
                    mesh.triangles.push_back({a, b, a + up});
                    mesh.triangles.push_back({a + up, b, b + up});
                } else {
                    mesh.triangles.push_back({a, b, b + up});
                    mesh.triangles.push_back({b + up, a + up, a});
                }
            }
            first += contour.size();
        }
    }
    add_cap(mesh, region, 0, false);
    add_cap(mesh, region, static_cast<std::size_t>(slices) * ring, true);
    return mesh;
}

int slices_of(const Region& region, const LinearExtrude& options, const Roundness& roundness) {
    constexpr double most = 100'000;
    double farthest = 0, longest_move = 0;
    for (const Contour& contour : region.contours)
        for (const Vec2& p : contour) {
            farthest = std::max(farthest, std::hypot(p.x, p.y));
            longest_move =
                std::max(longest_move, std::hypot(p.x * (1 - options.scale.x), p.y * (1 - options.scale.y)));
        }
    const double fa = std::max(roundness.fa, 0.01), fs = std::max(roundness.fs, 0.01);
    double slices = 1;
    const bool uneven = options.scale.x != options.scale.y;
    if (uneven && longest_move > 0)
        slices = roundness.fn > 0 ? std::floor(roundness.fn)
                                  : std::ceil(std::hypot(longest_move, options.height) / fs);
    if (options.twist != 0) {
        const double degrees = std::fabs(options.twist), turn = degrees * (pi / 180);
        double length = std::hypot(turn * farthest, options.height);
        if (!uneven && options.scale.x != 1) {
            // A spiral on a cone: a part of Archimedes' spiral, seen from above.
            const double scale = options.scale.x;
            const double end = scale > 1 ? turn * scale / (scale - 1) : turn / (1 - scale);
            const auto spiral = [](double a) { return 0.5 * (a * std::sqrt(1 + a * a) + std::asinh(a)); };
            length = std::hypot(farthest / end * (spiral(end) - spiral(end - turn)), options.height);
        }
        const double by_turn = roundness.fn > 0 ? std::ceil(degrees / 360 * roundness.fn)
                                                : std::min(std::ceil(degrees / fa), std::ceil(length / fs));
        slices = std::max({slices, by_turn, std::ceil(degrees / 120)});
    }
    return static_cast<int>(std::clamp(slices, 1.0, most));
}

Result<mesh::Mesh> rotate_extrude(const Region& region, const RotateExtrude& options) {
    mesh::Mesh mesh;
    if (region.empty() || options.angle == 0) return mesh;
    const Box3 box = bounds(region);
    if (box.low.x < 0 && box.high.x > 0)
        return Error{ErrorCode::bad_input, "the profile lies on both sides of the axis x = 0", {}};
    const bool whole = std::fabs(options.angle) >= 360;
    const int segments = std::max(options.segments, whole ? 3 : 1);
    const int rings = whole ? segments : segments + 1;
    // A full turn starts at −x, as OpenSCAD's does; it matters when there are few segments.
    const double start = whole ? 180 : 0, angle = whole ? 360 : options.angle;
    for (int ring = 0; ring < rings; ++ring) {
        const double at = start + angle * ring / segments;
        const double c = cos_degrees(at), s = sin_degrees(at);
        for (const Contour& contour : region.contours)
            for (const Vec2& p : contour) mesh.vertices.push_back({p.x * c, p.x * s, p.y});
    }
    const std::size_t count = corner_count(region);
    // Counter-clockwise sweep of a profile at x >= 0 has its outside to the right of the contour.
    const bool flipped = (box.low.x < 0) != (angle < 0);
    for (int segment = 0; segment < segments; ++segment) {
        std::size_t here = static_cast<std::size_t>(segment) * count;
        std::size_t there = static_cast<std::size_t>((segment + 1) % rings) * count;
        for (const Contour& contour : region.contours) {
            for (std::size_t i = 0; i < contour.size(); ++i) {
                const std::size_t j = (i + 1) % contour.size();
                const auto a = static_cast<mesh::VertexIndex>(here + i),
                           b = static_cast<mesh::VertexIndex>(here + j);
                const auto c = static_cast<mesh::VertexIndex>(there + i),
                           d = static_cast<mesh::VertexIndex>(there + j);
                const auto add = [&](mesh::VertexIndex p, mesh::VertexIndex q, mesh::VertexIndex r) {
                    if (flipped) std::swap(q, r);
                    mesh.triangles.push_back({p, q, r});
                };
                // Corners on the axis are points: their second triangle would be flat.
                if (contour[i].x != 0) add(a, c, d);
                if (contour[j].x != 0) add(a, d, b);
            }
            here += contour.size();
            there += contour.size();
        }
    }
    if (!whole) {
        // Seen from −y, where the sweep begins, the profile runs counter-clockwise.
        add_cap(mesh, region, 0, !flipped);
        add_cap(mesh, region, static_cast<std::size_t>(segments) * count, flipped);
    }
    return mesh;
}

}  // namespace octavo::csg
