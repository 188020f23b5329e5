// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <octavo/boolean/any_point.hpp>
#include <octavo/boolean/lattice_cell.hpp>
#include <octavo/boolean/subdivision.hpp>
#include <octavo/exact/compare.hpp>
#include <octavo/exact/intersect.hpp>
#include <octavo/octree/morton.hpp>

namespace octavo::boolean {

using exact::Sign;

void Subdivision::begin(const exact::Plane& plane, std::span<const exact::Point> corners,
                        std::span<const PointId> ids) {
    plane_ = plane;
    axis_ = plane.dominant_axis();
    reversed_ = plane.normal(axis_) < 0;
    i_ = (axis_ + 1) % 3, j_ = (axis_ + 2) % 3;
    if (reversed_) std::swap(i_, j_);
    lines_.clear(), vertices_.clear(), triangles_.clear(), owners_.clear(), new_points_.clear();
    vertex_of_.assign(16, no_index);
    hint_ = 0, walk_seed_ = 1;
    triangles_.push_back({{0, 1, 2}, {no_index, no_index, no_index}, {0, 0, 0}});
    if (corners.size() == 4) {
        triangles_.push_back({{0, 2, 3}, {0, no_index, no_index}, {0, 0, 0}});
        triangles_[0].neighbour[2] = 1;
    }
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const exact::Point corner = corners[k];
        const Vertex vertex{static_cast<double>(corner[i_]),
                            static_cast<double>(corner[j_]),
                            ids[k],
                            k == 3 ? 1u : 0u,
                            corner,
                            Vertex::Kind::lattice};
        push(vertex);
    }
}

void Subdivision::begin_round(const exact::Plane& plane, std::span<const exact::Point> points) {
    const int axis = plane.dominant_axis(), i = (axis + 1) % 3, j = (axis + 2) % 3;
    std::int32_t low[2] = {exact::universe_side, exact::universe_side}, high[2] = {0, 0};
    for (const exact::Point point : points) {
        low[0] = std::min(low[0], point[i]), high[0] = std::max(high[0], point[i]);
        low[1] = std::min(low[1], point[j]), high[1] = std::max(high[1], point[j]);
    }
    const std::int32_t reach = (high[0] - low[0]) + (high[1] - low[1]) + 4;  // < 2^27 + 4
    const auto at = [axis](std::int32_t x, std::int32_t y) {
        return axis == 0 ? exact::Point{0, x, y} : axis == 1 ? exact::Point{y, 0, x} : exact::Point{x, y, 0};
    };
    const exact::Point a = at(low[0] - 1, low[1] - 1), b = at(low[0] - 1 + reach, low[1] - 1),
                       c = at(low[0] - 1, low[1] - 1 + reach);
    const PointId ids[3] = {no_index, no_index, no_index};
    const bool up = plane.normal(axis) > 0;
    const exact::Point corners[3] = {a, up ? b : c, up ? c : b};
    begin(plane, corners, ids);
}

Subdivision::VertexId Subdivision::push(const Vertex& vertex) {
    const auto id = static_cast<VertexId>(vertices_.size());
    vertices_.push_back(vertex);
    if (vertex.id >= new_point) return id;
    const auto insert = [this](VertexId v) {
        std::size_t slot = vertices_[v].id * 0x9E3779B1u & (vertex_of_.size() - 1);
        while (vertex_of_[slot] != no_index) slot = (slot + 1) & (vertex_of_.size() - 1);
        vertex_of_[slot] = v;
    };
    if (2 * vertices_.size() > vertex_of_.size()) {
        vertex_of_.assign(2 * vertex_of_.size(), no_index);
        for (VertexId v = 0; v < id; ++v)
            if (vertices_[v].id < new_point) insert(v);
    }
    insert(id);
    return id;
}

template <class Visit>
decltype(auto) Subdivision::with(const Vertex& vertex, const Visit& visit) const {
    switch (vertex.kind) {
        case Vertex::Kind::lattice:
            return visit(vertex.lattice);
        case Vertex::Kind::crossing:
            return visit(new_points_[vertex.id - new_point]);
        case Vertex::Kind::table:
            break;
    }
    return points_.with(vertex.id, visit);
}

