// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <octavo/mesh/mesh.hpp>
#include <octavo/mesh/topology.hpp>

// Facets that repeat something: a vertex, or another facet.

namespace octavo::mesh {

/// Such a facet fills nothing and has no edges.
inline bool names_a_vertex_twice(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

/// Of the two directions in which three corners can be run through, whether it is that of ascending numbers.
inline bool is_ascending(const Triangle& t) { return (t[0] < t[1]) + (t[1] < t[2]) + (t[2] < t[0]) == 2; }

/// Facets with the same vertices, either way round, by groups of at least two; each group ascending. `edges` are those
/// of `triangles`. Linear, but for tiny sorts at edges.
std::vector<std::vector<FaceIndex>> groups_of_repeated_facets(std::span<const Triangle> triangles,
                                                              const EdgeTable& edges);

}  // namespace octavo::mesh
