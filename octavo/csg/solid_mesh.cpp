// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

#include <octavo/csg/solid_mesh.hpp>

namespace octavo::csg {
namespace {

/// For each vertex, the least index of a vertex at its position.
std::vector<std::uint32_t> by_position(const std::vector<Vec3>& vertices) {
    std::vector<std::uint32_t> order(vertices.size()), name(vertices.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    // + 0.0 makes −0 and 0 one position.
    const auto key = [&](std::uint32_t i) {
        return std::make_tuple(vertices[i].x + 0.0, vertices[i].y + 0.0, vertices[i].z + 0.0);
    };
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return key(a) < key(b) || (key(a) == key(b) && a < b);
    });
    for (std::size_t i = 0; i < order.size(); ++i)
        name[order[i]] = i > 0 && key(order[i - 1]) == key(order[i]) ? name[order[i - 1]] : order[i];
    return name;
}

bool is_convex(const mesh::Mesh& mesh) {
    if (mesh.triangles.size() * mesh.vertices.size() > 4'000'000) return false;
    const Vec3 extents = mesh.bounds().extents();
    const double tolerance = 0x1p-34 * std::max({extents.x, extents.y, extents.z});
    for (const mesh::Triangle& triangle : mesh.triangles) {
        const Vec3 a = mesh.vertices[triangle[0]];
        const Vec3 normal = cross(mesh.vertices[triangle[1]] - a, mesh.vertices[triangle[2]] - a);
        const double norm = length(normal);
        if (!(norm > 0)) continue;
        for (const mesh::Triangle& other : mesh.triangles)
            for (const mesh::VertexIndex vertex : other)
                if (dot(normal, mesh.vertices[vertex] - a) > tolerance * norm) return false;
    }
    return six_volumes(mesh) > 0;
}

}  // namespace

bool is_closed(const mesh::Mesh& mesh) {
    const std::vector<std::uint32_t> name = by_position(mesh.vertices);
    std::vector<std::tuple<std::uint32_t, std::uint32_t, int>> edges;
    for (const mesh::Triangle& triangle : mesh.triangles)
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t a = name[triangle[i]], b = name[triangle[(i + 1) % 3]];
            if (a != b) edges.emplace_back(std::min(a, b), std::max(a, b), a < b ? 1 : -1);
        }
    std::sort(edges.begin(), edges.end());
    for (std::size_t i = 0; i < edges.size();) {
        int surplus = 0;
        const auto [a, b, first] = edges[i];
        for (; i < edges.size() && std::get<0>(edges[i]) == a && std::get<1>(edges[i]) == b; ++i)
            surplus += std::get<2>(edges[i]);
        if (surplus != 0) return false;
    }
    return true;
}

double six_volumes(const mesh::Mesh& mesh) {
    if (mesh.triangles.empty()) return 0;
    const Vec3 origin = mesh.vertices[mesh.triangles[0][0]];
    double sum = 0;
    for (const mesh::Triangle& triangle : mesh.triangles)
        sum += dot(mesh.vertices[triangle[0]] - origin,
                   cross(mesh.vertices[triangle[1]] - origin, mesh.vertices[triangle[2]] - origin));
    return sum;
}

Polyhedron as_polyhedron(mesh::Mesh mesh) {
    const Convexity convexity = is_convex(mesh) ? Convexity::convex : Convexity::any;
    return {std::make_shared<const mesh::Mesh>(std::move(mesh)), convexity};
}

}  // namespace octavo::csg