Sign Subdivision::turn(VertexId a, VertexId b, VertexId c) const {
    // The filter of exact/orient_in_plane.hpp with R = 2^28, which bounds all coordinates, those of the corners
    // round a sheet too: e = 12u R < 2^-21.
    const Vertex &p = vertices_[a], &q = vertices_[b], &r = vertices_[c];
    const double ux = q.x - p.x, uy = q.y - p.y, vx = r.x - p.x, vy = r.y - p.y;
    const double determinant = ux * vy - uy * vx;
    const double sum = (std::fabs(ux) + std::fabs(uy)) + (std::fabs(vx) + std::fabs(vy));
    constexpr double e = 0x1p-21;
    if (std::fabs(determinant) > 2 * e * (sum + e)) {
        exact::count_filtered(exact::Predicate::orient_in_plane);
        return determinant > 0 ? Sign::positive : Sign::negative;
    }
    if (share_line(p, q, r)) return Sign::zero;
    return exact_turn(p, q, r);
}

bool Subdivision::share_line(const Vertex& a, const Vertex& b, const Vertex& c) const {
    const auto has = [](const Vertex& vertex, LineId line) {
        return std::find(vertex.lines.begin(), vertex.lines.end(), line) != vertex.lines.end();
    };
    for (const LineId line : a.lines) {
        if (line == no_line) return false;
        if (has(b, line) && has(c, line)) return true;
    }
    return false;
}

/// A fifth line is not noted: to know it saves time only.
void Subdivision::note(VertexId vertex, LineId line) {
    if (line == no_line) return;
    for (LineId& known : vertices_[vertex].lines) {
        if (known == line) return;
        if (known == no_line) {
            known = line;
            return;
        }
    }
}

bool Subdivision::lies_on(VertexId vertex, LineId line) const {
    const auto& lines = vertices_[vertex].lines;
    return line != no_line && std::find(lines.begin(), lines.end(), line) != lines.end();
}

Sign Subdivision::exact_turn(const Vertex& a, const Vertex& b, const Vertex& c) const {
    using Kind = Vertex::Kind;
    Sign sign;
    if (a.kind == Kind::lattice && b.kind == Kind::lattice && c.kind == Kind::lattice) {
        sign = exact::orient2d(axis_, a.lattice, b.lattice, c.lattice);
    } else {
        const Vertex* corner[3] = {&a, &b, &c};
        sign = boolean::exact_turn(axis_, [&](int k, const auto& visit) { return with(*corner[k], visit); });
    }
    return reversed_ ? -sign : sign;
}

/// Of a vertex on the line through two others: whether it lies on the side of `to`, seen from `from`.
bool Subdivision::is_ahead(VertexId from, VertexId to, VertexId vertex) const {
    const Vertex &p = vertices_[from], &q = vertices_[to], &r = vertices_[vertex];
    const bool by_x = std::fabs(q.x - p.x) >= std::fabs(q.y - p.y);
    const double towards = by_x ? q.x - p.x : q.y - p.y, offset = by_x ? r.x - p.x : r.y - p.y;
    constexpr double margin = 0x1p-20;  // approximations are off by less than 2^-24
    if (std::fabs(towards) > margin && std::fabs(offset) > margin) return (towards > 0) == (offset > 0);
    for (const int axis : {i_, j_}) {
        const auto compare = [&](const Vertex& first, const Vertex& second) {
            return with(first, [&](const auto& a) {
                return with(second, [&](const auto& b) { return exact::compare_coordinate(axis, a, b); });
            });
        };
        const Sign direction = compare(q, p);
        if (direction != Sign::zero) return compare(r, p) == direction;
    }
    return false;
}

