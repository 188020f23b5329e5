// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/boolean/box_tree.hpp>
#include <octavo/boolean/turned_frame.hpp>

// The least set of boxes that a long facet may meet: a facet cut to its plane and to the three planes through its
// edges along its dominant axis, tested against eight boxes at once.
//
// A box round a sliver that lies askew holds thousands of facets that the sliver is nowhere near; its four planes say
// so for whole nodes of a tree, and its edges for most of the facets that its plane cuts. Conservative: rounding is
// allowed for as in facet_filter.hpp.
// Cost: about 100 instructions for eight boxes.

namespace octavo::boolean {

class FacetPrism {
  public:
    /// Boxes count as met when they are within `reach`.
    FacetPrism(const FacetBlock& block, int lane, double reach = 0);

    /// For boxes in these coordinates.
    FacetPrism turned(const TurnedFrame& frame) const;

    /// Those of the boxes `candidates` of `node` (bit k is lane k) that the facet may meet.
    unsigned meeting(const BoxNode& node, unsigned candidates) const;
    /// Those of the facets that are not all beyond one edge.
    unsigned meeting(const FacetBlock& others, unsigned candidates) const;

  private:
    struct Plane {
        double normal[3], offset, bound;
    };
    Plane planes_
        [5];  ///< front and back of the facet's plane, then its edges: what is in front of one is apart
};

}  // namespace octavo::boolean
