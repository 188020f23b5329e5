// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <octavo/base/parallel.hpp>
#include <octavo/boolean/near_contacts.hpp>
#include <octavo/exact/orient.hpp>
#include <octavo/exact/plane.hpp>

namespace octavo::boolean {
namespace {

using exact::Point;

Vec3 between(Point from, Point to) {
    return {static_cast<double>(to.x - from.x), static_cast<double>(to.y - from.y),
            static_cast<double>(to.z - from.z)};
}

/// Where on the line from a to b the point is nearest, 0 at a and 1 at b, and how near.
struct Foot {
    double at, distance;
};

Foot foot(Point a, Point b, Point point) {
    const Vec3 along = between(a, b), offset = between(a, point);
    const double at = dot(along, offset) / dot(along, along);
    return {at, length(offset - at * along)};
}

/// A facet with its normal, which is exact up to one rounding however thin the facet is.
struct Side {
    std::uint32_t id;
    mesh::Triangle corner;
    Point point[3];
    Vec3 normal;
    double area2;  ///< the normal's length

    Side(const Soup& soup, std::uint32_t facet) : id(facet), corner(soup.facets[facet]) {
        for (int k = 0; k < 3; ++k) point[k] = soup.points[corner[static_cast<std::size_t>(k)]];
        const exact::Plane plane = exact::Plane::through(point[0], point[1], point[2]);
        normal = {static_cast<double>(plane.a()), static_cast<double>(plane.b()),
                  static_cast<double>(plane.c())};
        area2 = length(normal);
    }
    Edge edge(int k) const {
        return {corner[static_cast<std::size_t>(k)], corner[static_cast<std::size_t>((k + 1) % 3)]};
    }
    bool has(std::uint32_t vertex) const {
        return corner[0] == vertex || corner[1] == vertex || corner[2] == vertex;
    }
};

class NearSearch {
  public:
    NearSearch(double tolerance, NearContacts& found) : tolerance_(tolerance), found_(found) {}

    /// A facet's corners among themselves.
    void own(const Side& side) {
        for (int k = 0; k < 3; ++k) {
            const int a = (k + 1) % 3, b = (k + 2) % 3;
            const Vec3 along = between(side.point[a], side.point[b]);
            if (length(along) <= tolerance_) add_vertices(side.corner[a], side.corner[b]);
            if (side.area2 > tolerance_ * length(along)) continue;
            const double at = foot(side.point[a], side.point[b], side.point[k]).at;
            if (at > 0 && at < 1) found_.on_edge.push_back({side.edge(a), side.corner[k], false});
        }
    }

    void meet(const Side& first, const Side& second) {
        for (int k = 0; k < 3; ++k) {
            if (!first.has(second.corner[k])) place(second.corner[k], second.point[k], first);
            if (!second.has(first.corner[k])) place(first.corner[k], first.point[k], second);
        }
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) cross_edges(first, i, second, j);
        // Half a right angle: what overlaps within the tolerance over more than its own width is nearer to parallel.
        if (std::fabs(dot(first.normal, second.normal)) > 0.7 * first.area2 * second.area2)
            found_.faces.push_back({std::min(first.id, second.id), std::max(first.id, second.id)});
    }

  private:
    void add_vertices(std::uint32_t a, std::uint32_t b) {
        found_.at_vertex.push_back({std::min(a, b), std::max(a, b)});
    }

    bool is_at_corner(std::uint32_t vertex, Point point, const Side& side) {
        for (int k = 0; k < 3; ++k)
            if (length(between(side.point[k], point)) <= tolerance_) {
                add_vertices(vertex, side.corner[k]);
                return true;
            }
        return false;
    }

    /// Where a vertex lies on another facet: at a corner, on edges, or inside.
    void place(std::uint32_t vertex, Point point, const Side& side) {
        const bool at_corner = is_at_corner(vertex, point, side);
        bool on_edge = false;
        for (int k = 0; k < 3; ++k) {
            const Point a = side.point[k], b = side.point[(k + 1) % 3];
            const Foot foot_on = foot(a, b, point);
            if (foot_on.at <= 0 || foot_on.at >= 1) continue;
            // What lies on an edge is told however near it is to a corner: the surface may close there
            // (t_junctions.hpp).
            const bool exact = foot_on.distance < 1 && exact::collinear(a, b, point);
            if (!exact && (at_corner || foot_on.distance > tolerance_)) continue;
            on_edge = true;
            found_.on_edge.push_back({side.edge(k), vertex, exact});
        }
        if (at_corner || on_edge ||
            std::fabs(dot(side.normal, between(side.point[0], point))) > tolerance_ * side.area2)
            return;
        for (int k = 0; k < 3; ++k) {
            const Vec3 along = between(side.point[k], side.point[(k + 1) % 3]);
            if (dot(octavo::cross(along, between(side.point[k], point)), side.normal) <= 0) return;
        }
        found_.on_facet.push_back(
            {side.id, vertex,
             exact::orient3d(side.point[0], side.point[1], side.point[2], point) == exact::Sign::zero});
    }