Subdivision::VertexId Subdivision::vertex_of(PointId id) const {
    for (std::size_t slot = id * 0x9E3779B1u & (vertex_of_.size() - 1); vertex_of_[slot] != no_index;
         slot = (slot + 1) & (vertex_of_.size() - 1))
        if (vertices_[vertex_of_[slot]].id == id) return vertex_of_[slot];
    return no_index;
}

Subdivision::VertexId Subdivision::push(PointId id) {
    const Vec3 at = points_.approximation(id);
    const exact::Point* lattice = points_.lattice_point(id);
    return push({at[i_], at[j_], id, no_index, lattice ? *lattice : exact::Point{},
                 lattice ? Vertex::Kind::lattice : Vertex::Kind::table});
}

Subdivision::VertexId Subdivision::add_point(PointId id) {
    const VertexId known = vertex_of(id);
    if (known != no_index) return known;
    const VertexId vertex = push(id);
    insert(vertex);
    return vertex;
}

void Subdivision::insert(VertexId vertex) {
    const Location place = locate(vertex);
    if (place.edge < 0)
        split_triangle(place.triangle, vertex);
    else
        split_edge(place.triangle, place.edge, vertex);
}

void Subdivision::add_points(std::vector<PointOnLine>& points) {
    // Fewer points are found and connected so fast that neither order nor flips pay.
    constexpr std::size_t many = 24;
    const std::size_t first = vertices_.size();
    for (const PointOnLine& point : points) {
        VertexId vertex = vertex_of(point.id);
        if (vertex == no_index) vertex = push(point.id);
        note(vertex, point.line);
    }
    const std::size_t count = vertices_.size() - first;
    if (count < many) {
        for (std::size_t vertex = first; vertex < vertices_.size(); ++vertex)
            insert(static_cast<VertexId>(vertex));
        return;
    }
    // Along the Morton curve each point is near the one before; flips keep triangles round and walks short.
    std::vector<std::pair<std::uint64_t, VertexId>> order;
    order.reserve(count);
    for (std::size_t vertex = first; vertex < vertices_.size(); ++vertex) {
        const auto x = static_cast<std::uint32_t>(vertices_[vertex].x + 1) >> 6,
                   y = static_cast<std::uint32_t>(vertices_[vertex].y + 1) >> 6;
        order.push_back({octree::interleave(x, y, 0), static_cast<VertexId>(vertex)});
    }
    std::sort(order.begin(), order.end());
    for (const auto& [key, vertex] : order) {
        insert(vertex);
        legalise(vertex);
    }
}

/// Flips edges opposite to a new vertex while that makes triangles rounder. Each flip gives the vertex one more edge,
/// so it ends whatever rounding says.
void Subdivision::legalise(VertexId vertex) {
    pending_.clear();
    any_around(vertex, [&](TriangleId t, int) {
        pending_.push_back(t);
        return false;
    });
    while (!pending_.empty()) {
        // Flips keep the vertex in all triangles that are pending.
        const TriangleId t = pending_.back();
        const int k = (index_in(t, vertex) + 1) % 3;
        const TriangleId across = triangles_[t].neighbour[k];
        pending_.pop_back();
        if (across == no_index || triangles_[t].owner[k]) continue;
        const VertexId a = triangles_[t].v[k], b = triangles_[t].v[(k + 1) % 3];
        const VertexId apex = triangles_[across].v[(back_index(across, t) + 2) % 3];
        if (!prefers_flip(a, b, vertex, apex)) continue;
        if (turn(vertex, a, apex) != Sign::positive || turn(apex, b, vertex) != Sign::positive) continue;
        flip(t, k);
        pending_.push_back(t);
        pending_.push_back(across);
    }
}

