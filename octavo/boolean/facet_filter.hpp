// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

// Which of eight facets may meet a facet: a conservative test in SIMD that throws out nearly all pairs whose boxes
// meet but which have nothing in common but corners.
//
// Idea: two triangles are apart if their projections on some axis are; for triangles it is enough to try the two
// normals, the products of edges and, for those in one plane, the edges' normals in it. The tests come in the order
// of their yield, and each looks only at what the ones before have left: neighbours in a smooth surface go by the first
// plane, slivers of one fan by an edge, slivers of two fans that cross each other by a product of edges.
//
// With a `reach`, facets must be farther apart than that to be thrown out: the same tests find what is nearly in
// contact.
//
// Exactness: coordinates have 26 bits, so differences, products of two and normals (53 bits) are exact doubles. Only
// a product with a third coordinate and its sums round; `margin` bounds that. Nothing is thrown out within it.
// Cost: about 100 instructions for a plane and eight facets; most pairs see nothing else.

namespace octavo::boolean {

/// Eight facets side by side.
struct alignas(32) FacetBlock {
    static constexpr int width = 8;
    std::int32_t point[3][3][width];  ///< corner, axis, lane
    std::uint32_t corner[3][width];   ///< vertex of the soup, with `spread` where that is known of its star
    static constexpr std::uint32_t spread = std::uint32_t{1} << 31;

    bool has_spread_corner(int lane) const {
        return ((corner[0][lane] | corner[1][lane] | corner[2][lane]) & spread) != 0;
    }
};

/// The facets of `others` that share a vertex whose star is spread (stars.hpp) with facet `lane` of `block`: they have
/// no more in common than that, or an edge.
unsigned sharing_spread(const FacetBlock& block, int lane, const FacetBlock& others);

/// The planes of the facets of a block, as doubles: the value of a point is normal · point + offset.
struct alignas(32) FacetPlanes {
    double normal[3][FacetBlock::width];
    double offset[FacetBlock::width];
    double bound[FacetBlock::width];  ///< values that are less than this say nothing

    FacetPlanes() = default;
    explicit FacetPlanes(const FacetBlock& block, double reach = 0);
};

/// Of the facets `candidates` of `others` (bit k is lane k), those that may meet facet `lane` of `block`, or come
/// nearer to it than `reach`, in more than corners and edges that they share. `planes` are those of `block`, for the
/// same reach.
unsigned may_meet(const FacetBlock& block, const FacetPlanes& planes, int lane, const FacetBlock& others,
                  unsigned candidates, double reach = 0);

/// Its two halves: those that the plane of `lane` does not part from it, and those that nothing else does.
unsigned across_plane(const FacetBlock& block, const FacetPlanes& planes, int lane, const FacetBlock& others,
                      unsigned candidates);
unsigned not_parted(const FacetBlock& block, int lane, const FacetBlock& others, unsigned candidates,
                    double reach);

}  // namespace octavo::boolean
