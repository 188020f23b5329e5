// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <octavo/mesh/mesh.hpp>

// Exact welding: vertices become one only when all their coordinates are equal (−0 equals +0). There is no
// tolerance here or anywhere else: near vertices are different vertices. One pass over an open-addressing
// table; the first of equal vertices stays, so the order of the input is kept.

namespace octavo::mesh {

struct WeldMap {
    std::vector<VertexIndex> index;  ///< new index of each old vertex
    std::vector<VertexIndex> kept;   ///< old index of each new vertex; ascending
};

/// Groups equal positions.
WeldMap equal_vertices(std::span<const Vec3> positions);
WeldMap equal_vertices(std::span<const exact::Point> points);

/// The triangles with their corners renamed by `map`; none is dropped, even where corners meet.
std::vector<Triangle> renamed(std::span<const Triangle> triangles, const WeldMap& map);

/// The mesh without repeated positions; facet i stays facet i.
Mesh weld(const Mesh& mesh);
LatticeMesh weld(const LatticeMesh& mesh);

}  // namespace octavo::mesh