Subdivision::Location Subdivision::locate(VertexId vertex) {
    // A walk may run in circles in a triangulation that is not Delaunay; a random choice of the next edge ends
    // it. The generator starts anew with every plane, so results are reproducible.
    TriangleId at = hint_;
    for (;;) {
        const Triangle& t = triangles_[at];
        walk_seed_ = walk_seed_ * 1664525u + 1013904223u;
        const int first = static_cast<int>((walk_seed_ >> 24) % 3);
        int edge = -1;
        TriangleId next = no_index;
        for (int step = 0; step < 3 && next == no_index; ++step) {
            const int k = (first + step) % 3;
            const Sign side = turn(t.v[k], t.v[(k + 1) % 3], vertex);
            if (side == Sign::zero) edge = k;
            if (side != Sign::negative) continue;
            next = t.neighbour[k];
            OCTAVO_CHECK(next != no_index, "a point to insert lies outside the first triangle");
        }
        if (next == no_index) {
            hint_ = at;
            return {at, edge};
        }
        at = next;
    }
}

void Subdivision::split_triangle(TriangleId t0, VertexId p) {
    const Triangle old = triangles_[t0];
    const auto t1 = static_cast<TriangleId>(triangles_.size()), t2 = t1 + 1;
    triangles_.push_back({{old.v[1], old.v[2], p}, {old.neighbour[1], t2, t0}, {old.owner[1], 0, 0}});
    triangles_.push_back({{old.v[2], old.v[0], p}, {old.neighbour[2], t0, t1}, {old.owner[2], 0, 0}});
    triangles_[t0] = {{old.v[0], old.v[1], p}, {old.neighbour[0], t1, t2}, {old.owner[0], 0, 0}};
    if (old.neighbour[1] != no_index)
        triangles_[old.neighbour[1]].neighbour[back_index(old.neighbour[1], t0)] = t1;
    if (old.neighbour[2] != no_index)
        triangles_[old.neighbour[2]].neighbour[back_index(old.neighbour[2], t0)] = t2;
    vertices_[p].triangle = t0;
    vertices_[old.v[0]].triangle = t0;
    vertices_[old.v[1]].triangle = t0;
    vertices_[old.v[2]].triangle = t1;
}

void Subdivision::split_edge(TriangleId t, int k, VertexId p) {
    // t = (a, b, c) with the edge (a, b), u = (b, a, d) across it.
    const Triangle old = triangles_[t];
    const VertexId a = old.v[k], b = old.v[(k + 1) % 3], c = old.v[(k + 2) % 3];
    const TriangleId u = old.neighbour[k], t_bc = old.neighbour[(k + 1) % 3],
                     t_ca = old.neighbour[(k + 2) % 3];
    const std::uint32_t own_ab = old.owner[k], own_bc = old.owner[(k + 1) % 3],
                        own_ca = old.owner[(k + 2) % 3];
    const auto t1 = static_cast<TriangleId>(triangles_.size());
    const TriangleId u1 = u == no_index ? no_index : t1 + 1;
    triangles_.push_back({{p, b, c}, {u, t_bc, t}, {own_ab, own_bc, 0}});
    triangles_[t] = {{a, p, c}, {u1, t1, t_ca}, {own_ab, 0, own_ca}};
    if (t_bc != no_index) triangles_[t_bc].neighbour[back_index(t_bc, t)] = t1;
    if (u != no_index) {
        const Triangle across = triangles_[u];
        const int m = back_index(u, t);
        const VertexId d = across.v[(m + 2) % 3];
        const TriangleId u_ad = across.neighbour[(m + 1) % 3], u_db = across.neighbour[(m + 2) % 3];
        const std::uint32_t own_ad = across.owner[(m + 1) % 3], own_db = across.owner[(m + 2) % 3];
        triangles_.push_back({{p, a, d}, {t, u_ad, u}, {own_ab, own_ad, 0}});
        triangles_[u] = {{b, p, d}, {t1, u1, u_db}, {own_ab, 0, own_db}};
        if (u_ad != no_index) triangles_[u_ad].neighbour[back_index(u_ad, u)] = u1;
        vertices_[d].triangle = u;
    }
    vertices_[a].triangle = t;
    vertices_[c].triangle = t;
    vertices_[p].triangle = t;
    vertices_[b].triangle = t1;
}

