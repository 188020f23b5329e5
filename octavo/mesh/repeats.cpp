// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include <octavo/mesh/repeats.hpp>

namespace octavo::mesh {

std::vector<std::vector<FaceIndex>> groups_of_repeated_facets(std::span<const Triangle> triangles,
                                                              const EdgeTable& edges) {
    std::vector<std::vector<FaceIndex>> groups;
    std::vector<std::pair<VertexIndex, FaceIndex>> at_edge;
    for (EdgeIndex edge = 0; edge < edges.size(); ++edge) {
        const std::span<const SideIndex> sides = edges.sides_of(edge);
        if (sides.size() < 2) continue;
        at_edge.clear();
        // Each facet once: at the edge of its two lowest vertices, where the third tells it from others.
        for (const SideIndex side : sides) {
            const VertexIndex third = triangles[side / 3][(side % 3 + 2) % 3];
            if (third > edges.ends[edge][1]) at_edge.push_back({third, side / 3});
        }
        std::sort(at_edge.begin(), at_edge.end());
        for (std::size_t i = 0; i < at_edge.size();) {
            std::size_t j = i;
            while (j < at_edge.size() && at_edge[j].first == at_edge[i].first) ++j;
            if (j - i > 1) {
                std::vector<FaceIndex>& group = groups.emplace_back();
                for (std::size_t k = i; k < j; ++k) group.push_back(at_edge[k].second);
            }
            i = j;
        }
    }
    return groups;
}

}  // namespace octavo::mesh
