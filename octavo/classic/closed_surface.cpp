// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <numeric>
#include <string>

#include <octavo/classic/closed_surface.hpp>
#include <octavo/mesh/disjoint_sets.hpp>

namespace octavo::classic {
namespace {

using mesh::FaceIndex;
using mesh::VertexIndex;

/// A use of an edge, filed under its lower vertex.
struct Use {
    VertexIndex higher;
    std::int32_t direction;  // +1 from the lower vertex to the higher, −1 back
    FaceIndex face;
};

/// The edges whose uses do not cancel. `name` maps vertices to the one that stands for them.
template <class Name>
std::vector<OpenEdge> unbalanced_edges(const mesh::LatticeMesh& mesh, const Name& name) {
    // Uses by lower vertex: a counting sort, then each bucket of six or so is sorted by the higher vertex.
    std::vector<std::uint32_t> begin(mesh.points.size() + 1, 0);
    const auto for_each_edge = [&](const auto& visit) {
        for (FaceIndex face = 0; face < mesh.triangles.size(); ++face)
            for (std::size_t i = 0; i < 3; ++i) {
                const VertexIndex from = name(mesh.triangles[face][i]),
                                  to = name(mesh.triangles[face][(i + 1) % 3]);
                if (from != to) visit(from, to, face);
            }
    };
    for_each_edge([&](VertexIndex from, VertexIndex to, FaceIndex) { ++begin[std::min(from, to) + 1]; });
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    std::vector<Use> uses(begin.back());
    std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
    for_each_edge([&](VertexIndex from, VertexIndex to, FaceIndex face) {
        uses[next[std::min(from, to)]++] = {std::max(from, to), from < to ? 1 : -1, face};
    });

    std::vector<OpenEdge> open;
    for (VertexIndex vertex = 0; vertex < mesh.points.size(); ++vertex) {
        const auto first = uses.begin() + begin[vertex], last = uses.begin() + begin[vertex + 1];
        std::sort(first, last, [](const Use& a, const Use& b) {
            return a.higher != b.higher ? a.higher < b.higher : a.face < b.face;
        });
        for (auto use = first; use != last;) {
            const auto group = use;
            std::int32_t balance = 0;
            for (; use != last && use->higher == group->higher; ++use) balance += use->direction;
            if (balance > 0) open.push_back({vertex, group->higher, balance, group->face});
            if (balance < 0) open.push_back({group->higher, vertex, -balance, group->face});
        }
    }
    return open;
}

/// For each vertex the lowest one at the same lattice point.
std::vector<VertexIndex> coincident_vertices(const std::vector<exact::Point>& points) {
    std::vector<VertexIndex> order(points.size()), lowest(points.size());
    std::iota(order.begin(), order.end(), VertexIndex{0});
    std::sort(order.begin(), order.end(), [&](VertexIndex a, VertexIndex b) {
        return points[a] != points[b] ? points[a] < points[b] : a < b;
    });
    for (std::size_t i = 0; i < order.size(); ++i)
        lowest[order[i]] =
            i > 0 && points[order[i]] == points[order[i - 1]] ? lowest[order[i - 1]] : order[i];
    return lowest;
}

}  // namespace

std::vector<OpenEdge> open_edges(const mesh::LatticeMesh& mesh) {
    std::vector<OpenEdge> open = unbalanced_edges(mesh, [](VertexIndex vertex) { return vertex; });
    if (open.empty()) return open;
    const std::vector<VertexIndex> lowest = coincident_vertices(mesh.points);
    return unbalanced_edges(mesh, [&](VertexIndex vertex) { return lowest[vertex]; });
}

Error open_surface_error(const std::vector<OpenEdge>& edges) {
    constexpr std::size_t named = 8;  // a message, not a list
    Error error{ErrorCode::not_a_solid,
                "the surface is not closed: " + std::to_string(edges.size()) +
                    (edges.size() == 1 ? " edge is" : " edges are") +
                    " not used equally often in both directions",
                {}};
    for (const OpenEdge& edge : edges) {
        if (error.place.faces.size() == named) break;
        if (std::find(error.place.faces.begin(), error.place.faces.end(), edge.face) ==
            error.place.faces.end())
            error.place.faces.push_back(edge.face);
    }
    return error;
}

mesh::LatticeMesh close_holes(const mesh::LatticeMesh& mesh, const std::vector<OpenEdge>& edges) {
    mesh::LatticeMesh closed = mesh;
    mesh::DisjointSets pieces(mesh.points.size());
    for (const OpenEdge& edge : edges) pieces.unite(edge.from, edge.to);

    // The mean of the ends of each piece's edges, rounded: the apex, as a new vertex.
    struct Sum {
        std::int64_t x = 0, y = 0, z = 0, count = 0;
        VertexIndex apex = 0;
    };
    std::vector<Sum> sums(mesh.points.size());
    for (const OpenEdge& edge : edges) {
        Sum& sum = sums[pieces.find(edge.from)];
        for (const VertexIndex end : {edge.from, edge.to}) {
            const exact::Point p = mesh.points[end];
            sum.x += p.x, sum.y += p.y, sum.z += p.z, ++sum.count;
        }
    }
    for (Sum& sum : sums) {
        if (sum.count == 0) continue;
        const auto mean = [&](std::int64_t total) {
            return static_cast<std::int32_t>((total + sum.count / 2) / sum.count);
        };
        sum.apex = static_cast<VertexIndex>(closed.points.size());
        closed.points.push_back({mean(sum.x), mean(sum.y), mean(sum.z)});
    }
    // A facet against the surplus direction; its two other edges cancel around the piece, whose ends balance.
    for (const OpenEdge& edge : edges)
        for (std::int32_t i = 0; i < edge.surplus; ++i)
            closed.triangles.push_back({edge.to, edge.from, sums[pieces.find(edge.from)].apex});
    return closed;
}

}  // namespace octavo::classic