/// Replaces the edge k of t, with a triangle on either side, by the other diagonal of the two.
void Subdivision::flip(TriangleId t, int k) {
    const Triangle old = triangles_[t];
    const TriangleId u = old.neighbour[k];
    const Triangle across = triangles_[u];
    const int m = back_index(u, t);
    const VertexId a = old.v[k], b = old.v[(k + 1) % 3], c = old.v[(k + 2) % 3], d = across.v[(m + 2) % 3];
    const TriangleId t_bc = old.neighbour[(k + 1) % 3], t_ca = old.neighbour[(k + 2) % 3];
    const TriangleId u_ad = across.neighbour[(m + 1) % 3], u_db = across.neighbour[(m + 2) % 3];
    triangles_[t] = {{c, a, d}, {t_ca, u_ad, u}, {old.owner[(k + 2) % 3], across.owner[(m + 1) % 3], 0}};
    triangles_[u] = {{d, b, c}, {u_db, t_bc, t}, {across.owner[(m + 2) % 3], old.owner[(k + 1) % 3], 0}};
    if (u_ad != no_index) triangles_[u_ad].neighbour[back_index(u_ad, u)] = t;
    if (t_bc != no_index) triangles_[t_bc].neighbour[back_index(t_bc, t)] = u;
    vertices_[a].triangle = vertices_[c].triangle = vertices_[d].triangle = t;
    vertices_[b].triangle = u;
}

/// Calls visit(triangle, k) for the triangles that have `vertex` as corner k until it returns true.
template <class Visit>
bool Subdivision::any_around(VertexId vertex, const Visit& visit) const {
    const TriangleId start = vertices_[vertex].triangle;
    TriangleId at = start;
    do {  // counter-clockwise: out through the edge that ends at the vertex
        const int k = index_in(at, vertex);
        if (visit(at, k)) return true;
        at = triangles_[at].neighbour[(k + 2) % 3];
    } while (at != no_index && at != start);
    if (at == start) return false;
    for (at = triangles_[start].neighbour[index_in(start, vertex)]; at != no_index;) {
        const int k = index_in(at, vertex);
        if (visit(at, k)) return true;
        at = triangles_[at].neighbour[k];
    }
    return false;
}

/// The edge, seen from the triangle that has it as from → to, or else from the other one.
Subdivision::Edge Subdivision::find_edge(VertexId from, VertexId to) const {
    Edge edge{no_index, 0};
    any_around(from, [&](TriangleId t, int k) {
        if (triangles_[t].v[(k + 1) % 3] == to) edge = {t, k};
        if (triangles_[t].v[(k + 2) % 3] == to) edge = {t, (k + 2) % 3};
        return edge.triangle != no_index;
    });
    return edge;
}

void Subdivision::own(Edge edge, std::uint32_t line, std::uint32_t tag) {
    const std::uint32_t first = triangles_[edge.triangle].owner[edge.k];
    for (std::uint32_t at = first; at; at = owners_[at - 1].next)
        if (owners_[at - 1].tag == tag && owners_[at - 1].line == line) return;
    owners_.push_back({line, tag, first});
    const auto head = static_cast<std::uint32_t>(owners_.size());
    triangles_[edge.triangle].owner[edge.k] = head;
    const TriangleId across = triangles_[edge.triangle].neighbour[edge.k];
    if (across != no_index) triangles_[across].owner[back_index(across, edge.triangle)] = head;
}

void Subdivision::add_segment(VertexId from, VertexId to, LineId line, std::uint32_t tag) {
    while (from != to) from = advance(from, to, line, tag);
}

