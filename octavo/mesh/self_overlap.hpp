// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>
#include <octavo/mesh/mesh.hpp>

// Whether a closed surface winds about every point once or not at all: then it bounds a solid as it stands, and volumes
// count everything once.
//
// Idea: winding numbers change at facets alone. Where facets cross, the four spaces between them have three winding
// numbers, and where facets in one plane face the same way, those on either side differ by two; so one is neither 0 nor
// 1. Where nothing of the kind happens each shell bounds a space by itself, and has the right winding number inside
// when it is a body that no other shell encloses, or a cavity in one. Facets that touch, or face each other in one
// plane, are contact and allowed; facets on the same corners count with their directions first. Not seen: shells within
// each other that have contact as well, or hang together at edges and have more contact, and overlaps in a plane where
// others of its facets cancel some. Cost: that of find_self_intersections; shells add a tenth.

namespace octavo::mesh {

/// A few facets at the first place that is found where the surface overlaps itself or is inside out, in no order; empty
/// when there is none. Open parts of a surface are searched for crossings only. Precondition: corners name points.
/// Errors: limit; cancelled.
Result<std::vector<FaceIndex>> find_self_overlap(const LatticeMesh& mesh, const Context& context = {});

}  // namespace octavo::mesh
