// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include <octavo/mesh/mesh.hpp>

// Moving and joining meshes.

namespace octavo::mesh {

/// The image of `mesh` under `map`. A map that mirrors (negative determinant) also turns every facet over, so
/// that an outward mesh stays outward.
Mesh transform(const Mesh& mesh, const Affine& map);

/// The mesh with every facet turned over.
Mesh flipped(Mesh mesh);

/// All meshes in one, one after the other; vertices are not welded. Each facet's source is its own when its
/// mesh has sources, else {index of the mesh, index of the facet}.
Mesh join(std::span<const Mesh> meshes);

Affine translation(Vec3 offset);
Affine scaling(Vec3 factors);

/// The rotation by `degrees` about `axis` (need not be of length 1, must not be zero), counter-clockwise seen
/// from the axis' tip. Multiples of 90° about coordinate axes are exact.
Affine rotation(Vec3 axis, double degrees);

}  // namespace octavo::mesh