/// Fixes the first piece of the segment and returns its end: the next vertex on the segment.
Subdivision::VertexId Subdivision::advance(VertexId from, VertexId to, LineId line, std::uint32_t tag) {
    // The edge from `from` that runs along the segment, or the edge opposite to `from` that it leaves through.
    Edge along{no_index, 0}, through{no_index, 0};
    VertexId next = no_index;
    any_around(from, [&](TriangleId t, int k) {  // what is known costs nothing: first of all
        for (int step = 1; step < 3; ++step) {
            const VertexId neighbour = triangles_[t].v[(k + step) % 3];
            if (neighbour != to && !(lies_on(neighbour, line) && is_ahead(from, to, neighbour))) continue;
            along = {t, step == 1 ? k : (k + 2) % 3}, next = neighbour;
            return true;
        }
        return false;
    });
    if (along.triangle != no_index) {
        own(along, line, tag);
        return next;
    }
    any_around(from, [&](TriangleId t, int k) {
        const VertexId right = triangles_[t].v[(k + 1) % 3], left = triangles_[t].v[(k + 2) % 3];
        const Sign at_right = turn(from, to, right), at_left = turn(from, to, left);
        if (right == to || (at_right == Sign::zero && is_ahead(from, to, right))) {
            along = {t, k}, next = right;
            return true;
        }
        if (left == to || (at_left == Sign::zero && is_ahead(from, to, left))) {
            along = {t, (k + 2) % 3}, next = left;
            return true;
        }
        if (at_right == Sign::negative && at_left == Sign::positive) through = {t, (k + 1) % 3};
        return through.triangle != no_index;
    });
    if (along.triangle != no_index) {
        note(next, line);
        own(along, line, tag);
        return next;
    }
    OCTAVO_CHECK(through.triangle != no_index, "a segment leaves the triangulation");

    // Walk on to the next vertex on the segment; a fixed edge in the way makes one.
    for (Edge edge = through;;) {
        if (triangles_[edge.triangle].owner[edge.k]) {
            next = cross(edge, line);
            break;
        }
        const TriangleId t = triangles_[edge.triangle].neighbour[edge.k];
        OCTAVO_CHECK(t != no_index, "a segment leaves the triangulation");
        const int m = back_index(t, edge.triangle);
        const VertexId apex = triangles_[t].v[(m + 2) % 3];
        const Sign side = turn(from, to, apex);
        if (apex == to || side == Sign::zero) {
            next = apex;
            note(next, line);
            break;
        }
        edge = {t, side == Sign::positive ? (m + 1) % 3 : (m + 2) % 3};
    }
    force_edge(from, next);
    own(find_edge(from, next), line, tag);
    return next;
}

/// The vertex where a fixed edge meets line `line`.
Subdivision::VertexId Subdivision::cross(Edge fixed, LineId line) {
    const Owner& owner = owners_[triangles_[fixed.triangle].owner[fixed.k] - 1];
    const std::optional<exact::TriplePoint> point =
        exact::intersect(plane_, plane_of(owner.line), plane_of(line));
    OCTAVO_CHECK(point.has_value(), "two segments that cross have parallel planes");
    const auto number = static_cast<std::uint32_t>(new_points_.size());
    new_points_.push_back(*point);
    const LatticeCell cell = lattice_cell(*point);
    const VertexId vertex =
        push({point->approximation(i_), point->approximation(j_), new_point + number, no_index, cell.low,
              cell.is_corner ? Vertex::Kind::lattice : Vertex::Kind::crossing});
    note(vertex, owner.line);
    note(vertex, line);
    split_edge(fixed.triangle, fixed.k, vertex);
    return vertex;
}

