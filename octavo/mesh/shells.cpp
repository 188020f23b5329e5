// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>

#include <octavo/exact/orient.hpp>
#include <octavo/exact/plane.hpp>
#include <octavo/mesh/measure.hpp>
#include <octavo/mesh/shells.hpp>

namespace octavo::mesh {
namespace {

using exact::Point;
using exact::Sign;
using exact::sign_of;

/// The place that asks for a shell.
struct Query {
    Point point;
    std::uint32_t shell = 0;
};

/// Queries by their y and z, for facets to find those that they may cover.
class QueryGrid {
  public:
    explicit QueryGrid(std::span<const Query> queries) : queries_(queries) {
        const auto side = static_cast<std::int32_t>(std::sqrt(static_cast<double>(queries.size())));
        cells_ = std::clamp(side, 1, 1024);
        width_ = exact::universe_side / cells_ + 1;
        begin_.assign(static_cast<std::size_t>(cells_) * static_cast<std::size_t>(cells_) + 2, 0);
        for (const Query& query : queries) ++begin_[cell(query.point.y / width_, query.point.z / width_) + 2];
        for (std::size_t i = 2; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
        members_.resize(queries.size());
        for (std::uint32_t i = 0; i < queries.size(); ++i)
            members_[begin_[cell(queries[i].point.y / width_, queries[i].point.z / width_) + 1]++] = i;
        begin_.pop_back();
    }

    /// Calls visit(query) for those in the box, and maybe others.
    template <class Visit>
    void for_each_in(std::int32_t y0, std::int32_t y1, std::int32_t z0, std::int32_t z1,
                     const Visit& visit) const {
        for (std::int32_t row = z0 / width_; row <= z1 / width_; ++row) {
            const std::size_t first = begin_[cell(y0 / width_, row)],
                              last = begin_[cell(y1 / width_, row) + 1];
            for (std::size_t i = first; i < last; ++i) visit(queries_[members_[i]]);
        }
    }

  private:
    std::size_t cell(std::int32_t column, std::int32_t row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(cells_) +
               static_cast<std::size_t>(column);
    }

    std::span<const Query> queries_;
    std::int32_t cells_ = 1, width_ = 1;
    std::vector<std::uint32_t> begin_, members_;
};

/// How the ray from q to the left crosses a facet.
struct Crossing {
    int direction = 0;      ///< +1 outwards, −1 inwards, 0 not at all
    bool at_start = false;  ///< q may lie on the facet, so that the answer is that of the symbolic step
};

Crossing crossing_to_the_left(const std::array<Point, 3>& facet, Point q) {
    const exact::Plane plane = exact::Plane::through(facet[0], facet[1], facet[2]);
    const Sign side = sign_of(plane.value_at(q)), outward_x = sign_of(plane.a());
    // The caller knows that q is in the facet's box but for being right of it.
    if (side == Sign::zero) return {0, q.x <= std::max({facet[0].x, facet[1].x, facet[2].x})};
    if (side * outward_x != Sign::positive) return {};
    // In the plane of y and z: is the moved q in the triangle? Half-open in z for the step in z, and a point on
    // an edge is right of it for the step in y.
    int edges_beyond = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Point a = facet[i], b = facet[(i + 1) % 3];
        if ((a.z > q.z) == (b.z > q.z)) continue;
        edges_beyond += (a.z > q.z ? orient2d(0, b, a, q) : orient2d(0, a, b, q)) == Sign::positive;
    }
    if (edges_beyond != 1) return {};
    return {outward_x == Sign::negative ? 1 : -1, false};
}

std::vector<bool> balanced_edges(const EdgeTable& edges, std::span<const Triangle> triangles) {
    std::vector<bool> balanced(edges.size());
    for (EdgeIndex edge = 0; edge < edges.size(); ++edge) {
        int balance = 0;
        for (const SideIndex side : edges.sides_of(edge)) balance += runs_upward(triangles, side) ? 1 : -1;
        balanced[edge] = balance == 0;
    }
    return balanced;
}

Shells gather_shells(std::span<const Point> points, std::span<const Triangle> triangles,
                     const EdgeTable& edges) {
    Shells result;
    const Components components = components_by_edge(edges, triangles.size());
    const std::vector<bool> balanced = balanced_edges(edges, triangles);
    std::vector<std::uint32_t> number(components.count, no_index);
    result.of_face.assign(triangles.size(), no_index);
    for (FaceIndex face = 0; face < triangles.size(); ++face) {
        if (edges.edge_of_side[std::size_t{3} * face] == no_index) continue;
        std::uint32_t& shell = number[components.of_face[face]];
        if (shell == no_index) {
            shell = static_cast<std::uint32_t>(result.shells.size());
            result.shells.emplace_back().closed = true;
        }
        result.of_face[face] = shell;
        Shell& s = result.shells[shell];
        ++s.faces;
        s.volume6 += exact_volume6(points, triangles.subspan(face, 1));
        for (std::size_t k = 0; k < 3; ++k)
            s.closed = s.closed && balanced[edges.edge_of_side[std::size_t{3} * face + k]];
    }
    return result;
}

/// The vertices of a shell that are tried one after the other: the ends along an axis, which lie far apart, so that
/// hardly all of them are on other shells.
constexpr std::uint32_t most_attempts = 6;

bool further_out(Point p, Point q, std::uint32_t attempt) {
    const int axis = static_cast<int>(attempt / 2);
    const bool first = attempt % 2 == 0;
    if (p[axis] != q[axis]) return first ? p[axis] < q[axis] : p[axis] > q[axis];
    return first ? p < q : q < p;
}

/// For each shell that asks, the vertex of this attempt.
std::vector<Query> choose_queries(std::span<const Point> points, std::span<const Triangle> triangles,
                                  const Shells& shells, const std::vector<bool>& asks,
                                  std::uint32_t attempt) {
    std::vector<Query> queries;
    std::vector<std::uint32_t> number(shells.shells.size(), no_index);
    for (FaceIndex face = 0; face < triangles.size(); ++face) {
        const std::uint32_t shell = shells.of_face[face];
        if (shell == no_index || !asks[shell]) continue;
        if (number[shell] == no_index) {
            number[shell] = static_cast<std::uint32_t>(queries.size());
            queries.push_back({points[triangles[face][0]], shell});
        }
        Point& best = queries[number[shell]].point;
        for (const VertexIndex vertex : triangles[face])
            if (further_out(points[vertex], best, attempt)) best = points[vertex];
    }
    return queries;
}

}  // namespace

Shells find_shells(std::span<const Point> points, std::span<const Triangle> triangles,
                   const EdgeTable& edges) {
    Shells result = gather_shells(points, triangles, edges);
    std::vector<bool> asks(result.shells.size());
    for (std::size_t shell = 0; shell < asks.size(); ++shell) asks[shell] = result.shells[shell].closed;
    if (std::count(asks.begin(), asks.end(), true) < 2) return result;

    for (std::uint32_t attempt = 0; attempt < most_attempts; ++attempt) {
        const std::vector<Query> queries = choose_queries(points, triangles, result, asks, attempt);
        if (queries.empty()) break;
        const QueryGrid grid(queries);
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::int32_t> winding;  // {asking shell, other}
        std::vector<bool> on_another(result.shells.size());
        for (FaceIndex face = 0; face < triangles.size(); ++face) {
            const std::uint32_t shell = result.of_face[face];
            if (shell == no_index || !result.shells[shell].closed) continue;
            const auto [i, j, k] = triangles[face];
            const std::array<Point, 3> facet{points[i], points[j], points[k]};
            const auto [y0, y1] = std::minmax({facet[0].y, facet[1].y, facet[2].y});
            const auto [z0, z1] = std::minmax({facet[0].z, facet[1].z, facet[2].z});
            const std::int32_t x0 = std::min({facet[0].x, facet[1].x, facet[2].x});
            grid.for_each_in(y0, y1, z0, z1, [&, y0 = y0, y1 = y1, z0 = z0, z1 = z1](const Query& query) {
                const Point q = query.point;
                if (query.shell == shell || q.x < x0 || q.y < y0 || q.y > y1 || q.z < z0 || q.z > z1) return;
                const Crossing crossing = crossing_to_the_left(facet, q);
                if (crossing.at_start) on_another[query.shell] = true;
                if (crossing.direction != 0) winding[{query.shell, shell}] += crossing.direction;
            });
        }
        const bool last = attempt + 1 == most_attempts;
        for (const Query& query : queries) asks[query.shell] = on_another[query.shell] && !last;
        for (const auto& [pair, turns] : winding)
            if (turns != 0 && !asks[pair.first])
                result.shells[pair.first].enclosures.push_back({pair.second, turns});
    }
    return result;
}

}  // namespace octavo::mesh
