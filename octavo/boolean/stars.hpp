// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/boolean/corner_table.hpp>
#include <octavo/boolean/soup.hpp>

// The stars of a soup's vertices: the facets about each, and what these make together.
//
// Problem: nearly all pairs of facets whose boxes meet are neighbours at a vertex of a smooth surface, 98 of 100 in a
// scan; to tell each of these pairs apart is most of the search for contacts. Idea: tell them apart all at once. A star
// is *spread* when, seen along an axis, its facets lie beside each other once round the vertex. Then two of them have
// nothing in common but the vertex, or an edge that they share by name.
//
// The axis is the one along which the sum of the normals is longest. Facets lie beside each other there when their
// sides opposite to the vertex make one closed polygon, all of them turn the same way, and one of these sides crosses a
// ray from the vertex: that is once round.
//
// With a reach s, two facets of a spread star that share the vertex only have a plane with both on its two sides, and
// their other corners farther from it than s, as facet_filter.hpp has it. Proof: let c be the least of doubled areas of
// the facets as seen, e and E the least and greatest lengths of edges to the vertex. No facet's angle at the vertex,
// nor what it lacks to half a turn, has a sine below c / E². Two facets that are no neighbours leave a gap on either
// side; a line through the vertex runs in both gaps at an angle of half the smallest of these angles from all four
// edges or more, and so farther than e c / (2 E²) from the corners. That must be √2 s or more, the plane's normal being
// as long as that at most when its coordinates are added up. Cost: about 300 instructions a vertex, with those that
// find fans, which patches.hpp needs as well.

namespace octavo::boolean {

struct Stars {
    CornerTable corners;          ///< of all facets
    std::vector<char> is_fan;     ///< per vertex: one closed fan of facets with equal winding changes
    std::vector<char> is_spread;  ///< per vertex
};

/// Cancellation leaves stars that are said to be neither.
Stars find_stars(const Soup& soup, double reach, const Context& context);

}  // namespace octavo::boolean
