// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include <octavo/csg/flat_patch.hpp>

namespace octavo::csg {
namespace {

using Wide = __int128;
using Corner = std::array<std::int64_t, 3>;

Corner corner_of(const LatticePolyhedron& polyhedron, std::uint32_t triangle, std::size_t i) {
    const auto& p = polyhedron.points[polyhedron.triangles[triangle][i]];
    return {p[0], p[1], p[2]};
}

Corner normal_of(const LatticePolyhedron& polyhedron, std::uint32_t triangle) {
    const Corner a = corner_of(polyhedron, triangle, 0), b = corner_of(polyhedron, triangle, 1),
                 c = corner_of(polyhedron, triangle, 2);
    const Corner u{b[0] - a[0], b[1] - a[1], b[2] - a[2]}, v{c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

Wide height(const Corner& normal, const Corner& on_plane, const Corner& p) {
    return Wide{normal[0]} * (p[0] - on_plane[0]) + Wide{normal[1]} * (p[1] - on_plane[1]) +
           Wide{normal[2]} * (p[2] - on_plane[2]);
}

/// The part of a polygon where sign · coordinate <= sign · bound, in doubles.
std::vector<std::array<double, 3>> clip(const std::vector<std::array<double, 3>>& polygon, std::size_t axis,
                                        double bound, double sign) {
    std::vector<std::array<double, 3>> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const auto& p = polygon[i];
        const auto& q = polygon[(i + 1) % polygon.size()];
        const double hp = sign * (bound - p[axis]), hq = sign * (bound - q[axis]);
        if (hp >= 0) kept.push_back(p);
        if ((hp > 0 && hq < 0) || (hp < 0 && hq > 0)) {
            const double t = hp / (hp - hq);
            kept.push_back({p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1]), p[2] + t * (q[2] - p[2])});
        }
    }
    return kept;
}

/// A point of the triangle inside the cell, as good as doubles find one.
std::optional<std::array<double, 3>> point_in_cell(const LatticePolyhedron& polyhedron,
                                                   std::uint32_t triangle, const octree::Cell& cell) {
    std::vector<std::array<double, 3>> polygon;
    for (std::size_t i = 0; i < 3; ++i) {
        const Corner c = corner_of(polyhedron, triangle, i);
        polygon.push_back({static_cast<double>(c[0]), static_cast<double>(c[1]), static_cast<double>(c[2])});
    }
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        polygon = clip(polygon, a, cell.low[axis], -1);
        polygon = clip(polygon, a, cell.high()[axis], 1);
    }
    if (polygon.size() < 3) return {};
    // A mean with uneven weights, so that it does not fall on the diagonal that two triangles share.
    std::array<double, 3> mean{};
    double weights = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const double weight = 1.0 + 0.37 * static_cast<double>(i);
        weights += weight;
        for (std::size_t a = 0; a < 3; ++a) mean[a] += weight * polygon[i][a];
    }
    for (double& m : mean) m /= weights;
    return mean;
}

/// Whether the triangle covers the point, both seen along an axis; nothing when an edge is too near to tell. The
/// projected coordinates are below 2^29, so a turn is right beyond 2^29 · 2^30 · 2^-50 = 2^9.
std::optional<bool> covers(const LatticePolyhedron& polyhedron, std::uint32_t triangle,
                           const std::array<double, 3>& p, std::size_t b, std::size_t c) {
    constexpr double certain = 4096;
    int positive = 0, negative = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Corner u = corner_of(polyhedron, triangle, i), v = corner_of(polyhedron, triangle, (i + 1) % 3);
        const double turn = static_cast<double>(v[b] - u[b]) * (p[c] - static_cast<double>(u[c])) -
                            static_cast<double>(v[c] - u[c]) * (p[b] - static_cast<double>(u[b]));
        if (std::fabs(turn) <= certain) return {};
        ++(turn > 0 ? positive : negative);
    }
    return positive == 3 || negative == 3;
}

}  // namespace

FlatPatch flat_patch(const LatticePolyhedron& polyhedron, const octree::Cell& cell, std::int32_t winding,
                     std::span<const std::uint32_t> triangles) {
    const Corner normal = normal_of(polyhedron, triangles[0]);
    const Corner base = corner_of(polyhedron, triangles[0], 0);
    for (const std::uint32_t triangle : triangles)
        for (std::size_t i = 0; i < 3; ++i)
            if (height(normal, base, corner_of(polyhedron, triangle, i)) != 0) return {};

    std::size_t axis = 0;
    for (std::size_t a = 1; a < 3; ++a)
        if (std::abs(normal[a]) > std::abs(normal[axis])) axis = a;
    const std::optional<std::array<double, 3>> point = point_in_cell(polyhedron, triangles[0], cell);
    if (!point) return {};
    std::int32_t covering = 0;
    for (const std::uint32_t triangle : triangles) {
        const std::optional<bool> covered =
            covers(polyhedron, triangle, *point, (axis + 1) % 3, (axis + 2) % 3);
        if (!covered) return {};
        if (*covered) covering += (normal_of(polyhedron, triangle)[axis] > 0) == (normal[axis] > 0) ? 1 : -1;
    }
    // The reference point of a cell is half a unit beyond its middle and is moved by (e, e², e³); see
    // lattice_polyhedron.hpp. All doubled here.
    const exact::Point middle = cell.centre();
    const Corner base2{2 * base[0], 2 * base[1], 2 * base[2]};
    Wide side = height(
        normal, base2,
        {2 * std::int64_t{middle.x} + 1, 2 * std::int64_t{middle.y} + 1, 2 * std::int64_t{middle.z} + 1});
    for (std::size_t a = 0; a < 3 && side == 0; ++a) side = normal[a];
    const std::int32_t below = side > 0 ? winding + covering : winding;
    const std::int32_t above = side > 0 ? winding : winding - covering;

    FlatPatch patch;
    if ((below > 0) == (above > 0)) {
        patch.kind = FlatPatch::Kind::constant;
        patch.inside = below > 0;
        return patch;
    }
    const double turn = below > 0 ? -1 : 1;  // inside is where the normal does not point
    const SnappedPlane snapped = snap_plane(
        turn * Vec3{static_cast<double>(normal[0]), static_cast<double>(normal[1]),
                    static_cast<double>(normal[2])},
        {static_cast<double>(base[0]), static_cast<double>(base[1]), static_cast<double>(base[2])});
    if (!snapped.plane) return {};
    patch.kind = FlatPatch::Kind::plane;
    patch.plane = *snapped.plane;
    return patch;
}

}  // namespace octavo::csg
