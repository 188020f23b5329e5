// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <set>

#include <octavo/exact/orient.hpp>
#include <octavo/exact/plane.hpp>
#include <octavo/mesh/disjoint_sets.hpp>
#include <octavo/mesh/repair_steps.hpp>
#include <octavo/mesh/repeats.hpp>
#include <octavo/mesh/shells.hpp>
#include <octavo/mesh/topology.hpp>

namespace octavo::mesh {
namespace {

/// Does it turn as the same three vertices in ascending order do?
bool turns_forward(const Triangle& t) {
    return (t[0] < t[1] && t[1] < t[2]) || (t[1] < t[2] && t[2] < t[0]) || (t[2] < t[0] && t[0] < t[1]);
}

VertexIndex third_vertex(const RepairSoup& soup, SideIndex side) {
    return soup.triangles[side / 3][(side % 3 + 2) % 3];
}

void drop(RepairSoup& soup, const std::vector<bool>& dropped, RepairDone& done) {
    std::vector<bool> kept(dropped.size());
    for (std::size_t face = 0; face < dropped.size(); ++face) {
        kept[face] = !dropped[face];
        if (!dropped[face]) continue;
        ++done.count;
        done.faces.push_back(soup.origin[face]);
    }
    if (done.count != 0) soup.keep_only(kept);
}

EdgeTable edges_of(const RepairSoup& soup) { return build_edges(soup.triangles, soup.vertices.size()); }

}  // namespace

void RepairSoup::keep_only(const std::vector<bool>& kept) {
    std::size_t next = 0;
    for (std::size_t face = 0; face < triangles.size(); ++face) {
        if (!kept[face]) continue;
        triangles[next] = triangles[face];
        origin[next++] = origin[face];
    }
    triangles.resize(next);
    origin.resize(next);
}

RepairDone drop_collapsed_facets(RepairSoup& soup) {
    std::vector<bool> dropped;
    for (const Triangle& t : soup.triangles) dropped.push_back(names_a_vertex_twice(t));
    RepairDone done;
    drop(soup, dropped, done);
    return done;
}

RepairDone drop_duplicate_facets(RepairSoup& soup) {
    std::vector<bool> dropped(soup.triangles.size());
    for (const auto& group : groups_of_repeated_facets(soup.triangles, edges_of(soup))) {
        bool forward = false, backward = false;
        for (const FaceIndex face : group) {
            bool& seen = turns_forward(soup.triangles[face]) ? forward : backward;
            dropped[face] = seen;
            seen = true;
        }
    }
    RepairDone done;
    drop(soup, dropped, done);
    return done;
}

RepairDone drop_walls(RepairSoup& soup, RepairDone& flaps) {
    // After duplicates have gone a group is two facets back to back. Those joined by edges are one wall, whose
    // rim is the edges with one pair only or with other facets. The wall goes where other facets hold it, and only
    // where they close without it.
    const EdgeTable edges = edges_of(soup);
    const auto groups = groups_of_repeated_facets(soup.triangles, edges);
    std::vector<std::uint32_t> group_of_face(soup.triangles.size(), no_index);
    for (std::uint32_t g = 0; g < groups.size(); ++g)
        for (const FaceIndex face : groups[g]) group_of_face[face] = g;
    DisjointSets walls(groups.size());
    enum class Rim : std::uint8_t { free, closes, opens };
    std::vector<std::pair<std::uint32_t, Rim>> rims;  // by group
    std::vector<std::uint32_t> here;
    for (EdgeIndex edge = 0; edge < edges.size(); ++edge) {
        here.clear();
        std::size_t others = 0;
        for (const SideIndex side : edges.sides_of(edge)) {
            const std::uint32_t group = group_of_face[side / 3];
            if (group == no_index)
                ++others;
            else if (std::find(here.begin(), here.end(), group) == here.end())
                here.push_back(group);
        }
        for (const std::uint32_t group : here) walls.unite(here[0], group);
        if (here.size() > 1 && others == 0) continue;  // inside the wall
        const Rim rim = others == 0 ? Rim::free : others % 2 == 0 ? Rim::closes : Rim::opens;
        for (const std::uint32_t group : here) rims.push_back({group, rim});
    }
    std::vector<std::array<bool, 3>> has(groups.size());
    for (const auto& [group, rim] : rims) has[walls.find(group)][static_cast<std::size_t>(rim)] = true;
    std::vector<bool> dropped(soup.triangles.size());
    RepairDone inner;
    for (std::uint32_t g = 0; g < groups.size(); ++g) {
        const auto [is_free, closes, opens] = has[walls.find(g)];
        if (!closes || opens) continue;
        RepairDone& done = is_free ? flaps : inner;
        for (const FaceIndex face : groups[g]) {
            dropped[face] = true;
            ++done.count;
            done.faces.push_back(soup.origin[face]);
        }
    }
    RepairDone all;
    drop(soup, dropped, all);
    return inner;
}

RepairDone orient_neighbours(RepairSoup& soup, std::vector<bool>& mixed) {
    const EdgeTable edges = edges_of(soup);
    const std::size_t count = soup.triangles.size();
    mixed.assign(count, false);
    std::vector<std::int8_t> turned(count, -1);
    std::vector<FaceIndex> surface;
    RepairDone done;
    for (FaceIndex seed = 0; seed < count; ++seed) {
        if (turned[seed] >= 0) continue;
        surface.assign(1, seed);
        turned[seed] = 0;
        bool orientable = true;
        for (std::size_t i = 0; i < surface.size(); ++i) {
            const FaceIndex face = surface[i];
            for (SideIndex side = 3 * face; side < 3 * face + 3; ++side) {
                if (edges.edge_of_side[side] == no_index) continue;
                const auto sides = edges.sides_of(edges.edge_of_side[side]);
                if (sides.size() != 2) continue;
                const SideIndex other = sides[0] == side ? sides[1] : sides[0];
                const bool agree = runs_upward(soup.triangles, side) != runs_upward(soup.triangles, other);
                const auto wanted = static_cast<std::int8_t>(agree ? turned[face] : 1 - turned[face]);
                std::int8_t& found = turned[other / 3];
                if (found < 0) {
                    found = wanted;
                    surface.push_back(other / 3);
                } else if (found != wanted) {
                    orientable = false;
                }
            }
        }
        std::size_t turns = 0;
        for (const FaceIndex face : surface) turns += turned[face] == 1;
        if (turns == 0 || !orientable) continue;
        const std::int8_t minority = 2 * turns <= surface.size() ? 1 : 0;
        for (const FaceIndex face : surface) {
            mixed[face] = true;
            if (turned[face] != minority) continue;
            std::swap(soup.triangles[face][1], soup.triangles[face][2]);
            ++done.count;
            done.faces.push_back(soup.origin[face]);
        }
    }
    return done;
}

namespace {

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
    const EdgeTable edges = edges_of(soup);
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

RepairDone turn_shells(RepairSoup& soup, const std::vector<bool>& mixed) {
    const Shells found = find_shells(soup.points, soup.triangles, edges_of(soup));
    const std::size_t count = found.shells.size();
    std::vector<bool> unsure(count);  // its facets did not agree, so its own direction says nothing
    for (FaceIndex face = 0; face < soup.triangles.size(); ++face)
        if (found.of_face[face] != no_index && mixed[face]) unsure[found.of_face[face]] = true;
    // From the outside in: a shell lies in fewer others than what lies in it.
    std::vector<std::uint32_t> order(count);
    for (std::uint32_t shell = 0; shell < count; ++shell) order[shell] = shell;
    const auto depth = [&](std::uint32_t shell) { return found.shells[shell].enclosures.size(); };
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return depth(a) < depth(b); });
    std::vector<bool> turned(count);
    for (const std::uint32_t number : order) {
        const Shell& shell = found.shells[number];
        if (!shell.closed || shell.volume6 == 0) continue;
        std::int32_t around = 0;
        std::uint32_t innermost = no_index, enclosing = 0;
        for (const Enclosure& enclosure : shell.enclosures) {
            around += turned[enclosure.shell] ? -enclosure.winding : enclosure.winding;
            enclosing += enclosure.winding % 2 != 0;
            if (innermost == no_index || depth(enclosure.shell) > depth(innermost))
                innermost = enclosure.shell;
        }
        const bool outward = shell.volume6 > 0;
        // Unsure shells alternate, body and cavity; others keep their relation to the shell round them.
        if (unsure[number])
            turned[number] = outward != (enclosing % 2 == 0);
        else if (innermost != no_index)
            turned[number] = turned[innermost];
        if (outward == turned[number] && around <= 0) turned[number] = !turned[number];
    }
    RepairDone done;
    done.count = static_cast<std::uint64_t>(std::count(turned.begin(), turned.end(), true));
    for (FaceIndex face = 0; done.count != 0 && face < soup.triangles.size(); ++face) {
        if (found.of_face[face] == no_index || !turned[found.of_face[face]]) continue;
        std::swap(soup.triangles[face][1], soup.triangles[face][2]);
        done.faces.push_back(soup.origin[face]);
    }
    return done;
}

}  // namespace octavo::mesh