/// Flips the free edges between two vertices until an edge joins them. No vertex lies between them.
void Subdivision::force_edge(VertexId from, VertexId to) {
    if (find_edge(from, to).triangle != no_index) return;
    in_the_way_.clear();
    Edge edge{no_index, 0};
    any_around(from, [&](TriangleId t, int k) {
        const VertexId right = triangles_[t].v[(k + 1) % 3], left = triangles_[t].v[(k + 2) % 3];
        if (turn(from, to, right) == Sign::negative && turn(from, to, left) == Sign::positive)
            edge = {t, (k + 1) % 3};
        return edge.triangle != no_index;
    });
    for (;;) {
        in_the_way_.push_back(
            {triangles_[edge.triangle].v[edge.k], triangles_[edge.triangle].v[(edge.k + 1) % 3]});
        const TriangleId t = triangles_[edge.triangle].neighbour[edge.k];
        const int m = back_index(t, edge.triangle);
        const VertexId apex = triangles_[t].v[(m + 2) % 3];
        if (apex == to) break;
        edge = {t, turn(from, to, apex) == Sign::positive ? (m + 1) % 3 : (m + 2) % 3};
    }
    // Each pass over the queue flips at least one edge away; those that cannot be flipped yet wait.
    for (std::size_t at = 0; at < in_the_way_.size(); ++at) {
        const auto [p, q] = in_the_way_[at];
        const Edge crossing = find_edge(p, q);
        const Triangle& t = triangles_[crossing.triangle];
        const TriangleId across = t.neighbour[crossing.k];
        const VertexId a = t.v[crossing.k], b = t.v[(crossing.k + 1) % 3], c = t.v[(crossing.k + 2) % 3];
        const VertexId d = triangles_[across].v[(back_index(across, crossing.triangle) + 2) % 3];
        if (turn(c, a, d) != Sign::positive || turn(d, b, c) != Sign::positive) {
            in_the_way_.push_back({p, q});
            continue;
        }
        flip(crossing.triangle, crossing.k);
        const bool still =
            c != from && c != to && d != from && d != to && turn(from, to, c) != turn(from, to, d);
        if (still) in_the_way_.push_back({c, d});
    }
}

/// In-circle in rounded coordinates, with a margin: a choice of shape, never of validity. The margin keeps rounding
/// from flipping an edge back and forth.
bool Subdivision::prefers_flip(VertexId a, VertexId b, VertexId c, VertexId d) const {
    const Vertex &p = vertices_[a], &q = vertices_[b], &r = vertices_[c], &s = vertices_[d];
    // The edge (a, b) is bad when the angles at c and d sum to more than half a turn.
    const double cx = p.x - r.x, cy = p.y - r.y, ex = q.x - r.x, ey = q.y - r.y;
    const double dx = p.x - s.x, dy = p.y - s.y, fx = q.x - s.x, fy = q.y - s.y;
    const double sin_c = cx * ey - cy * ex, cos_c = cx * ex + cy * ey;
    const double sin_d = fx * dy - fy * dx, cos_d = dx * fx + dy * fy;
    const double scale = (std::fabs(sin_c) + std::fabs(cos_c)) * (std::fabs(sin_d) + std::fabs(cos_d));
    return sin_c * cos_d + cos_c * sin_d < -1e-9 * scale;
}

void Subdivision::refine() {
    in_the_way_.clear();
    for (TriangleId t = 0; t < triangles_.size(); ++t)
        for (int k = 0; k < 3; ++k)
            if (triangles_[t].neighbour[k] != no_index && triangles_[t].neighbour[k] > t &&
                !triangles_[t].owner[k])
                in_the_way_.push_back({triangles_[t].v[k], triangles_[t].v[(k + 1) % 3]});
    const std::size_t limit = 64 * in_the_way_.size() + 64;
    for (std::size_t at = 0; at < in_the_way_.size() && at < limit; ++at) {
        const auto [p, q] = in_the_way_[at];
        const Edge edge = find_edge(p, q);
        if (edge.triangle == no_index) continue;
        const Triangle t = triangles_[edge.triangle];
        const TriangleId across = t.neighbour[edge.k];
        if (across == no_index || t.owner[edge.k]) continue;
        const VertexId a = t.v[edge.k], b = t.v[(edge.k + 1) % 3], c = t.v[(edge.k + 2) % 3];
        const VertexId d = triangles_[across].v[(back_index(across, edge.triangle) + 2) % 3];
        if (!prefers_flip(a, b, c, d)) continue;
        if (turn(c, a, d) != Sign::positive || turn(d, b, c) != Sign::positive) continue;
        flip(edge.triangle, edge.k);
        for (const auto& side : {std::pair{b, c}, {c, a}, {a, d}, {d, b}}) in_the_way_.push_back(side);
    }
}

}  // namespace octavo::boolean
