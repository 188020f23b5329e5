// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <octavo/csg/lattice_polyhedron.hpp>

namespace octavo::csg {
namespace {

using Wide = __int128;
using Corner = std::array<std::int64_t, 3>;  // doubled lattice coordinates

Corner doubled(const std::array<std::int32_t, 3>& p) {
    return {2 * std::int64_t{p[0]}, 2 * std::int64_t{p[1]}, 2 * std::int64_t{p[2]}};
}

Corner minus(const Corner& a, const Corner& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

Corner cross(const Corner& a, const Corner& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// A point inside the cell at odd doubled coordinates, so that no vertex shares one with it.
Corner reference(const octree::Cell& cell) {
    const std::int64_t half = cell.side() | 1;
    return {2 * std::int64_t{cell.low.x} + half, 2 * std::int64_t{cell.low.y} + half,
            2 * std::int64_t{cell.low.z} + half};
}

/// Whether the interval of the three values keeps off the open interval (-radius, radius).
bool is_off(std::int64_t a, std::int64_t b, std::int64_t c, std::int64_t radius) {
    return std::min({a, b, c}) >= radius || std::max({a, b, c}) <= -radius;
}

/// Separating axes that are cross products of an edge and a coordinate axis. `v` are the corners relative to the
/// cell's middle, `half` its half side, all doubled.
bool edges_separate(const std::array<Corner, 3>& v, std::int64_t half) {
    for (std::size_t e = 0; e < 3; ++e) {
        const Corner edge = minus(v[(e + 1) % 3], v[e]);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::size_t b = (axis + 1) % 3, c = (axis + 2) % 3;
            const auto value = [&](const Corner& p) { return edge[b] * p[c] - edge[c] * p[b]; };
            const std::int64_t radius = half * (std::abs(edge[b]) + std::abs(edge[c]));
            // A projection to a point at the middle separates nothing unless the radius is positive.
            if (radius > 0 && is_off(value(v[0]), value(v[1]), value(v[2]), radius)) return true;
        }
    }
    return false;
}

bool plane_separates(const std::array<Corner, 3>& v, std::int64_t half) {
    const Corner n = cross(minus(v[1], v[0]), minus(v[2], v[0]));
    const Wide value = Wide{n[0]} * v[0][0] + Wide{n[1]} * v[0][1] + Wide{n[2]} * v[0][2];
    const Wide radius = Wide{half} * (Wide{std::abs(n[0])} + Wide{std::abs(n[1])} + Wide{std::abs(n[2])});
    return value >= radius || value <= -radius;
}

/// Sign of (v − u) × (p − u) in the plane of the axes b, c, with p moved by the symbolic vector.
int turn(const Corner& u, const Corner& v, const Corner& p, std::size_t b, std::size_t c) {
    const std::int64_t db = v[b] - u[b], dc = v[c] - u[c];
    const std::int64_t value = db * (p[c] - u[c]) - dc * (p[b] - u[b]);
    if (value != 0) return value > 0 ? 1 : -1;
    const int first = b < c ? (dc > 0 ? -1 : dc < 0 ? 1 : 0) : (db > 0 ? 1 : db < 0 ? -1 : 0);
    if (first != 0) return first;
    return b < c ? (db > 0 ? 1 : db < 0 ? -1 : 0) : (dc > 0 ? -1 : dc < 0 ? 1 : 0);
}

/// On which side of the plane the moved point lies: positive is where the normal points.
int side(const Corner& normal, const Corner& on_plane, const Corner& p) {
    const Wide value = Wide{normal[0]} * (p[0] - on_plane[0]) + Wide{normal[1]} * (p[1] - on_plane[1]) +
                       Wide{normal[2]} * (p[2] - on_plane[2]);
    if (value != 0) return value > 0 ? 1 : -1;
    for (const std::int64_t component : normal)
        if (component != 0) return component > 0 ? 1 : -1;
    return 0;
}

/// What the winding number changes by on the way from `from` along `axis` to the coordinate `to`.
std::int32_t crossing(const std::array<Corner, 3>& v, const Corner& from, std::size_t axis, std::int64_t to) {
    const std::size_t b = (axis + 1) % 3, c = (axis + 2) % 3;
    for (const std::size_t other : {b, c})
        if (std::min({v[0][other], v[1][other], v[2][other]}) > from[other] ||
            std::max({v[0][other], v[1][other], v[2][other]}) < from[other])
            return 0;
    if (std::min({v[0][axis], v[1][axis], v[2][axis]}) > std::max(from[axis], to) ||
        std::max({v[0][axis], v[1][axis], v[2][axis]}) < std::min(from[axis], to))
        return 0;
    const int sign = turn(v[0], v[1], from, b, c);
    if (sign == 0 || turn(v[1], v[2], from, b, c) != sign || turn(v[2], v[0], from, b, c) != sign) return 0;
    const Corner normal = cross(minus(v[1], v[0]), minus(v[2], v[0]));
    Corner end = from;
    end[axis] = to;
    const int before = side(normal, v[0], from), after = side(normal, v[0], end);
    // From the outside, where the normal points, to the inside: once more around.
    return before == after ? 0 : before > 0 ? 1 : -1;
}

}  // namespace

std::uint8_t LatticePolyhedron::octants_met(std::uint32_t triangle, const octree::Cell& parent) const {
    std::array<Corner, 3> corner;
    for (std::size_t i = 0; i < 3; ++i) corner[i] = doubled(points[triangles[triangle][i]]);
    const std::int64_t half = parent.side() / 2;  // of a child, doubled
    constexpr std::array<std::array<std::uint8_t, 2>, 3> halves{{{0x55, 0xAA}, {0x33, 0xCC}, {0x0F, 0xF0}}};
    std::uint8_t met = 0xFF;
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        const std::int64_t low = 2 * std::int64_t{parent.low[axis]};
        const std::int64_t least = std::min({corner[0][a], corner[1][a], corner[2][a]});
        const std::int64_t most = std::max({corner[0][a], corner[1][a], corner[2][a]});
        for (std::size_t h = 0; h < 2; ++h) {
            const std::int64_t begin = low + static_cast<std::int64_t>(h) * 2 * half, end = begin + 2 * half;
            if (most <= begin || least >= end) met = static_cast<std::uint8_t>(met & ~halves[a][h]);
        }
    }
    for (int octant = 0; octant < 8; ++octant) {
        if (!(met >> octant & 1)) continue;
        std::array<Corner, 3> v = corner;
        for (std::size_t a = 0; a < 3; ++a) {
            const std::int64_t middle =
                2 * std::int64_t{parent.low[static_cast<int>(a)]} + (octant >> a & 1 ? 3 : 1) * half;
            for (Corner& p : v) p[a] -= middle;
        }
        if (edges_separate(v, half) || plane_separates(v, half))
            met = static_cast<std::uint8_t>(met & ~(1U << octant));
    }
    return met;
}

std::int32_t LatticePolyhedron::winding_of_universe() const {
    Corner start = reference(octree::Cell::root());
    const std::int64_t end = start[0];
    start[0] = -2 * std::int64_t{reach} - 1;
    std::int32_t winding = 0;
    for (const mesh::Triangle& triangle : triangles)
        winding += crossing(
            {doubled(points[triangle[0]]), doubled(points[triangle[1]]), doubled(points[triangle[2]])}, start,
            0, end);
    return winding;
}

std::array<std::int32_t, 8> LatticePolyhedron::windings(const octree::Cell& parent, std::int32_t winding,
                                                        const std::uint32_t* triangle_ids,
                                                        std::size_t count) const {
    const Corner from = reference(parent);
    const std::array<Corner, 2> to{reference(parent.child(0)), reference(parent.child(7))};
    std::array<std::int32_t, 8> result;
    result.fill(winding);
    for (std::size_t i = 0; i < count; ++i) {
        const mesh::Triangle& triangle = triangles[triangle_ids[i]];
        const std::array<Corner, 3> v{doubled(points[triangle[0]]), doubled(points[triangle[1]]),
                                      doubled(points[triangle[2]])};
        // Along x, then y, then z: octants share the first parts of their walks.
        for (std::size_t x = 0; x < 2; ++x) {
            const std::int32_t along_x = crossing(v, from, 0, to[x][0]);
            for (std::size_t y = 0; y < 2; ++y) {
                const std::int32_t along_y = crossing(v, {to[x][0], from[1], from[2]}, 1, to[y][1]);
                for (std::size_t z = 0; z < 2; ++z)
                    result[x + 2 * y + 4 * z] +=
                        along_x + along_y + crossing(v, {to[x][0], to[y][1], from[2]}, 2, to[z][2]);
            }
        }
    }
    return result;
}

Result<LatticePolyhedron> snap_polyhedron(const mesh::Mesh& mesh, const Affine& place,
                                          const exact::Lattice& lattice) {
    LatticePolyhedron result;
    result.points.reserve(mesh.vertices.size());
    for (const Vec3& vertex : mesh.vertices) {
        const Vec3 world = place(vertex);
        std::array<std::int32_t, 3> point{};
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            const double local =
                std::nearbyint(world[axis] / lattice.unit()) - static_cast<double>(lattice.origin()[a]);
            if (!(std::fabs(local) <= LatticePolyhedron::reach))
                return Error{
                    ErrorCode::limit, "a polyhedron reaches more than four times as far as the universe", {}};
            point[a] = static_cast<std::int32_t>(local);
        }
        result.points.push_back(point);
    }
    const bool mirrors = place.mirrors();
    result.triangles.reserve(mesh.triangles.size());
    for (mesh::Triangle triangle : mesh.triangles) {
        if (mirrors) std::swap(triangle[1], triangle[2]);
        const Corner origin = doubled(result.points[triangle[0]]);
        const Corner normal = cross(minus(doubled(result.points[triangle[1]]), origin),
                                    minus(doubled(result.points[triangle[2]]), origin));
        if (normal != Corner{}) result.triangles.push_back(triangle);
    }
    return result;
}

}  // namespace octavo::csg
