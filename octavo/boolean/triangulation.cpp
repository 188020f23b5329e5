// SPDX-License-Identifier: Apache-2.0
#include <octavo/boolean/triangulation.hpp>

namespace octavo::boolean {

void Triangulation::begin(std::size_t corners) {
    triangles_.clear();
    triangle_at_.assign(corners, 0);
    triangles_.push_back({{0, 1, 2}, {no_index, no_index, no_index}, {0, 0, 0}});
    if (corners < 4) return;
    triangles_.push_back({{0, 2, 3}, {0, no_index, no_index}, {0, 0, 0}});
    triangles_[0].neighbour[2] = 1;
    triangle_at_[3] = 1;
}

void Triangulation::split_triangle(TriangleId t0, VertexId p) {
    const Triangle old = triangles_[t0];
    const auto t1 = static_cast<TriangleId>(triangles_.size()), t2 = t1 + 1;
    triangles_.push_back({{old.v[1], old.v[2], p}, {old.neighbour[1], t2, t0}, {old.owner[1], 0, 0}});
    triangles_.push_back({{old.v[2], old.v[0], p}, {old.neighbour[2], t0, t1}, {old.owner[2], 0, 0}});
    triangles_[t0] = {{old.v[0], old.v[1], p}, {old.neighbour[0], t1, t2}, {old.owner[0], 0, 0}};
    relink(old.neighbour[1], t0, t1);
    relink(old.neighbour[2], t0, t2);
    connect(p, t0);
    connect(old.v[0], t0);
    connect(old.v[1], t0);
    connect(old.v[2], t1);
}

void Triangulation::split_edge(Edge edge, VertexId p) {
    // t = (a, b, c) with the edge (a, b), u = (b, a, d) across it.
    const auto [t, k] = edge;
    const Triangle old = triangles_[t];
    const VertexId a = old.v[k], b = old.v[(k + 1) % 3], c = old.v[(k + 2) % 3];
    const TriangleId u = old.neighbour[k], t_bc = old.neighbour[(k + 1) % 3],
                     t_ca = old.neighbour[(k + 2) % 3];
    const std::uint32_t owner_ab = old.owner[k], owner_bc = old.owner[(k + 1) % 3],
                        owner_ca = old.owner[(k + 2) % 3];
    const auto t1 = static_cast<TriangleId>(triangles_.size());
    const TriangleId u1 = u == no_index ? no_index : t1 + 1;
    triangles_.push_back({{p, b, c}, {u, t_bc, t}, {owner_ab, owner_bc, 0}});
    triangles_[t] = {{a, p, c}, {u1, t1, t_ca}, {owner_ab, 0, owner_ca}};
    relink(t_bc, t, t1);
    if (u != no_index) {
        const Triangle other = triangles_[u];
        const int m = back_index(u, t);
        const VertexId d = other.v[(m + 2) % 3];
        const TriangleId u_ad = other.neighbour[(m + 1) % 3], u_db = other.neighbour[(m + 2) % 3];
        const std::uint32_t owner_ad = other.owner[(m + 1) % 3], owner_db = other.owner[(m + 2) % 3];
        triangles_.push_back({{p, a, d}, {t, u_ad, u}, {owner_ab, owner_ad, 0}});
        triangles_[u] = {{b, p, d}, {t1, u1, u_db}, {owner_ab, 0, owner_db}};
        relink(u_ad, u, u1);
        connect(d, u);
    }
    connect(a, t);
    connect(c, t);
    connect(p, t);
    connect(b, t1);
}

void Triangulation::flip(Edge edge) {
    const auto [t, k] = edge;
    const Triangle old = triangles_[t];
    const TriangleId u = old.neighbour[k];
    const Triangle other = triangles_[u];
    const int m = back_index(u, t);
    const VertexId a = old.v[k], b = old.v[(k + 1) % 3], c = old.v[(k + 2) % 3], d = other.v[(m + 2) % 3];
    const TriangleId t_bc = old.neighbour[(k + 1) % 3], t_ca = old.neighbour[(k + 2) % 3];
    const TriangleId u_ad = other.neighbour[(m + 1) % 3], u_db = other.neighbour[(m + 2) % 3];
    triangles_[t] = {{c, a, d}, {t_ca, u_ad, u}, {old.owner[(k + 2) % 3], other.owner[(m + 1) % 3], 0}};
    triangles_[u] = {{d, b, c}, {u_db, t_bc, t}, {other.owner[(m + 2) % 3], old.owner[(k + 1) % 3], 0}};
    relink(u_ad, u, t);
    relink(t_bc, t, u);
    connect(a, t);
    connect(c, t);
    connect(d, t);
    connect(b, u);
}

void Triangulation::set_owner(Edge edge, std::uint32_t owner) {
    triangles_[edge.triangle].owner[edge.k] = owner;
    const Edge other = across(edge);
    if (other.triangle != no_index) triangles_[other.triangle].owner[other.k] = owner;
}

Triangulation::Edge Triangulation::find_edge(VertexId from, VertexId to) const {
    Edge edge{no_index, 0};
    any_around(from, [&](TriangleId t, int k) {
        if (triangles_[t].v[(k + 1) % 3] == to) edge = {t, k};
        if (triangles_[t].v[(k + 2) % 3] == to) edge = {t, (k + 2) % 3};
        return edge.triangle != no_index;
    });
    return edge;
}

}  // namespace octavo::boolean
