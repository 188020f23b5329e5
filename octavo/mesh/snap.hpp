// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/base/result.hpp>
#include <octavo/mesh/mesh.hpp>

// From doubles to the lattice: the only rounding of a job's input, and its report.

namespace octavo::mesh {

struct SnapReport {
    double largest_displacement = 0;  ///< in world units
    std::size_t moved_vertices = 0;   ///< vertices that were not already on the lattice
};

struct Snapped {
    LatticeMesh mesh;
    SnapReport report;
};

/// Snaps each vertex to `lattice`; those that no facet uses may be anywhere, and go where a used one is. Vertices keep
/// their indices, even when two meet in one point. Errors: bad_input when a used one is not finite or lies outside the
/// universe.
Result<Snapped> snap(const Mesh& mesh, const exact::Lattice& lattice);

/// Snaps to the finest lattice that contains the facets.
Result<Snapped> snap(const Mesh& mesh);

}  // namespace octavo::mesh
