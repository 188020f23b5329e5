// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include <octavo/mesh/mesh.hpp>

// Solids without the vertices that no facet uses. Files hold such vertices, which are no part of the solid: neither its
// size, nor the lattice, nor a tolerance may depend on them (which vertices are used: topology.hpp).

namespace octavo::mesh {

/// Contains the corners of all facets; those out of range are left to whoever checks them.
Box3 bounds_of_facets(const Mesh& mesh);
/// Contains the facets of all meshes.
Box3 bounds_of_facets(std::span<const Mesh> meshes);

/// The mesh without the vertices that no facet uses; facets keep their order. Precondition: corners are in range.
Mesh without_unused_vertices(Mesh mesh);

}  // namespace octavo::mesh
