// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <octavo/base/check.hpp>
#include <octavo/mesh/rings.hpp>
#include <octavo/mesh/shapes.hpp>

namespace octavo::mesh {
namespace {

/// cos and sin of 2π step / steps, exactly symmetric: computed in the first octant and reflected.
Point2D unit_circle_point(std::uint64_t step, std::uint64_t steps) {
    // The angle in eighths of a turn is 8 step / steps = octant + rest / steps.
    const std::uint64_t eighths = 8 * (step % steps);
    const std::uint64_t octant = eighths / steps;
    std::uint64_t rest = eighths % steps;
    if (octant % 2 == 1) rest = steps - rest;  // odd octants run backwards from their end
    const double angle = static_cast<double>(rest) / static_cast<double>(steps) * (std::numbers::pi / 4);
    double c = std::cos(angle), s = std::sin(angle);
    if (rest == steps) c = s = std::numbers::sqrt2 / 2;
    switch (octant) {
        case 0:
            return {c, s};
        case 1:
            return {s, c};
        case 2:
            return {-s, c};
        case 3:
            return {-c, s};
        case 4:
            return {-c, -s};
        case 5:
            return {-s, -c};
        case 6:
            return {s, -c};
        default:
            return {c, -s};
    }
}

}  // namespace

Mesh box(Vec3 low, Vec3 high) {
    OCTAVO_CHECK(low.x < high.x && low.y < high.y && low.z < high.z, "a box needs low < high on every axis");
    Mesh mesh;
    for (int corner = 0; corner < 8; ++corner)
        mesh.vertices.push_back(
            {corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y, corner & 4 ? high.z : low.z});
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return mesh;
}

Mesh cube(double side) {
    const double h = side / 2;
    return box({-h, -h, -h}, {h, h, h});
}

Mesh tetrahedron(double size) {
    OCTAVO_CHECK(size > 0, "a tetrahedron needs a positive size");
    const double s = size;
    return {
        {{s, s, s}, {s, -s, -s}, {-s, s, -s}, {-s, -s, s}}, {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}, {}};
}

Outline circle(double radius, std::uint32_t segments, Point2D centre) {
    OCTAVO_CHECK(radius > 0 && segments >= 3, "a circle needs a positive radius and three segments");
    Outline outline;
    for (std::uint32_t i = 0; i < segments; ++i) {
        const Point2D p = unit_circle_point(i, segments);
        outline.push_back({centre.x + radius * p.x, centre.y + radius * p.y});
    }
    return outline;
}

Mesh uv_sphere(double radius, std::uint32_t segments, std::uint32_t rings) {
    OCTAVO_CHECK(radius > 0 && segments >= 3 && rings >= 2, "a sphere needs 3 segments and 2 rings");
    RingBuilder builder;
    const VertexIndex south = builder.add_vertex({0, 0, -radius});
    std::vector<Ring> parallels;
    for (std::uint32_t i = 1; i < rings; ++i) {
        // Polar angle from the south pole, π i / rings.
        const Point2D p = unit_circle_point(i, 2 * std::uint64_t{rings});
        parallels.push_back(builder.add_ring(circle(radius * p.y, segments), -radius * p.x));
    }
    const VertexIndex north = builder.add_vertex({0, 0, radius});
    for (std::uint32_t i = 0; i < segments; ++i)
        builder.add_triangle(south, parallels[0][i + 1], parallels[0][i]);
    for (std::size_t i = 1; i < parallels.size(); ++i) builder.add_wall(parallels[i - 1], parallels[i]);
    builder.add_fan(parallels.back(), north);
    return builder.take();
}

Mesh cylinder(double radius, double height, std::uint32_t segments) {
    return cone(radius, radius, height, segments);
}

Mesh cone(double radius_low, double radius_high, double height, std::uint32_t segments) {
    OCTAVO_CHECK(radius_low >= 0 && radius_high >= 0 && radius_low + radius_high > 0 && height > 0,
                 "a cone needs a positive height and a positive radius");
    RingBuilder builder;
    if (radius_low == 0) {
        const VertexIndex apex = builder.add_vertex({0, 0, 0});
        const Ring top = builder.add_ring(circle(radius_high, segments), height);
        for (std::uint32_t i = 0; i < segments; ++i) builder.add_triangle(apex, top[i + 1], top[i]);
        builder.add_ceiling(top);
        return builder.take();
    }
    const Ring bottom = builder.add_ring(circle(radius_low, segments), 0);
    builder.add_floor(bottom);
    if (radius_high == 0) {
        builder.add_fan(bottom, builder.add_vertex({0, 0, height}));
    } else {
        const Ring top = builder.add_ring(circle(radius_high, segments), height);
        builder.add_wall(bottom, top);
        builder.add_ceiling(top);
    }
    return builder.take();
}

Mesh torus(double ring, double tube, std::uint32_t segments, std::uint32_t sides) {
    OCTAVO_CHECK(ring > tube && tube > 0 && segments >= 3 && sides >= 3,
                 "a torus needs ring > tube > 0, 3 segments and 3 sides");
    RingBuilder builder;
    std::vector<Ring> parallels;  // circles about z, following the tube's section from outside over the top
    for (std::uint32_t i = 0; i < sides; ++i) {
        const Point2D p = unit_circle_point(i, sides);
        parallels.push_back(builder.add_ring(circle(ring + tube * p.x, segments), tube * p.y));
    }
    for (std::uint32_t i = 0; i < sides; ++i) builder.add_wall(parallels[i], parallels[(i + 1) % sides]);
    return builder.take();
}

Mesh extrude(const Outline& outer, std::span<const Outline> holes, double height) {
    OCTAVO_CHECK(outer.size() >= 3 && height > 0, "an extrusion needs an outline and a positive height");
    RingBuilder builder;
    const Ring low = builder.add_ring(outer, 0), high = builder.add_ring(outer, height);
    builder.add_wall(low, high);
    std::vector<Ring> low_holes, high_holes;
    for (const Outline& hole : holes) {
        double area = 0;
        for (std::size_t i = 0; i < hole.size(); ++i) {
            const Point2D p = hole[i], q = hole[(i + 1) % hole.size()];
            area += (p.x - hole[0].x) * (q.y - hole[0].y) - (p.y - hole[0].y) * (q.x - hole[0].x);
        }
        Outline forward = hole;
        if (area < 0) std::reverse(forward.begin(), forward.end());
        low_holes.push_back(builder.add_ring(forward, 0));
        high_holes.push_back(builder.add_ring(forward, height));
        builder.add_wall(high_holes.back(), low_holes.back());
    }
    builder.add_floor(low, low_holes);
    builder.add_ceiling(high, high_holes);
    return builder.take();
}

Mesh knot_tube(std::uint32_t p, std::uint32_t q, double tube, std::uint32_t segments, std::uint32_t sides) {
    OCTAVO_CHECK(tube > 0 && segments >= 3 && sides >= 3 && p > 0, "a knot needs a tube and 3 segments");
    Mesh mesh;
    const auto centre_line = [&](std::uint32_t i) -> Vec3 {
        const Point2D u = unit_circle_point(std::uint64_t{p} * i, segments);
        const Point2D v = unit_circle_point(std::uint64_t{q} * i, segments);
        const double radius = 2 + v.x;
        return {radius * u.x, radius * u.y, v.y};
    };
    for (std::uint32_t i = 0; i < segments; ++i) {
        const Vec3 here = centre_line(i);
        const Vec3 along = centre_line(i + 1) - centre_line(i + segments - 1);
        // The frame leans on the direction away from the ring's centre, which comes back after one round, so
        // the tube closes without a twist.
        const Point2D u = unit_circle_point(std::uint64_t{p} * i, segments);
        const Vec3 outward = here - Vec3{2 * u.x, 2 * u.y, 0};
        const Vec3 side = cross(along, outward);
        const Vec3 e2 = (1 / length(side)) * side;
        const Vec3 lean = cross(e2, along);
        const Vec3 e1 = (1 / length(lean)) * lean;
        for (std::uint32_t k = 0; k < sides; ++k) {
            const Point2D c = unit_circle_point(k, sides);
            mesh.vertices.push_back(here + (tube * c.x) * e1 + (tube * c.y) * e2);
        }
    }
    for (std::uint32_t i = 0; i < segments; ++i) {
        const Ring from{i * sides, sides}, to{(i + 1) % segments * sides, sides};
        for (std::uint32_t k = 0; k < sides; ++k) {
            mesh.triangles.push_back({from[k], from[k + 1], to[k + 1]});
            mesh.triangles.push_back({from[k], to[k + 1], to[k]});
        }
    }
    return mesh;
}

}  // namespace octavo::mesh
