// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string>

#include <octavo/classic/facet.hpp>
#include <octavo/exact/orient.hpp>

namespace octavo::classic {
namespace {

bool in_universe(exact::Point p) {
    const auto inside = [](std::int32_t v) { return v >= 0 && v < exact::universe_side; };
    return inside(p.x) && inside(p.y) && inside(p.z);
}

}  // namespace

Status check_places(const mesh::LatticeMesh& mesh) {
    for (const exact::Point& point : mesh.points)
        if (!in_universe(point))
            return Error{ErrorCode::bad_input,
                         "point " + std::to_string(&point - mesh.points.data()) +
                             " of the mesh lies outside the lattice's universe",
                         {}};
    for (std::uint32_t index = 0; index < mesh.triangles.size(); ++index) {
        for (const mesh::VertexIndex vertex : mesh.triangles[index]) {
            if (vertex < mesh.points.size()) continue;
            Error error{ErrorCode::bad_input,
                        "triangle " + std::to_string(index) + " names vertex " + std::to_string(vertex) +
                            " of " + std::to_string(mesh.points.size()),
                        {}};
            error.place.faces = {index};
            return error;
        }
    }
    return Done{};
}

Result<std::vector<Facet>> facets_of(const mesh::LatticeMesh& mesh) {
    if (const Status placed = check_places(mesh); !placed) return placed.error();
    std::vector<Facet> facets;
    facets.reserve(mesh.triangles.size());
    for (std::uint32_t index = 0; index < mesh.triangles.size(); ++index) {
        Facet facet;
        facet.source = index;
        for (std::size_t i = 0; i < 3; ++i) {
            const exact::Point p = mesh.points[mesh.triangles[index][i]];
            facet.corner[i] = {p.x, p.y, p.z};
        }
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto [a, b, c] =
                std::array{facet.corner[0][axis], facet.corner[1][axis], facet.corner[2][axis]};
            facet.low[axis] = std::min({a, b, c});
            facet.high[axis] = std::max({a, b, c});
        }
        if (!normal_of(facet).is_zero()) facets.push_back(facet);
    }
    return facets;
}

Status check_some_have_area(const mesh::LatticeMesh& mesh) {
    const auto is_flat = [&](const mesh::Triangle& t) {
        return exact::collinear(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
    };
    if (mesh.triangles.empty() || !std::all_of(mesh.triangles.begin(), mesh.triangles.end(), is_flat))
        return Done{};
    Error error{ErrorCode::not_a_solid, "the surface encloses nothing: none of its facets has any area", {}};
    error.place.faces = {0};
    return error;
}

}  // namespace octavo::classic
