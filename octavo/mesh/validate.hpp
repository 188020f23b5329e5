// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>
#include <octavo/mesh/report.hpp>

// Does a mesh bound a solid, and if not, why, and where?
//
// Connectivity is judged after merging vertices at bit-equal positions (files like STL have no other), and
// told as stored too where that differs. Geometry is judged on the lattice that the kernel would work on, by
// integer signs. A mesh is a solid when every edge is run along equally often both ways, facets meet only
// where they share vertices and edges, and no shell is inside out. Edges at which four facets meet are allowed:
// two cubes that touch along an edge are a solid, if not a manifold one.
//
// Cost: armadillo (346K facets) 0.3 s on one core.

namespace octavo::mesh {

struct ValidateOptions {
    /// Most facets to list in a problem; counts are always complete.
    std::size_t most_faces = 1000;
    /// Looking for self-intersections is most of the work; without it `solid` cannot tell about them.
    bool self_intersections = true;
    /// Only what needs no lattice: edges, vertices, components. `solid` and all counts that ask for geometry then say
    /// nothing. For meshes that no lattice holds.
    bool topology_only = false;
};

/// Errors: bad_input when a facet's vertex is not finite, limit when the mesh does not fit a lattice or has
/// more than `most_sided_triangles`, cancelled.
/// Precondition: corners name vertices.
Result<Report> validate(const Mesh& mesh, const ValidateOptions& options = {}, const Context& context = {});

}  // namespace octavo::mesh
