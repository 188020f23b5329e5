// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <tuple>

#include <octavo/base/parallel_sort.hpp>
#include <octavo/boolean/faces.hpp>
#include <octavo/exact/orient.hpp>
#include <octavo/exact/plane.hpp>

namespace octavo::boolean {
namespace {

using exact::Plane;
using exact::Point;
using exact::Sign;

/// An edge that may be forgotten, between corner `k` and the next of facet `first`.
struct FlatEdge {
    std::uint32_t low, high;
    std::uint32_t first, k, second;
    double length;  ///< squared, rounded
};

std::uint32_t opposite_corner(const mesh::Triangle& facet, std::uint32_t p, std::uint32_t q) {
    return facet[0] != p && facet[0] != q ? facet[0] : facet[1] != p && facet[1] != q ? facet[1] : facet[2];
}

/// Whether facet `first` = (p, q, a), and (q, p, d), make a strictly convex quadrilateral.
bool is_convex(const Soup& soup, const mesh::Triangle& first, std::uint32_t k, std::uint32_t opposite) {
    const Point p = soup.points[first[k]], q = soup.points[first[(k + 1) % 3]],
                a = soup.points[first[(k + 2) % 3]], d = soup.points[opposite];
    const Plane plane = Plane::through(p, q, a);
    if (plane.value_at(d) != 0) return false;
    const int axis = plane.dominant_axis();
    const Sign up = exact::sign_of(plane.normal(axis));
    return exact::orient2d(axis, p, d, q) == up && exact::orient2d(axis, a, p, d) == up &&
           exact::orient2d(axis, d, q, a) == up;
}

/// Edges between two of the facets, which run along them in opposite directions and make a convex quadrilateral.
std::vector<FlatEdge> find_flat_edges(const Soup& soup, const std::vector<std::uint32_t>& facets,
                                      const Context& context) {
    struct Side {
        std::uint32_t low, high, facet, k;
        bool operator<(const Side& other) const {
            return std::tie(low, high, facet) < std::tie(other.low, other.high, other.facet);
        }
    };
    std::vector<Side> sides;
    sides.reserve(3 * facets.size());
    for (const std::uint32_t facet : facets)
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint32_t from = soup.facets[facet][k], to = soup.facets[facet][(k + 1) % 3];
            sides.push_back({std::min(from, to), std::max(from, to), facet, k});
        }
    parallel_sort(context, sides);
    std::vector<FlatEdge> edges;
    for (std::size_t i = 0, end; i < sides.size(); i = end) {
        for (end = i + 1;
             end < sides.size() && sides[end].low == sides[i].low && sides[end].high == sides[i].high;)
            ++end;
        if (end != i + 2) continue;
        const Side &side = sides[i], &other = sides[i + 1];
        const mesh::Triangle &first = soup.facets[side.facet], &second = soup.facets[other.facet];
        if (first[side.k] == second[other.k] || soup.transition[side.facet] != soup.transition[other.facet] ||
            !is_convex(soup, first, side.k, opposite_corner(second, side.low, side.high)))
            continue;
        const Point p = soup.points[side.low], q = soup.points[side.high];
        double length = 0;
        for (int axis = 0; axis < 3; ++axis) length += double(q[axis] - p[axis]) * double(q[axis] - p[axis]);
        edges.push_back({side.low, side.high, side.facet, side.k, other.facet, length});
    }
    return edges;
}

/// Drops the edges that more than two facets of the soup have. They come sorted by their ends.
void drop_shared(const Soup& soup, std::vector<FlatEdge>& edges, const Context& context) {
    std::vector<char> is_end(soup.points.size(), 0);
    for (const FlatEdge& edge : edges) is_end[edge.low] = is_end[edge.high] = 1;
    constexpr std::size_t grain = 1 << 12;
    std::vector<std::vector<std::uint32_t>> found(soup.facets.size() / grain + 1);
    parallel_chunks(context, soup.facets.size(), grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t facet = begin; facet < end; ++facet) {
            const mesh::Triangle& t = soup.facets[facet];
            if (is_end[t[0]] + is_end[t[1]] + is_end[t[2]] < 2) continue;
            for (std::uint32_t k = 0; k < 3; ++k) {
                const auto key = std::minmax(t[k], t[(k + 1) % 3]);
                const auto at = std::lower_bound(
                    edges.begin(), edges.end(), key, [](const FlatEdge& edge, const auto& of) {
                        return std::tie(edge.low, edge.high) < std::tie(of.first, of.second);
                    });
                if (at != edges.end() && at->low == key.first && at->high == key.second)
                    found[begin / grain].push_back(static_cast<std::uint32_t>(at - edges.begin()));
            }
        }
    });
    std::vector<std::uint32_t> facets_at(edges.size(), 0);
    for (const std::vector<std::uint32_t>& part : found)
        for (const std::uint32_t edge : part) ++facets_at[edge];
    std::size_t kept = 0;
    for (std::size_t i = 0; i < edges.size(); ++i)
        if (facets_at[i] == 2) edges[kept++] = edges[i];
    edges.resize(kept);
}

}  // namespace

Faces::Faces(const Soup& soup, std::span<const std::pair<std::uint32_t, std::uint32_t>> near,
             const Context& context) {
    std::vector<char> is_near(soup.facets.size(), 0);
    for (const auto& [first, second] : near) is_near[first] = is_near[second] = 1;
    std::vector<std::uint32_t> facets;
    for (std::uint32_t facet = 0; facet < is_near.size(); ++facet)
        if (is_near[facet]) facets.push_back(facet);
    std::vector<FlatEdge> edges = find_flat_edges(soup, facets, context);
    if (edges.empty()) return;
    drop_shared(soup, edges, context);
    if (context.cancelled()) return;
    std::stable_sort(edges.begin(), edges.end(),
                     [](const FlatEdge& a, const FlatEdge& b) { return a.length > b.length; });
    if (!edges.empty()) partner_.assign(soup.facets.size(), no_index);
    for (const FlatEdge& edge : edges) {
        if (partner_[edge.first] != no_index || partner_[edge.second] != no_index) continue;
        partner_[edge.first] = edge.second;
        partner_[edge.second] = edge.first;
    }
}

Faces::Corners Faces::corners(const Soup& soup, std::uint32_t face) const {
    const mesh::Triangle& t = soup.facets[face];
    const std::uint32_t other = partner(face);
    if (other == no_index) return {3, {t[0], t[1], t[2], no_index}};
    const mesh::Triangle& u = soup.facets[other];
    // The corner that the other facet does not have is opposite to the common edge.
    std::uint32_t k = 0;
    while (t[k] == u[0] || t[k] == u[1] || t[k] == u[2]) ++k;
    const std::uint32_t p = t[(k + 1) % 3], q = t[(k + 2) % 3];
    return {4, {p, opposite_corner(u, p, q), q, t[k]}};
}

}  // namespace octavo::boolean
