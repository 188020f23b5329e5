// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include <octavo/csg/extrude.hpp>
#include <octavo/csg/tessellate.hpp>

namespace octavo::csg {
namespace {

/// The convex body between rings of `segments` corners (or single points) one above the other.
mesh::Mesh stack(const std::vector<std::pair<double, double>>& radius_and_height, int segments) {
    mesh::Mesh mesh;
    struct Ring {
        mesh::VertexIndex first, count;
    };
    std::vector<Ring> rings;
    for (const auto& [radius, height] : radius_and_height) {
        Ring ring{static_cast<mesh::VertexIndex>(mesh.vertices.size()), 1};
        if (radius == 0) {
            mesh.vertices.push_back({0, 0, height});
        } else {
            ring.count = static_cast<mesh::VertexIndex>(segments);
            for (const Vec2& p : circle(radius, segments)) mesh.vertices.push_back({p.x, p.y, height});
        }
        rings.push_back(ring);
    }
    const auto fan = [&](const Ring& ring, bool up) {
        for (mesh::VertexIndex i = 1; i + 1 < ring.count; ++i) {
            const mesh::VertexIndex a = ring.first, b = ring.first + i, c = ring.first + i + 1;
            mesh.triangles.push_back(up ? mesh::Triangle{a, b, c} : mesh::Triangle{a, c, b});
        }
    };
    fan(rings.front(), false);
    for (std::size_t r = 0; r + 1 < rings.size(); ++r) {
        const Ring &low = rings[r], &high = rings[r + 1];
        for (mesh::VertexIndex i = 0; i < static_cast<mesh::VertexIndex>(segments); ++i) {
            const auto at = [&](const Ring& ring, mesh::VertexIndex k) {
                return ring.first + k % ring.count;
            };
            if (low.count > 1) mesh.triangles.push_back({at(low, i), at(low, i + 1), at(high, i)});
            if (high.count > 1) mesh.triangles.push_back({at(high, i), at(low, i + 1), at(high, i + 1)});
        }
    }
    fan(rings.back(), true);
    return mesh;
}

}  // namespace

int segments_of(double radius, const Roundness& roundness) {
    constexpr double smallest_radius = 0x1p-20;  // OpenSCAD's grid
    constexpr double most = 1 << 20;             // more corners than a lattice can tell apart at any size
    if (!(radius >= smallest_radius) || !std::isfinite(roundness.fn)) return 3;
    if (roundness.fn > 0) return static_cast<int>(std::clamp(std::floor(roundness.fn), 3.0, most));
    const double by_angle = 360 / std::max(roundness.fa, 0.01);
    const double by_length = radius * 2 * std::acos(-1.0) / std::max(roundness.fs, 0.01);
    return static_cast<int>(std::min(std::ceil(std::max(std::min(by_angle, by_length), 5.0)), most));
}

Contour circle(double radius, int segments) {
    Contour contour;
    for (int i = 0; i < segments; ++i) {
        const double angle = 360.0 * i / segments;
        contour.push_back({radius * cos_degrees(angle), radius * sin_degrees(angle)});
    }
    return contour;
}

mesh::Mesh faceted_ball(double radius, int segments) {
    const int rings = (segments + 1) / 2;
    std::vector<std::pair<double, double>> stacked;
    for (int ring = rings; ring-- > 0;) {
        const double polar = 180 * (ring + 0.5) / rings;
        stacked.emplace_back(radius * sin_degrees(polar), radius * cos_degrees(polar));
    }
    return stack(stacked, segments);
}

mesh::Mesh faceted_frustum(double low, double high, double bottom, double top, int segments) {
    return stack({{bottom, low}, {top, high}}, segments);
}

mesh::Mesh cuboid_mesh(Vec3 low, Vec3 high) {
    mesh::Mesh mesh;
    for (int corner = 0; corner < 8; ++corner)
        mesh.vertices.push_back(
            {corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y, corner & 4 ? high.z : low.z});
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return mesh;
}

}  // namespace octavo::csg
