// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <octavo/base/check.hpp>
#include <octavo/base/grouped.hpp>
#include <octavo/mesh/disjoint_sets.hpp>
#include <octavo/mesh/topology.hpp>

namespace octavo::mesh {
namespace {

bool repeats_a_vertex(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

/// The sides in the order (low vertex, high vertex, side): `keys` holds high << 32 | side, and those of low
/// vertex v are [begin[v], begin[v + 1]).
struct SortedSides {
    std::vector<std::uint64_t> keys;
    std::vector<std::uint32_t> begin;
};

SortedSides sort_sides(std::span<const Triangle> triangles, std::size_t vertex_count) {
    SortedSides sorted;
    // begin[v + 2] counts first; after the prefix sum begin[v + 1] is where v's next side goes, and when all
    // have gone there begin[v + 1] is the end of v.
    sorted.begin.assign(vertex_count + 2, 0);
    const auto for_each_side = [&](const auto& visit) {
        for (std::size_t face = 0; face < triangles.size(); ++face) {
            const Triangle& t = triangles[face];
            if (repeats_a_vertex(t)) continue;
            for (std::size_t k = 0; k < 3; ++k) {
                const VertexIndex from = t[k], to = t[k == 2 ? 0 : k + 1];
                visit(std::min(from, to), std::max(from, to), static_cast<SideIndex>(3 * face + k));
            }
        }
    };
    for_each_side([&](VertexIndex low, VertexIndex, SideIndex) { ++sorted.begin[low + 2]; });
    for (std::size_t v = 2; v < sorted.begin.size(); ++v) sorted.begin[v] += sorted.begin[v - 1];
    sorted.keys.resize(sorted.begin.back());
    for_each_side([&](VertexIndex low, VertexIndex high, SideIndex side) {
        sorted.keys[sorted.begin[low + 1]++] = static_cast<std::uint64_t>(high) << 32 | side;
    });
    sorted.begin.pop_back();
    for (std::size_t v = 0; v < vertex_count; ++v)
        std::sort(sorted.keys.begin() + sorted.begin[v], sorted.keys.begin() + sorted.begin[v + 1]);
    return sorted;
}

Components number_labels(DisjointSets& sets, std::span<const std::uint32_t> member_of_face) {
    Components components;
    components.of_face.reserve(member_of_face.size());
    std::vector<std::uint32_t> number;
    for (const std::uint32_t member : member_of_face) {
        const std::uint32_t root = sets.find(member);
        if (root >= number.size()) number.resize(root + std::size_t{1}, no_index);
        if (number[root] == no_index) number[root] = components.count++;
        components.of_face.push_back(number[root]);
    }
    return components;
}

/// Facets are together when they share an edge that has at most so many.
Components components_by_edges_of(const EdgeTable& edges, std::size_t face_count, std::size_t most_facets) {
    DisjointSets sets(face_count);
    for (EdgeIndex edge = 0; edge < edges.size(); ++edge) {
        const auto sides = edges.sides_of(edge);
        for (std::size_t i = 1; i < sides.size() && sides.size() <= most_facets; ++i)
            sets.unite(sides[0] / 3, sides[i] / 3);
    }
    std::vector<std::uint32_t> member(face_count);
    for (std::uint32_t face = 0; face < face_count; ++face) member[face] = face;
    return number_labels(sets, member);
}

}  // namespace

Status check_sides_can_be_numbered(std::size_t triangles) {
    if (triangles <= most_sided_triangles) return Done{};
    return Error{ErrorCode::limit,
                 "the mesh has " + grouped(triangles) + " facets, more than " +
                     grouped(most_sided_triangles) + ", whose sides 32 bits can number",
                 {}};
}

EdgeTable build_edges(std::span<const Triangle> triangles, std::size_t vertex_count) {
    OCTAVO_CHECK(triangles.size() <= most_sided_triangles,
                 "the mesh has more facets than sides can be numbered");
    const SortedSides sorted = sort_sides(triangles, vertex_count);
    EdgeTable table;
    table.edge_of_side.assign(3 * triangles.size(), no_index);
    table.sides.reserve(sorted.keys.size());
    table.ends.reserve(sorted.keys.size() / 2);
    table.sides_begin.reserve(sorted.keys.size() / 2 + 1);
    for (std::size_t low = 0; low < vertex_count; ++low) {
        std::uint64_t previous = ~std::uint64_t{0};
        for (std::uint32_t i = sorted.begin[low]; i < sorted.begin[low + 1]; ++i) {
            const std::uint64_t high = sorted.keys[i] >> 32;
            const auto side = static_cast<SideIndex>(sorted.keys[i]);
            if (high != previous) {
                table.ends.push_back({static_cast<VertexIndex>(low), static_cast<VertexIndex>(high)});
                table.sides_begin.push_back(static_cast<std::uint32_t>(table.sides.size()));
                previous = high;
            }
            table.edge_of_side[side] = static_cast<EdgeIndex>(table.ends.size() - 1);
            table.sides.push_back(side);
        }
    }
    table.sides_begin.push_back(static_cast<std::uint32_t>(table.sides.size()));
    return table;
}

Components components_by_vertex(std::span<const Triangle> triangles, std::size_t vertex_count) {
    DisjointSets sets(vertex_count);
    std::vector<std::uint32_t> member;
    member.reserve(triangles.size());
    for (const Triangle& t : triangles) {
        sets.unite(t[0], t[1]);
        sets.unite(t[1], t[2]);
        member.push_back(t[0]);
    }
    return number_labels(sets, member);
}

Components components_by_edge(const EdgeTable& edges, std::size_t face_count) {
    return components_by_edges_of(edges, face_count, no_index);
}

Components components_by_plain_edge(const EdgeTable& edges, std::size_t face_count) {
    return components_by_edges_of(edges, face_count, 2);
}

std::vector<SideIndex> fan_of_corner(const EdgeTable& edges, std::span<const Triangle> triangles) {
    // Each edge joins, at either of its ends, the corners of its facets: a side starts at the corner of its
    // own number and ends at the next one, and runs up or down the edge.
    const auto corner_at_low = [&](SideIndex side) {
        return runs_upward(triangles, side) ? side : next_side(side);
    };
    const auto corner_at_high = [&](SideIndex side) {
        return runs_upward(triangles, side) ? next_side(side) : side;
    };
    DisjointSets corners(3 * triangles.size());
    for (EdgeIndex edge = 0; edge < edges.size(); ++edge) {
        const auto sides = edges.sides_of(edge);
        for (std::size_t i = 1; i < sides.size(); ++i) {
            corners.unite(corner_at_low(sides[0]), corner_at_low(sides[i]));
            corners.unite(corner_at_high(sides[0]), corner_at_high(sides[i]));
        }
    }
    std::vector<SideIndex> fans(3 * triangles.size());
    for (SideIndex corner = 0; corner < fans.size(); ++corner) fans[corner] = corners.find(corner);
    return fans;
}

std::vector<bool> used_vertices(std::span<const Triangle> triangles, std::size_t vertex_count) {
    std::vector<bool> used(vertex_count);
    for (const Triangle& t : triangles)
        for (const VertexIndex vertex : t)
            if (vertex < vertex_count) used[vertex] = true;
    return used;
}

}  // namespace octavo::mesh
