// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <octavo/base/context.hpp>
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
// Each exact point is rounded once, here; what rounding does to facets is measured and reported.
// Cost: linear; only points where something was cut or touched are looked at closely.

namespace octavo::boolean {

struct Assembled {
    mesh::Mesh mesh;
    double largest_rounding = 0;  ///< how far rounding may have moved a constructed vertex, in world units
    std::size_t inverted_facets = 0;            ///< turned over or made flat by rounding
    std::vector<std::uint32_t> first_inverted;  ///< up to 8 of them
    std::size_t duplicated_vertices = 0;
    std::size_t split_edges = 0;  ///< doubled edges that needed a vertex of their own
};

Assembled assemble(const Surface& surface, const Soup& soup, const PointTable& points,
                   const std::vector<char>& special, const Context& context);

}  // namespace octavo::boolean
