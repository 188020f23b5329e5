// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include <octavo/exact/int128.hpp>
#include <octavo/mesh/mesh.hpp>
#include <octavo/mesh/moments.hpp>

// Volume, area, centroid and inertia of the solid that a mesh bounds (moments.hpp), and its Euler number.
//
// On the lattice the volume is an integer and exact.

namespace octavo::mesh {

struct Measures : Moments {
    Box3 bounds;                        ///< of the vertices that facets use
    std::int64_t used_vertices = 0;     ///< V
    std::int64_t edges = 0;             ///< E, undirected
    std::int64_t euler_number = 0;      ///< V − E + F, F without facets that repeat a vertex
    std::uint32_t components = 0;       ///< joined by shared vertices
    std::optional<std::int64_t> genus;  ///< sum over the components; only of closed manifold meshes
};

/// Volume, area, centroid and inertia alone, in a quarter of the time.
Moments moments(const Mesh& mesh);

/// Measures the mesh as it is stored: vertices are the same only when their indices are (weld first if need
/// be). Precondition: at most `most_sided_triangles`. Linear; about 0.1 µs a facet.
Measures measure(const Mesh& mesh);

/// Six times the signed volume, in cubed lattice units; exact.
exact::int128 exact_volume6(std::span<const exact::Point> points, std::span<const Triangle> triangles);
exact::int128 exact_volume6(const LatticeMesh& mesh);

}  // namespace octavo::mesh
