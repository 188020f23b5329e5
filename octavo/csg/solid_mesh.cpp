// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include <octavo/base/any_scale.hpp>
#include <octavo/csg/solid_mesh.hpp>
#include <octavo/mesh/used_vertices.hpp>
#include <octavo/mesh/weld.hpp>

namespace octavo::csg {
namespace {

bool is_convex(const mesh::Mesh& mesh) {
    if (mesh.triangles.size() * mesh.vertices.size() > 4'000'000) return false;
    const Vec3 extents = mesh::bounds_of_facets(mesh).extents();
    const double tolerance = 0x1p-34 * std::max({extents.x, extents.y, extents.z});
    for (const mesh::Triangle& triangle : mesh.triangles) {
        const Vec3 a = mesh.vertices[triangle[0]];
        const Vec3 normal = cross_direction(mesh.vertices[triangle[1]] - a, mesh.vertices[triangle[2]] - a);
        const double norm = length(normal);
        if (!(norm > 0)) continue;
        for (const mesh::Triangle& other : mesh.triangles)
            for (const mesh::VertexIndex vertex : other)
                if (dot(normal, mesh.vertices[vertex] - a) > tolerance * norm) return false;
    }
    return volume_sign(mesh) > 0;
}

/// Of the mesh made larger by `scale`.
double six_volumes(const mesh::Mesh& mesh, double scale) {
    if (mesh.triangles.empty()) return 0;
    const Vec3 origin = mesh.vertices[mesh.triangles[0][0]];
    const auto at = [&](mesh::VertexIndex vertex) { return scale * (mesh.vertices[vertex] - origin); };
    double sum = 0;
    for (const mesh::Triangle& triangle : mesh.triangles)
        sum += dot(at(triangle[0]), cross(at(triangle[1]), at(triangle[2])));
    return sum;
}

}  // namespace

bool is_closed(const mesh::Mesh& mesh) {
    const std::vector<mesh::VertexIndex> name = mesh::equal_vertices(mesh.vertices).index;
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

mesh::Mesh weld_near(const mesh::Mesh& mesh, double grid) {
    // Each vertex looks for one before it in its own cell of the grid and the 26 around.
    std::map<std::array<std::int64_t, 3>, mesh::VertexIndex> first_in;
    mesh::Mesh welded;
    std::vector<mesh::VertexIndex> name;
    for (const Vec3& vertex : mesh.vertices) {
        std::array<std::int64_t, 3> cell{};
        for (int axis = 0; axis < 3; ++axis)
            cell[static_cast<std::size_t>(axis)] =
                static_cast<std::int64_t>(std::clamp(std::floor(vertex[axis] / grid), -0x1p62, 0x1p62));
        auto found = first_in.end();
        for (int around = 0; around < 27 && found == first_in.end(); ++around)
            found = first_in.find(
                {cell[0] + around % 3 - 1, cell[1] + around / 3 % 3 - 1, cell[2] + around / 9 - 1});
        if (found == first_in.end()) {
            found = first_in.emplace(cell, static_cast<mesh::VertexIndex>(welded.vertices.size())).first;
            welded.vertices.push_back(vertex);
        }
        name.push_back(found->second);
    }
    for (const mesh::Triangle& t : mesh.triangles) {
        const mesh::Triangle renamed{name[t[0]], name[t[1]], name[t[2]]};
        if (renamed[0] != renamed[1] && renamed[1] != renamed[2] && renamed[2] != renamed[0])
            welded.triangles.push_back(renamed);
    }
    return welded;
}

double six_volumes(const mesh::Mesh& mesh) { return six_volumes(mesh, 1); }

int volume_sign(const mesh::Mesh& mesh) {
    const Vec3 extents = mesh::bounds_of_facets(mesh).extents();
    const double longest = std::max({extents.x, extents.y, extents.z});
    if (!(longest > 0)) return 0;
    // Cubes of lengths vanish below 1e-108 and overflow beyond 1e102.
    constexpr int most = 1000;
    const double volume = six_volumes(mesh, std::ldexp(1.0, std::min(most, -std::ilogb(longest))));
    return volume > 0 ? 1 : volume < 0 ? -1 : 0;
}

Polyhedron as_polyhedron(mesh::Mesh mesh) {
    mesh = mesh::without_unused_vertices(std::move(mesh));
    const Convexity convexity = is_convex(mesh) ? Convexity::convex : Convexity::any;
    return {std::make_shared<const mesh::Mesh>(std::move(mesh)), convexity};
}

}  // namespace octavo::csg
