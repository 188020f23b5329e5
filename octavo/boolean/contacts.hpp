// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include <octavo/boolean/faces.hpp>
#include <octavo/boolean/facet_tree.hpp>
#include <octavo/boolean/point_table.hpp>
#include <octavo/boolean/soup.hpp>

// Where faces of the soup meet, apart from corners and edges that they share by name.
//
// Two faces that are not coplanar meet in a segment or a point. Its ends are corners of one face in the other,
// or points where an edge of one pierces the other; which of them they are follows from orientations of input
// vertices alone (side of a plane, and the volume of edge against edge), so nothing constructed is ever tested.
// Coplanar faces either overlap in an area, then they are arranged together later, or they touch, then corners
// of one lie on the border of the other.
//
// Faces of one operand are tested like any others: self-intersections are cut too.
//
// Invariant (what makes the result conform): for every two faces, all extreme points of their common set are
// named to both. A point where a third face meets them is then a point of all three: either it is extreme in one
// of the common sets, or two segments cross there inside a face, and the arrangement of that face finds it.

namespace octavo::boolean {

/// What a face has in common with a face `other` that is not coplanar: a segment, or a point when both ends are
/// the same.
struct Cut {
    std::uint32_t face = 0, other = 0;
    PointId from = 0, to = 0;
};

/// Two coplanar faces with common area.
struct Overlap {
    std::uint32_t first = 0, second = 0;
};

struct Contacts {
    Faces faces;
    std::vector<Cut> cuts;  ///< each segment twice, once for either face
    std::vector<Overlap> overlaps;
    /// All pairs of facets that the tree's filter let through, those that meet among them.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> near;
};

/// Cancellation leaves the result incomplete.
Contacts find_contacts(const Soup& soup, const FacetTree& tree, PointTable& points, const Context& context);

}  // namespace octavo::boolean
