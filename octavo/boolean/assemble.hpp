// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <octavo/base/context.hpp>
#include <octavo/boolean/rounded_points.hpp>
#include <octavo/boolean/surface.hpp>
#include <octavo/mesh/mesh.hpp>

// From the exact boundary to an indexed mesh of doubles that is a manifold.
//
// Problem: the exact solid may touch itself along edges and in vertices (two cubes on an edge). Idea: such edges
// and vertices are doubled, so that every edge of the mesh has two facets and every vertex one fan. At an edge
// with more than two facets, those two belong together that have the solid between them in the exact cyclic order
// about the edge: parts that only touch come apart. Facets joined by edges at a vertex share one copy of it. If
// two pairs at one edge still share both its ends, one of them gets a vertex in the middle.
//
// Each exact point is rounded once (rounded_points.hpp), whatever that does to facets (rounding_faults.hpp).
// Cost: linear; only points where something was cut or touched are looked at closely.

namespace octavo::boolean {

struct Assembled {
    mesh::Mesh mesh;
    std::size_t duplicated_vertices = 0;
    std::size_t split_edges = 0;  ///< doubled edges that needed a vertex of their own
};

/// Appends dangling facets with vertices of their own; they are joined where just two of them run past an edge.
void append_dangling(const Surface& dangling, const Soup& soup, const RoundedPoints& rounded,
                     Assembled& result);

/// Vertices are in the order of the points that they stand for. Cancellation leaves the mesh incomplete.
Assembled assemble(const Surface& surface, const Soup& soup, const PointTable& points,
                   const RoundedPoints& rounded, const std::vector<char>& special, const Context& context);

}  // namespace octavo::boolean
