// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <octavo/mesh/mesh.hpp>

// Shells of a result that are thinner than a tolerance: what flush.hpp cannot see, because it only comes about where
// facets cut each other (an edge that should run through the line in which two others cross leaves a sliver beside it).
//
// A shell goes whole, so nothing can open or cross. It is thin when the space in it, by its area, is less than half the
// tolerance on average; a plate has two sides.
// Cost: linear.

namespace octavo::boolean {

struct ThinShells {
    std::size_t shells = 0;
    std::vector<std::uint32_t> number;  ///< per triangle, what it is now; no_index when it has gone
};

/// `tolerance` in the mesh's units, above 0; vertices of dropped shells go too.
ThinShells drop_thin_shells(mesh::Mesh& mesh, double tolerance);

}  // namespace octavo::boolean
