// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <utility>

#include <octavo/exact/orient.hpp>
#include <octavo/mesh/weld.hpp>
#include <octavo/query/bare_facets.hpp>

namespace octavo::query {
namespace {

using exact::Point;

/// The ends of what has no area, by numbers of places; equal for a point.
using Segment = std::array<mesh::VertexIndex, 2>;

Segment segment_of(mesh::VertexIndex a, mesh::VertexIndex b) { return {std::min(a, b), std::max(a, b)}; }

classic::Facet facet_of(Point a, Point b) {
    classic::Facet facet;
    facet.corner = {{{a.x, a.y, a.z}, {b.x, b.y, b.z}, {b.x, b.y, b.z}}};
    facet.low = {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
    facet.high = {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
    return facet;
}

}  // namespace

std::vector<classic::Facet> bare_facets(const mesh::LatticeMesh& mesh,
                                        std::span<const classic::Facet> with_area) {
    if (with_area.size() == mesh.triangles.size()) return {};
    const mesh::WeldMap places = mesh::equal_vertices(mesh.points);
    std::vector<Segment> segments;
    std::vector<bool> is_end(places.kept.size());
    for (const mesh::Triangle& t : mesh.triangles) {
        if (!exact::collinear(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]])) continue;
        const auto [first, last] = std::minmax_element(
            t.begin(), t.end(), [&](auto a, auto b) { return mesh.points[a] < mesh.points[b]; });
        segments.push_back(segment_of(places.index[*first], places.index[*last]));
        is_end[segments.back()[0]] = is_end[segments.back()[1]] = true;
    }
    std::sort(segments.begin(), segments.end());
    segments.erase(std::unique(segments.begin(), segments.end()), segments.end());

    std::vector<bool> is_covered(segments.size());
    const auto cover = [&](mesh::VertexIndex a, mesh::VertexIndex b) {
        if (!is_end[a] || !is_end[b]) return;
        const auto found = std::lower_bound(segments.begin(), segments.end(), segment_of(a, b));
        if (found != segments.end() && *found == segment_of(a, b))
            is_covered[static_cast<std::size_t>(found - segments.begin())] = true;
    };
    for (const classic::Facet& facet : with_area) {
        const mesh::Triangle& t = mesh.triangles[facet.source];
        for (std::size_t i = 0; i < 3; ++i) {
            const mesh::VertexIndex a = places.index[t[i]];
            cover(a, a);
            cover(a, places.index[t[(i + 1) % 3]]);
        }
    }
    std::vector<classic::Facet> bare;
    for (std::size_t i = 0; i < segments.size(); ++i)
        if (!is_covered[i])
            bare.push_back(
                facet_of(mesh.points[places.kept[segments[i][0]]], mesh.points[places.kept[segments[i][1]]]));
    return bare;
}

}  // namespace octavo::query
