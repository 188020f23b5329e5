// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/boolean/near_contacts.hpp>

// Edges at which a surface closes only because vertices lie on them exactly.
//
// Problem: a surface may close as a set of points although its facets do not share edges: the input had T-junctions, or
// a facet a, b, c became a line and was dropped, so that one side has the edge a-c and the other has a-b and b-c. What
// is exact copes with that; but to move b would open the surface. Idea: winding changes cancel edge by edge where
// facets share edges. Where they do not, the edge is split at all vertices that lie on it, which moves nothing. After
// that every part of such an edge has one name only, so the changes cancel there if the surface closes at all.
//
// Cost: a pass over the facets, when any vertex lies on an edge.

namespace octavo::boolean {

/// The edges that must be split, with the vertices on them, as edges that are to be bent through these: `on_edge` only,
/// none of them called exact. `near` are the contacts of the soup.
NearContacts find_t_junctions(const Soup& soup, const NearContacts& near);

}  // namespace octavo::boolean
