// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <octavo/base/result.hpp>
#include <octavo/mesh/mesh.hpp>

// Who is next to whom: edges with their incident facets, components, and the fans of facets round a vertex.
//
// No half-edge pointers: a *side* is the number 3 · facet + k, the edge that runs from corner k of the facet
// to corner k + 1; a *corner* has the same number as the side that starts there. Any triangle soup has edges
// in this sense, with one, two or more sides each. Building is one counting sort by the smaller vertex and
// tiny sorts inside its bucket: linear, and two passes over memory.
//
// Facets that name a vertex twice have no edges (they fill nothing and cannot open a surface).

namespace octavo::mesh {

using SideIndex = std::uint32_t;  ///< 3 · facet + k; also the corner that the side starts from
using EdgeIndex = std::uint32_t;
inline constexpr std::uint32_t no_index = ~std::uint32_t{0};

/// The next corner of the same facet.
inline SideIndex next_side(SideIndex side) { return side % 3 == 2 ? side - 2 : side + 1; }

/// The undirected edges of a triangle soup, sorted by (low vertex, high vertex).
struct EdgeTable {
    std::vector<std::array<VertexIndex, 2>> ends;  ///< {low, high} per edge, low < high
    std::vector<std::uint32_t> sides_begin;        ///< per edge, and one past the last
    std::vector<SideIndex> sides;                  ///< by edge, ascending inside an edge
    std::vector<EdgeIndex> edge_of_side;           ///< no_index for the sides of facets that repeat a vertex

    std::size_t size() const { return ends.size(); }
    std::span<const SideIndex> sides_of(EdgeIndex edge) const {
        return {sides.data() + sides_begin[edge], sides_begin[edge + 1] - sides_begin[edge]};
    }
};

/// Sides are numbered by 32 bits, and one number is none.
inline constexpr std::size_t most_sided_triangles = no_index / 3 - 1;

/// Whether the sides of so many triangles can be numbered. Errors: limit.
Status check_sides_can_be_numbered(std::size_t triangles);

/// Precondition: at most `most_sided_triangles`, whose corners are smaller than `vertex_count`.
EdgeTable build_edges(std::span<const Triangle> triangles, std::size_t vertex_count);

/// Does the side run from the lower to the higher vertex?
inline bool runs_upward(std::span<const Triangle> triangles, SideIndex side) {
    const Triangle& t = triangles[side / 3];
    return t[side % 3] < t[next_side(side) % 3];
}

/// A label 0, 1, 2 … per facet, numbered in the order of first appearance.
struct Components {
    std::vector<std::uint32_t> of_face;
    std::uint32_t count = 0;
};

/// Facets are together when they share a vertex.
Components components_by_vertex(std::span<const Triangle> triangles, std::size_t vertex_count);

/// Facets are together when they share an edge.
Components components_by_edge(const EdgeTable& edges, std::size_t face_count);

/// Facets are together when they share an edge that no third facet has: the patches of a surface.
Components components_by_plain_edge(const EdgeTable& edges, std::size_t face_count);

/// For each corner, the smallest corner of its fan: the corners at one vertex whose facets are joined, one to
/// the next, by edges at that vertex. A vertex of a surface has one fan; where surfaces only touch it has
/// more.
std::vector<SideIndex> fan_of_corner(const EdgeTable& edges, std::span<const Triangle> triangles);

/// For each vertex, whether a facet uses it; corners out of range are passed over.
std::vector<bool> used_vertices(std::span<const Triangle> triangles, std::size_t vertex_count);

}  // namespace octavo::mesh
