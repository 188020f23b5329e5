// SPDX-License-Identifier: Apache-2.0
#include <octavo/mesh/measure.hpp>
#include <octavo/mesh/topology.hpp>

namespace octavo::mesh {
namespace {

void fill_topology(Measures& measures, const Mesh& mesh) {
    const EdgeTable edges = build_edges(mesh.triangles, mesh.vertices.size());
    std::int64_t faces = 0;
    for (std::size_t face = 0; face < mesh.triangles.size(); ++face)
        faces += edges.edge_of_side[3 * face] != no_index;
    bool manifold = faces > 0;
    for (EdgeIndex edge = 0; edge < edges.size(); ++edge) {
        const auto sides = edges.sides_of(edge);
        manifold = manifold && sides.size() == 2 &&
                   runs_upward(mesh.triangles, sides[0]) != runs_upward(mesh.triangles, sides[1]);
    }
    measures.edges = static_cast<std::int64_t>(edges.size());
    measures.euler_number = measures.used_vertices - measures.edges + faces;
    measures.components = components_by_vertex(mesh.triangles, mesh.vertices.size()).count;
    // Surfaces that only touch in a vertex share it; each fan is a vertex of its own surface.
    if (!manifold) return;
    const std::vector<SideIndex> fans = fan_of_corner(edges, mesh.triangles);
    std::int64_t fan_count = 0;
    for (SideIndex corner = 0; corner < fans.size(); ++corner)
        fan_count += fans[corner] == corner && edges.edge_of_side[corner] != no_index;
    const std::int64_t euler = fan_count - measures.edges + faces;
    std::int64_t surfaces = 0;
    const Components by_edge = components_by_edge(edges, mesh.triangles.size());
    surfaces = by_edge.count - (static_cast<std::int64_t>(mesh.triangles.size()) - faces);
    measures.genus = surfaces - euler / 2;
}

}  // namespace

Moments moments(const Mesh& mesh) {
    Box3 bounds;
    for (const Triangle& t : mesh.triangles)
        for (const VertexIndex vertex : t) bounds.add(mesh.vertices[vertex]);
    if (bounds.empty()) return {};
    MomentSum sum(bounds, mesh.triangles.size());
    for (const Triangle& t : mesh.triangles)
        sum.add(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]);
    return sum.moments();
}

Measures measure(const Mesh& mesh) {
    Measures measures;
    const std::vector<bool> used = used_vertices(mesh.triangles, mesh.vertices.size());
    for (std::size_t vertex = 0; vertex < mesh.vertices.size(); ++vertex) {
        if (!used[vertex]) continue;
        measures.bounds.add(mesh.vertices[vertex]);
        ++measures.used_vertices;
    }
    fill_topology(measures, mesh);
    static_cast<Moments&>(measures) = moments(mesh);
    return measures;
}

exact::int128 exact_volume6(std::span<const exact::Point> points, std::span<const Triangle> triangles) {
    // Coordinates 26 bits → 2×2 minors 53 bits and a sign → determinant of three of them 81 → 2^32 facets
    // 113.
    static_assert(3 * exact::coordinate_bits + 3 + 32 < 127);
    exact::int128 sum = 0;
    for (const Triangle& t : triangles) {
        const exact::Point a = points[t[0]], b = points[t[1]], c = points[t[2]];
        const auto minor = [](std::int64_t p, std::int64_t q, std::int64_t r, std::int64_t s) {
            return p * s - q * r;
        };
        sum += exact::int128{a.x} * minor(b.y, b.z, c.y, c.z) +
               exact::int128{a.y} * minor(b.z, b.x, c.z, c.x) +
               exact::int128{a.z} * minor(b.x, b.y, c.x, c.y);
    }
    return sum;
}

exact::int128 exact_volume6(const LatticeMesh& mesh) { return exact_volume6(mesh.points, mesh.triangles); }

}  // namespace octavo::mesh