    /// The edges as they are named, so that every pair of facets finds the same numbers.
    void cross_edges(const Side& one, int i, const Side& other, int j) {
        struct Ends {
            Edge edge;
            Point low, high;
        };
        const auto ends = [](const Side& side, int k) {
            const auto from = static_cast<std::size_t>(k), to = (from + 1) % 3;
            const bool up = side.corner[from] < side.corner[to];
            return Ends{side.edge(k), side.point[up ? from : to], side.point[up ? to : from]};
        };
        Ends e = ends(one, i), f = ends(other, j);
        if (e.edge.low == f.edge.low || e.edge.low == f.edge.high || e.edge.high == f.edge.low ||
            e.edge.high == f.edge.high)
            return;
        if (f.edge < e.edge) std::swap(e, f);
        const Vec3 u = between(e.low, e.high), v = between(f.low, f.high), w = between(f.low, e.low);
        const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), uw = dot(u, w), vw = dot(v, w);
        const double determinant = uu * vv - uv * uv;
        if (!(determinant > 1e-12 * uu * vv)) return;  // parallel: ends are near the other edge
        const double s = (uv * vw - vv * uw) / determinant, t = (uu * vw - uv * uw) / determinant;
        if (!(s > 0 && s < 1 && t > 0 && t < 1)) return;
        const Vec3 way = w + s * u - t * v;
        if (length(way) > tolerance_) return;
        // Where an end is near the other edge, the vertex will be on both and there is nothing to cross.
        if (foot(f.low, f.high, e.low).distance <= tolerance_ ||
            foot(f.low, f.high, e.high).distance <= tolerance_ ||
            foot(e.low, e.high, f.low).distance <= tolerance_ ||
            foot(e.low, e.high, f.high).distance <= tolerance_)
            return;
        const Vec3 middle = s * u - 0.5 * way;  // from e.low
        const Point nearest{e.low.x + static_cast<std::int32_t>(std::nearbyint(middle.x)),
                            e.low.y + static_cast<std::int32_t>(std::nearbyint(middle.y)),
                            e.low.z + static_cast<std::int32_t>(std::nearbyint(middle.z))};
        found_.crossings.push_back(
            {e.edge, f.edge, nearest, exact::orient3d(e.low, e.high, f.low, f.high) == exact::Sign::zero});
    }

    double tolerance_;
    NearContacts& found_;
};

template <class Each>
void sort_once(std::vector<Each>& list) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
}

template <class Each>
void append(std::vector<Each>& all, std::vector<Each>& part) {
    all.insert(all.end(), part.begin(), part.end());
    part = {};
}

}  // namespace

std::size_t NearContacts::inexact() const {
    const auto count = [](const auto& list) {
        return static_cast<std::size_t>(
            std::count_if(list.begin(), list.end(), [](const auto& each) { return !each.exact; }));
    };
    return at_vertex.size() + count(on_edge) + count(on_facet) + count(crossings);
}

NearContacts find_near_contacts(const Soup& soup, const FacetTree& tree, double tolerance,
                                const Context& context) {
    const std::vector<FacetTree::Task> tasks = tree.pair_tasks(soup.facets.size() < 2000 ? 1 : 256);
    std::vector<NearContacts> parts(tasks.size());
    parallel_chunks(context, tasks.size(), 4, [&](std::size_t begin, std::size_t end) {
        for (std::size_t task = begin; task < end; ++task) {
            NearSearch search(tolerance, parts[task]);
            tree.for_each_pair(tasks[task], [&](std::uint32_t a, std::uint32_t b) {
                search.meet(Side(soup, a), Side(soup, b));
            });
        }
    });
    constexpr std::size_t grain = 1 << 14;
    std::vector<NearContacts> slivers(soup.facets.size() / grain + 1);
    parallel_chunks(context, soup.facets.size(), grain, [&](std::size_t begin, std::size_t end) {
        NearSearch search(tolerance, slivers[begin / grain]);
        for (std::size_t facet = begin; facet < end; ++facet)
            search.own(Side(soup, static_cast<std::uint32_t>(facet)));
    });

    NearContacts all;
    for (std::vector<NearContacts>* const list : {&parts, &slivers})
        for (NearContacts& part : *list) {
            append(all.at_vertex, part.at_vertex);
            append(all.on_edge, part.on_edge);
            append(all.on_facet, part.on_facet);
            append(all.crossings, part.crossings);
            append(all.faces, part.faces);
        }
    sort_once(all.at_vertex);
    sort_once(all.on_edge);
    sort_once(all.on_facet);
    sort_once(all.crossings);
    sort_once(all.faces);
    return all;
}

}  // namespace octavo::boolean
