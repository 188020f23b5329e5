// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <vector>

#include <octavo/boolean/flush.hpp>
#include <octavo/boolean/near_contacts.hpp>

// One round of making faces flush (flush.hpp): edges are bent through what is near them and facets to vertices near
// them; facets that lie on each other are subdivided together.
//
// What is bent is told by edges and their vertices, so that all facets at an edge do the same. Facets that must change
// together, for an edge or because they lie on each other, are *linked*; all that are linked change, or none does.
// Exact contacts are left to the arrangement unless something linked to them moves.

namespace octavo::boolean {

/// Per input facet, whether its pieces and what is linked to them stay as they are; none does when it is empty.
using LeftAlone = std::vector<char>;

/// Whether anything was bent.
bool bend(Soup& soup, const NearContacts& near, double tolerance, const LeftAlone& left_alone,
          FlushReport& report, const Context& context);

/// The facets that `bend` would change, and those linked to them, ascending.
std::vector<std::uint32_t> facets_to_bend(Soup& soup, const NearContacts& near, double tolerance,
                                          const LeftAlone& left_alone);

/// Puts the triangles in place of the facets that have a list; those without area are dropped.
void replace_facets(std::map<std::uint32_t, std::vector<mesh::Triangle>> replaced, Soup& soup,
                    FlushReport& report, const Context& context);

double distance(exact::Point a, exact::Point b);

}  // namespace octavo::boolean
