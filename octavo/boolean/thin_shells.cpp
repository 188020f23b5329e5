// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <octavo/boolean/soup.hpp>
#include <octavo/boolean/thin_shells.hpp>
#include <octavo/mesh/disjoint_sets.hpp>

namespace octavo::boolean {
namespace {

struct Extent {
    double volume6 = 0, area2 = 0;
};

/// Of the shell of each vertex that stands for one. Volumes are taken from that vertex, so that they do not drown in
/// the distance from the origin, and in units of the tolerance, a lattice unit or so: in those of the world, squares of
/// areas would be no doubles from 1e77 on, nor above zero at 1e-81.
std::vector<Extent> extents(const mesh::Mesh& mesh, mesh::DisjointSets& shells, double tolerance) {
    std::vector<Extent> result(mesh.vertices.size());
    for (const mesh::Triangle& t : mesh.triangles) {
        const std::uint32_t shell = shells.find(t[0]);
        const auto corner = [&](std::size_t k) {
            const Vec3 offset = mesh.vertices[t[k]] - mesh.vertices[shell];
            return Vec3{offset.x / tolerance, offset.y / tolerance, offset.z / tolerance};
        };
        const Vec3 a = corner(0), b = corner(1), c = corner(2);
        result[shell].volume6 += dot(a, cross(b, c));
        result[shell].area2 += length(cross(b - a, c - a));
    }
    return result;
}

}  // namespace

ThinShells drop_thin_shells(mesh::Mesh& mesh, double tolerance) {
    mesh::DisjointSets shells(mesh.vertices.size());
    for (const mesh::Triangle& t : mesh.triangles) shells.unite(t[0], t[1]), shells.unite(t[1], t[2]);
    const std::vector<Extent> extent = extents(mesh, shells, tolerance);
    const auto is_thin = [&](std::uint32_t vertex) {
        const Extent& of = extent[shells.find(vertex)];
        return std::fabs(of.volume6) / 6 < 0.5 * of.area2 / 2;
    };
    ThinShells result;
    std::vector<std::uint32_t> vertex_number(mesh.vertices.size(), no_index);
    std::uint32_t vertices = 0, triangles = 0;
    for (std::uint32_t vertex = 0; vertex < mesh.vertices.size(); ++vertex) {
        if (is_thin(vertex)) {
            result.shells += shells.find(vertex) == vertex;
            continue;
        }
        vertex_number[vertex] = vertices;
        mesh.vertices[vertices++] = mesh.vertices[vertex];
    }
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        const mesh::Triangle t = mesh.triangles[i];
        if (vertex_number[t[0]] == no_index) {
            result.number.push_back(no_index);
            continue;
        }
        result.number.push_back(triangles);
        mesh.sources[triangles] = mesh.sources[i];
        mesh.triangles[triangles++] = {vertex_number[t[0]], vertex_number[t[1]], vertex_number[t[2]]};
    }
    mesh.vertices.resize(vertices), mesh.triangles.resize(triangles), mesh.sources.resize(triangles);
    return result;
}

}  // namespace octavo::boolean
