// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include <octavo/mesh/mesh.hpp>

// Vertices that some facet uses. Files hold others, which are no part of the solid: how large it is, and so the size of
// the cells and the lattice, must not depend on them.

namespace octavo::hexmesh {

/// Contains all vertices of facets; those with indices out of range are left to whoever checks them.
Box3 bounds_of_facets(std::span<const mesh::Mesh> solids);

/// The mesh with each unused vertex moved to one that is used, so that all keep their numbers; nothing when all are used.
std::optional<mesh::Mesh> with_unused_vertices_moved(const mesh::Mesh& solid);

}  // namespace octavo::hexmesh
