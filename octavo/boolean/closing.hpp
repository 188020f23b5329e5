// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <octavo/boolean/soup.hpp>

// What an open operand encloses: its holes are closed by cones.
//
// Sides that no other facet of the operand takes back form cycles; each connected set of them is joined to its lowest
// point by one triangle a side. The cone takes back every side, whatever the holes look like and however facets are
// oriented, so the operand has a winding number everywhere. For a hole with a flat rim it is the rim's polygon;
// otherwise it is one of many surfaces with that rim. Facets without area are left out: what is missing of them
// cancels on their line.
//
// Cost: a sort of the open operands' sides.

namespace octavo::boolean {

struct Closing {
    std::size_t open_sides = 0;
    std::size_t added_facets = 0;
    std::vector<std::uint32_t> operands;  ///< that were open, ascending
};

/// Appends the cones to the soup, whose facets must still carry one turn of their own operand each. A facet of a cone
/// has the origin of a facet at its open side.
Closing close_operands(Soup& soup);

}  // namespace octavo::boolean
