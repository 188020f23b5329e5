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
    lines_.clear(), vertices_.clear(), owners_.clear(), new_points_.clear();
    vertex_of_.assign(16, no_index);
    hint_ = 0, walk_seed_ = 1;
    mesh_.begin(corners.size());
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const exact::Point corner = corners[k];
        const Vertex vertex{static_cast<double>(corner[i_]), static_cast<double>(corner[j_]), ids[k], corner,
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
    return push({at[i_], at[j_], id, lattice ? *lattice : exact::Point{},
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
        mesh_.split_triangle(place.triangle, vertex);
    else
        mesh_.split_edge({place.triangle, place.edge}, vertex);
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
    mesh_.any_around(vertex, [&](TriangleId t, int) {
        pending_.push_back(t);
        return false;
    });
    while (!pending_.empty()) {
        // Flips keep the vertex in all triangles that are pending.
        const TriangleId t = pending_.back();
        const Edge edge{t, (mesh_.index_in(t, vertex) + 1) % 3}, across = mesh_.across(edge);
        pending_.pop_back();
        if (across.triangle == no_index || mesh_.owner(edge)) continue;
        const VertexId a = mesh_.from(edge), b = mesh_.to(edge), apex = mesh_.apex(across);
        if (!prefers_flip(a, b, vertex, apex)) continue;
        if (turn(vertex, a, apex) != Sign::positive || turn(apex, b, vertex) != Sign::positive) continue;
        mesh_.flip(edge);
        pending_.push_back(t);
        pending_.push_back(across.triangle);
    }
}

Subdivision::Location Subdivision::locate(VertexId vertex) {
    // A walk may run in circles in a triangulation that is not Delaunay; a random choice of the next edge ends
    // it. The generator starts anew with every plane, so results are reproducible.
    TriangleId at = hint_;
    for (;;) {
        const Triangle& t = mesh_[at];
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

void Subdivision::own(Edge edge, std::uint32_t line, std::uint32_t tag) {
    const std::uint32_t first = mesh_.owner(edge);
    for (std::uint32_t at = first; at; at = owners_[at - 1].next)
        if (owners_[at - 1].tag == tag && owners_[at - 1].line == line) return;
    owners_.push_back({line, tag, first});
    mesh_.set_owner(edge, static_cast<std::uint32_t>(owners_.size()));
}

void Subdivision::add_segment(VertexId from, VertexId to, LineId line, std::uint32_t tag) {
    while (from != to) from = advance(from, to, line, tag);
}

/// Fixes the first piece of the segment and returns its end: the next vertex on the segment.
Subdivision::VertexId Subdivision::advance(VertexId from, VertexId to, LineId line, std::uint32_t tag) {
    // The edge from `from` that runs along the segment, or the edge opposite to `from` that it leaves through.
    Edge along{no_index, 0}, through{no_index, 0};
    VertexId next = no_index;
    mesh_.any_around(from, [&](TriangleId t, int k) {  // what is known costs nothing: first of all
        for (int step = 1; step < 3; ++step) {
            const VertexId neighbour = mesh_[t].v[(k + step) % 3];
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
    mesh_.any_around(from, [&](TriangleId t, int k) {
        const VertexId right = mesh_[t].v[(k + 1) % 3], left = mesh_[t].v[(k + 2) % 3];
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
    next = walk(through, from, to, line);
    force_edge(from, next);
    own(mesh_.find_edge(from, next), line, tag);
    return next;
}

/// The next vertex on the segment, which leaves the first triangle through an edge; a fixed edge in the way makes one.
Subdivision::VertexId Subdivision::walk(Edge through, VertexId from, VertexId to, LineId line) {
    for (Edge edge = through;;) {
        if (mesh_.owner(edge)) return cross(edge, line);
        const Edge across = mesh_.across(edge);
        OCTAVO_CHECK(across.triangle != no_index, "a segment leaves the triangulation");
        const VertexId apex = mesh_.apex(across);
        const Sign side = turn(from, to, apex);
        if (apex == to || side == Sign::zero) {
            note(apex, line);
            return apex;
        }
        edge = {across.triangle, (across.k + (side == Sign::positive ? 1 : 2)) % 3};
    }
}

/// The vertex where a fixed edge meets line `line`.
Subdivision::VertexId Subdivision::cross(Edge fixed, LineId line) {
    const Owner& owner = owners_[mesh_.owner(fixed) - 1];
    const std::optional<exact::TriplePoint> point =
        exact::intersect(plane_, plane_of(owner.line), plane_of(line));
    OCTAVO_CHECK(point.has_value(), "two segments that cross have parallel planes");
    const auto number = static_cast<std::uint32_t>(new_points_.size());
    new_points_.push_back(*point);
    const LatticeCell cell = lattice_cell(*point);
    const VertexId vertex = push({point->approximation(i_), point->approximation(j_), new_point + number,
                                  cell.low, cell.is_corner ? Vertex::Kind::lattice : Vertex::Kind::crossing});
    note(vertex, owner.line);
    note(vertex, line);
    mesh_.split_edge(fixed, vertex);
    return vertex;
}

/// Whether the two triangles at an edge make a strictly convex quadrilateral, of which the edge is one diagonal.
bool Subdivision::may_flip(Edge edge) const {
    const VertexId a = mesh_.from(edge), b = mesh_.to(edge), c = mesh_.apex(edge),
                   d = mesh_.apex(mesh_.across(edge));
    return turn(c, a, d) == Sign::positive && turn(d, b, c) == Sign::positive;
}

/// Flips the free edges between two vertices until an edge joins them. No vertex lies between them.
void Subdivision::force_edge(VertexId from, VertexId to) {
    if (mesh_.find_edge(from, to).triangle != no_index) return;
    in_the_way_.clear();
    Edge edge{no_index, 0};
    mesh_.any_around(from, [&](TriangleId t, int k) {
        const VertexId right = mesh_[t].v[(k + 1) % 3], left = mesh_[t].v[(k + 2) % 3];
        if (turn(from, to, right) == Sign::negative && turn(from, to, left) == Sign::positive)
            edge = {t, (k + 1) % 3};
        return edge.triangle != no_index;
    });
    for (;;) {
        in_the_way_.push_back({mesh_.from(edge), mesh_.to(edge)});
        const Edge across = mesh_.across(edge);
        const VertexId apex = mesh_.apex(across);
        if (apex == to) break;
        edge = {across.triangle, (across.k + (turn(from, to, apex) == Sign::positive ? 1 : 2)) % 3};
    }
    // Each pass over the queue flips at least one edge away; those that cannot be flipped yet wait.
    for (std::size_t at = 0; at < in_the_way_.size(); ++at) {
        const auto [p, q] = in_the_way_[at];
        const Edge crossing = mesh_.find_edge(p, q);
        if (!may_flip(crossing)) {
            in_the_way_.push_back({p, q});
            continue;
        }
        const VertexId c = mesh_.apex(crossing), d = mesh_.apex(mesh_.across(crossing));
        mesh_.flip(crossing);
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
    for (TriangleId t = 0; t < mesh_.size(); ++t)
        for (int k = 0; k < 3; ++k) {
            const TriangleId neighbour = mesh_[t].neighbour[k];
            if (neighbour != no_index && neighbour > t && !mesh_.owner({t, k}))
                in_the_way_.push_back({mesh_.from({t, k}), mesh_.to({t, k})});
        }
    const std::size_t limit = 64 * in_the_way_.size() + 64;
    for (std::size_t at = 0; at < in_the_way_.size() && at < limit; ++at) {
        const auto [p, q] = in_the_way_[at];
        const Edge edge = mesh_.find_edge(p, q);
        if (edge.triangle == no_index) continue;
        const Edge across = mesh_.across(edge);
        if (across.triangle == no_index || mesh_.owner(edge)) continue;
        const VertexId a = mesh_.from(edge), b = mesh_.to(edge), c = mesh_.apex(edge), d = mesh_.apex(across);
        if (!prefers_flip(a, b, c, d) || !may_flip(edge)) continue;
        mesh_.flip(edge);
        for (const auto& side : {std::pair{b, c}, {c, a}, {a, d}, {d, b}}) in_the_way_.push_back(side);
    }
}

}  // namespace octavo::boolean
