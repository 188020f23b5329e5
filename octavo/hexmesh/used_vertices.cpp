// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <vector>

#include <octavo/hexmesh/used_vertices.hpp>

namespace octavo::hexmesh {

Box3 bounds_of_facets(std::span<const mesh::Mesh> solids) {
    Box3 bounds;
    for (const mesh::Mesh& solid : solids)
        for (const mesh::Triangle& triangle : solid.triangles)
            for (const mesh::VertexIndex vertex : triangle)
                if (vertex < solid.vertices.size()) bounds.add(solid.vertices[vertex]);
    return bounds;
}

std::optional<mesh::Mesh> with_unused_vertices_moved(const mesh::Mesh& solid) {
    std::vector<bool> is_used(solid.vertices.size(), false);
    std::optional<Vec3> place;
    for (const mesh::Triangle& triangle : solid.triangles)
        for (const mesh::VertexIndex vertex : triangle) {
            if (vertex >= solid.vertices.size()) continue;
            is_used[vertex] = true;
            if (!place) place = solid.vertices[vertex];
        }
    if (std::find(is_used.begin(), is_used.end(), false) == is_used.end()) return std::nullopt;
    mesh::Mesh moved = solid;
    if (!place) moved.vertices.clear();
    for (std::size_t i = 0; i < moved.vertices.size(); ++i)
        if (!is_used[i]) moved.vertices[i] = *place;
    return moved;
}

}  // namespace octavo::hexmesh
