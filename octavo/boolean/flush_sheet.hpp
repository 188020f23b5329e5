// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <octavo/boolean/subdivision.hpp>

// Facets that lie on each other within a tolerance, with borders that may be bent, as one set of triangles.
//
// Idea: seen along the dominant axis of their common plane they are polygons; these are subdivided together, with the
// vertices where they are. Two facets share the triangles of the area that they share. What each facet gets is
// checked: its triangles must have the border that the facet had, edge for edge, or the sheet is refused.

namespace octavo::boolean {

/// A facet as its border: the corners and the vertices that its edges were bent through.
struct BentFacet {
    std::uint32_t facet = 0;
    std::vector<std::uint32_t> border;  ///< in the facet's turn
    std::vector<std::uint32_t> inner;   ///< vertices near the facet's inside
};

/// The triangles of each of the facets, turned as it is; `into` has one list a facet. False when the facets cannot be
/// subdivided together: not plane within `flatness` lattice units, folded, or crossing where no vertex is.
bool subdivide_together(std::span<const BentFacet* const> facets, const Soup& soup, double flatness,
                        Subdivision& subdivision, std::span<std::vector<mesh::Triangle>> into);

/// Triangles with the border of the facet, whatever its shape; none where the border takes itself back.
std::vector<mesh::Triangle> fan(const BentFacet& facet);

}  // namespace octavo::boolean
