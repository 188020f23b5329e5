// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>

#include <octavo/boolean/cells.hpp>
#include <octavo/boolean/flush_sheet.hpp>

namespace octavo::boolean {
namespace {

using exact::Plane;
using exact::Point;
using DirectedEdge = std::pair<std::uint32_t, std::uint32_t>;

/// What is left of directed edges when those that run both ways have cancelled; sorted.
std::vector<DirectedEdge> net(std::vector<DirectedEdge> edges) {
    std::map<DirectedEdge, int> sum;
    for (const auto& [from, to] : edges)
        if (from != to) sum[std::minmax(from, to)] += from < to ? 1 : -1;
    std::vector<DirectedEdge> left;
    for (const auto& [edge, times] : sum)
        for (int i = 0; i < std::abs(times); ++i)
            left.push_back(times > 0 ? edge : DirectedEdge{edge.second, edge.first});
    std::sort(left.begin(), left.end());
    return left;
}

std::vector<DirectedEdge> net_border(std::span<const std::uint32_t> border) {
    std::vector<DirectedEdge> edges;
    for (std::size_t i = 0; i < border.size(); ++i)
        edges.push_back({border[i], border[(i + 1) % border.size()]});
    return net(std::move(edges));
}

std::vector<DirectedEdge> net_border(std::span<const mesh::Triangle> triangles) {
    std::vector<DirectedEdge> edges;
    for (const mesh::Triangle& t : triangles)
        for (std::size_t k = 0; k < 3; ++k) edges.push_back({t[k], t[(k + 1) % 3]});
    return net(std::move(edges));
}

double distance2(Point a, Point b) {
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double way = b[axis] - a[axis];
        sum += way * way;
    }
    return sum;
}

/// The plane through three of the points that lie far apart; degenerate when all are on one line.
Plane wide_plane(std::span<const Point> points) {
    const Point a = points[0];
    const Point b = *std::max_element(points.begin(), points.end(),
                                      [&](Point p, Point q) { return distance2(a, p) < distance2(a, q); });
    const auto area = [&](Point p) {
        const Plane plane = Plane::through(a, b, p);
        double sum = 0;
        for (int axis = 0; axis < 3; ++axis)
            sum += static_cast<double>(plane.normal(axis)) * static_cast<double>(plane.normal(axis));
        return sum;
    };
    const Point c =
        *std::max_element(points.begin(), points.end(), [&](Point p, Point q) { return area(p) < area(q); });
    return Plane::through(a, b, c);
}

bool is_flat(const Plane& plane, std::span<const Point> points, double flatness) {
    double square = 0;
    for (int axis = 0; axis < 3; ++axis)
        square += static_cast<double>(plane.normal(axis)) * static_cast<double>(plane.normal(axis));
    const double bound = flatness * std::sqrt(square);
    return std::all_of(points.begin(), points.end(), [&](Point point) {
        return std::fabs(static_cast<double>(plane.value_at(point))) <= bound;
    });
}

/// Whether no two points lie above each other.
bool are_apart(std::span<const Point> points, int axis) {
    std::vector<std::pair<std::int32_t, std::int32_t>> seen;
    for (const Point point : points) seen.push_back({point[(axis + 1) % 3], point[(axis + 2) % 3]});
    std::sort(seen.begin(), seen.end());
    return std::adjacent_find(seen.begin(), seen.end()) == seen.end();
}

}  // namespace

bool subdivide_together(std::span<const BentFacet* const> facets, const Soup& soup, double flatness,
                        Subdivision& subdivision, std::span<std::vector<mesh::Triangle>> into) {
    std::vector<std::uint32_t> ids;
    for (const BentFacet* facet : facets) {
        ids.insert(ids.end(), facet->border.begin(), facet->border.end());
        ids.insert(ids.end(), facet->inner.begin(), facet->inner.end());
    }
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    std::vector<Point> at;
    for (const std::uint32_t id : ids) at.push_back(soup.points[id]);
    const Plane plane = wide_plane(at);
    if (plane.degenerate() || !is_flat(plane, at, flatness)) return false;
    const int axis = plane.dominant_axis();
    if (!are_apart(at, axis)) return false;

    subdivision.begin_round(plane, at);
    std::vector<Subdivision::PointOnLine> points;
    for (const std::uint32_t id : ids) points.push_back({id, Subdivision::no_line});
    subdivision.add_points(points);
    std::vector<std::vector<DirectedEdge>> borders;
    for (std::uint32_t i = 0; i < facets.size(); ++i) {
        borders.push_back(net_border(facets[i]->border));
        for (const auto& [from, to] : borders.back())
            subdivision.add_segment(
                subdivision.vertex_of(from), subdivision.vertex_of(to),
                subdivision.add_line(Plane::along_axis(axis, soup.points[from], soup.points[to])), i);
    }
    if (!subdivision.new_points().empty()) return false;
    subdivision.refine();

    Cells cells;
    cells.find(subdivision, no_index);
    const auto triangles = subdivision.triangles();
    for (std::size_t i = 0; i < triangles.size(); ++i)
        for (const std::uint32_t tag : cells.cover(cells.of_triangle()[i])) {
            const Subdivision::Triangle& t = triangles[i];
            into[tag].push_back(
                {subdivision.point_of(t.v[0]), subdivision.point_of(t.v[1]), subdivision.point_of(t.v[2])});
        }
    for (std::size_t i = 0; i < facets.size(); ++i) {
        const mesh::Triangle& corner = soup.facets[facets[i]->facet];
        const Plane own =
            Plane::through(soup.points[corner[0]], soup.points[corner[1]], soup.points[corner[2]]);
        if ((own.normal(axis) > 0) != (plane.normal(axis) > 0))
            for (mesh::Triangle& t : into[i]) std::swap(t[1], t[2]);
        if (net_border(into[i]) != borders[i]) return false;
    }
    return true;
}

std::vector<mesh::Triangle> fan(const BentFacet& facet) {
    std::vector<mesh::Triangle> triangles;
    if (net_border(facet.border).empty()) return triangles;
    const std::vector<std::uint32_t>& b = facet.border;
    for (std::size_t i = 1; i + 1 < b.size(); ++i)
        if (b[0] != b[i] && b[i] != b[i + 1] && b[i + 1] != b[0]) triangles.push_back({b[0], b[i], b[i + 1]});
    return triangles;
}

}  // namespace octavo::boolean
