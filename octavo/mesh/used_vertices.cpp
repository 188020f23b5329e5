// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <vector>

#include <octavo/mesh/topology.hpp>
#include <octavo/mesh/used_vertices.hpp>

namespace octavo::mesh {

Box3 bounds_of_facets(const Mesh& mesh) {
    Box3 box;
    for (const Triangle& triangle : mesh.triangles)
        for (const VertexIndex vertex : triangle)
            if (vertex < mesh.vertices.size()) box.add(mesh.vertices[vertex]);
    return box;
}

Box3 bounds_of_facets(std::span<const Mesh> meshes) {
    Box3 box;
    for (const Mesh& mesh : meshes) box.add(bounds_of_facets(mesh));
    return box;
}

Mesh without_unused_vertices(Mesh mesh) {
    const std::vector<bool> used = used_vertices(mesh.triangles, mesh.vertices.size());
    if (std::find(used.begin(), used.end(), false) == used.end()) return mesh;
    std::vector<VertexIndex> index(mesh.vertices.size());
    VertexIndex kept = 0;
    for (std::size_t vertex = 0; vertex < index.size(); ++vertex) {
        if (!used[vertex]) continue;
        mesh.vertices[kept] = mesh.vertices[vertex];
        index[vertex] = kept++;
    }
    mesh.vertices.resize(kept);
    for (Triangle& triangle : mesh.triangles)
        for (VertexIndex& vertex : triangle) vertex = index[vertex];
    return mesh;
}

}  // namespace octavo::mesh
