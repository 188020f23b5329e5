// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <set>

#include <octavo/exact/orient.hpp>
#include <octavo/exact/plane.hpp>
#include <octavo/mesh/disjoint_sets.hpp>
#include <octavo/mesh/repair_steps.hpp>

namespace octavo::mesh {
namespace {

VertexIndex third_vertex(const RepairSoup& soup, SideIndex side) {
    return soup.triangles[side / 3][(side % 3 + 2) % 3];
}

/// The facets at one edge in their order round it, counter-clockwise about the direction up; empty when two of
/// them lie in one half-plane, or a facet has no area on the lattice.
std::vector<SideIndex> radial_order(const RepairSoup& soup, const EdgeTable& edges, EdgeIndex edge) {
    using exact::Point;
    using exact::Sign;
    const Point low = soup.points[edges.ends[edge][0]], high = soup.points[edges.ends[edge][1]];
    const auto apex = [&](SideIndex side) { return soup.points[third_vertex(soup, side)]; };
    const auto sides = edges.sides_of(edge);
    const Point reference = apex(sides[0]);
    // 0: the half-plane of the first facet; 1: the half turn after it; 2: opposite; 3: the half turn before it.
    const auto quarter = [&](Point p) {
        const Sign side = orient3d(low, high, reference, p);
        if (side != Sign::zero) return side == Sign::positive ? 1 : 3;
        const int axis = exact::Plane::through(low, high, reference).dominant_axis();
        return orient2d(axis, low, high, reference) == orient2d(axis, low, high, p) ? 0 : 2;
    };
    for (const SideIndex side : sides)
        if (exact::collinear(low, high, apex(side))) return {};
    std::vector<SideIndex> order(sides.begin(), sides.end());
    const auto before = [&](SideIndex a, SideIndex b) {
        const Point p = apex(a), q = apex(b);
        const int i = quarter(p), j = quarter(q);
        if (i != j) return i < j;
        return i % 2 == 1 && orient3d(low, high, p, q) == Sign::positive;
    };
    std::sort(order.begin(), order.end(), before);
    for (std::size_t i = 1; i < order.size(); ++i)
        if (!before(order[i - 1], order[i])) return {};
    return order;
}

/// How the facets at a crowded edge are paired: those that bound the same solid there, those that bound the same
/// empty space, or not at all.
enum class Pairing : std::uint8_t { solid, empty, none };

/// The pairs of sides at a crowded edge; none when it is not certain which belong together. A facet that runs up has
/// the solid before it in the order, one that runs down after it, so they must alternate.
std::vector<std::array<SideIndex, 2>> certain_pairs(const RepairSoup& soup, const EdgeTable& edges,
                                                    EdgeIndex edge, Pairing pairing) {
    std::vector<std::array<SideIndex, 2>> pairs;
    if (pairing == Pairing::none) return pairs;
    const std::vector<SideIndex> order = radial_order(soup, edges, edge);
    for (std::size_t i = 0; i < order.size(); ++i) {
        const SideIndex side = order[i], next = order[(i + 1) % order.size()];
        const bool up = runs_upward(soup.triangles, side);
        if (up == runs_upward(soup.triangles, next)) return {};
        if (up == (pairing == Pairing::empty)) pairs.push_back({side, next});
    }
    return pairs;
}

/// Joins the corners of two sides at either end of their edge.
void join_corners(const RepairSoup& soup, DisjointSets& corners, SideIndex a, SideIndex b) {
    const bool up_a = runs_upward(soup.triangles, a), up_b = runs_upward(soup.triangles, b);
    corners.unite(up_a ? a : next_side(a), up_b ? b : next_side(b));
    corners.unite(up_a ? next_side(a) : a, up_b ? next_side(b) : b);
}

/// The corners that stay together at each vertex when crowded edges are paired as told.
DisjointSets fans_of_pairings(const RepairSoup& soup, const EdgeTable& edges,
                              const std::vector<Pairing>& pairing) {
    DisjointSets corners(3 * soup.triangles.size());
    for (EdgeIndex edge = 0; edge < edges.size(); ++edge) {
        const auto sides = edges.sides_of(edge);
        const auto pairs = certain_pairs(soup, edges, edge, pairing[edge]);
        for (const auto& [a, b] : pairs) join_corners(soup, corners, a, b);
        for (std::size_t i = 1; pairs.empty() && i < sides.size(); ++i)
            join_corners(soup, corners, sides[0], sides[i]);
    }
    return corners;
}

/// Do two pairs of the edge still have both ends in common? Their surfaces are joined round the ends, so that
/// doubling vertices does not separate them.
bool stays_crowded(const RepairSoup& soup, DisjointSets& corners,
                   const std::vector<std::array<SideIndex, 2>>& pairs) {
    std::set<std::pair<SideIndex, SideIndex>> ends;
    for (const auto& [side, other] : pairs) {
        const bool up = runs_upward(soup.triangles, side);
        const SideIndex low = corners.find(up ? side : next_side(side));
        const SideIndex high = corners.find(up ? next_side(side) : side);
        if (!ends.insert({low, high}).second) return true;
    }
    return false;
}

/// How to pair each edge so that it comes apart.
std::vector<Pairing> choose_pairings(const RepairSoup& soup, const EdgeTable& edges) {
    std::vector<Pairing> pairing(edges.size(), Pairing::none);
    for (EdgeIndex edge = 0; edge < edges.size(); ++edge)
        if (edges.sides_of(edge).size() > 2 && !certain_pairs(soup, edges, edge, Pairing::solid).empty())
            pairing[edge] = Pairing::solid;
    // An edge given up joins more corners, which may spoil others: until nothing changes.
    for (bool changed = true; changed;) {
        changed = false;
        DisjointSets corners = fans_of_pairings(soup, edges, pairing);
        for (EdgeIndex edge = 0; edge < edges.size(); ++edge) {
            if (pairing[edge] == Pairing::none) continue;
            if (!stays_crowded(soup, corners, certain_pairs(soup, edges, edge, pairing[edge]))) continue;
            pairing[edge] = pairing[edge] == Pairing::solid ? Pairing::empty : Pairing::none;
            changed = true;
        }
    }
    return pairing;
}

}  // namespace

RepairDone separate_edges(RepairSoup& soup, RepairDone& vertices) {
    const EdgeTable edges = soup.edges();
    const std::vector<Pairing> pairing = choose_pairings(soup, edges);
    DisjointSets corners = fans_of_pairings(soup, edges, pairing);
    RepairDone done;
    for (EdgeIndex edge = 0; edge < edges.size(); ++edge) {
        if (pairing[edge] == Pairing::none) continue;
        ++done.count;
        for (const SideIndex side : edges.sides_of(edge)) done.faces.push_back(soup.origin[side / 3]);
    }
    // The fan with the lowest corner keeps the vertex, each other gets a copy.
    std::vector<SideIndex> fan_of_vertex(soup.vertices.size(), no_index);
    std::vector<VertexIndex> copy_of_fan(3 * soup.triangles.size(), no_index);
    for (SideIndex corner = 0; corner < copy_of_fan.size(); ++corner) {
        VertexIndex& vertex = soup.triangles[corner / 3][corner % 3];
        const SideIndex fan = corners.find(corner);
        if (fan_of_vertex[vertex] == no_index) fan_of_vertex[vertex] = fan;
        if (fan_of_vertex[vertex] == fan) continue;
        if (copy_of_fan[fan] == no_index) {
            copy_of_fan[fan] = static_cast<VertexIndex>(soup.vertices.size());
            soup.vertices.push_back(soup.vertices[vertex]);
            soup.points.push_back(soup.points[vertex]);
            ++vertices.count;
        }
        vertex = copy_of_fan[fan];
    }
    return done;
}

}  // namespace octavo::mesh
