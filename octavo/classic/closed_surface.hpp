// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <octavo/base/result.hpp>
#include <octavo/mesh/mesh.hpp>

// Whether triangles bound anything: every edge must be run along equally often in both directions. Then, and only
// then, does each point off the surface have one winding number, whichever way one walks there; crossing surfaces,
// nested shells, coincident facets and edges with many facets are all fine.
//
// The test counts the uses of each edge by vertex index and, only where that fails, once more with vertices that
// lie on one lattice point taken as one (triangle soup, seams). Cost: two passes and a counting sort, O(n).

namespace octavo::classic {

/// What to do with a surface that is not closed.
enum class OpenPolicy : std::uint8_t {
    /// Refuse it, naming facets at open edges.
    reject,
    /// Close it: each connected piece of the boundary gets a fan of facets to one apex, the lattice point nearest to
    /// the mean of its vertices. The solid is that of the closed surface, so winding numbers, bounds and answers are
    /// exact for it; where a hole is large or far from flat the fan is a guess and may cross the surface.
    winding,
};

/// An edge from vertex `from` to vertex `to` that is run along `surplus` times more often in this direction than in
/// the other.
struct OpenEdge {
    mesh::VertexIndex from, to;
    std::int32_t surplus;
    mesh::FaceIndex face;  ///< a facet that uses it
};

/// The open edges of a surface: empty iff it is closed. Vertices at one lattice point count as one and are named by
/// the lowest index.
std::vector<OpenEdge> open_edges(const mesh::LatticeMesh& mesh);

/// The error that says that the surface is open and names some facets at open edges.
Error open_surface_error(const std::vector<OpenEdge>& edges);

/// The mesh with the fans that OpenPolicy::winding describes appended.
mesh::LatticeMesh close_holes(const mesh::LatticeMesh& mesh, const std::vector<OpenEdge>& edges);

}  // namespace octavo::classic
