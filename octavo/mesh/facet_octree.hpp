// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/mesh/mesh.hpp>

// A descent over lists of facets that ends in cells with few of them: whatever two facets have in common, some
// leaf lists both and holds the place.
//
// Cells are half-open cubes [low, low + side) of real points, with lattice corners. Facets go to octants by
// their boxes, and those that are long and lie askew also by separating axes (T. Akenine-Möller, "Fast 3D
// triangle-box overlap testing", 2001): in integers, except for the facet's plane, whose test is in doubles and
// keeps the facet when in doubt. To list a facet where it is not costs time; where it is it is always listed.
//
// octree::descend is not used here: it delivers leaves in Morton order with a description each and forks by
// octants, while this search wants no output tree, throws cells away in the middle and keeps all lists of a
// path on one stack, which is half of its speed.

namespace octavo::mesh {

struct FacetBox {
    std::array<std::int32_t, 3> low, high;  ///< both included
};

inline FacetBox box_of(const std::array<exact::Point, 3>& p) {
    return {{std::min({p[0].x, p[1].x, p[2].x}), std::min({p[0].y, p[1].y, p[2].y}),
             std::min({p[0].z, p[1].z, p[2].z})},
            {std::max({p[0].x, p[1].x, p[2].x}), std::max({p[0].y, p[1].y, p[2].y}),
             std::max({p[0].z, p[1].z, p[2].z})}};
}

struct FacetCell {
    std::array<std::int32_t, 3> low{};
    std::int32_t side = exact::universe_side;
    int stalled = 0;  ///< levels in which the list hardly became shorter
};

/// A cell with the facets that enter it.
struct FacetList {
    FacetCell cell;
    std::vector<FaceIndex> faces;
};

/// Called with the facets of a leaf, of which the last `fan` share a vertex and do not end inside the cell: what two
/// of those have in common beyond the vertex shows in other leaves.
using LeafVisitor = std::function<void(std::span<const FaceIndex> faces, std::size_t fan)>;

/// Splits the universe until no part has much work; the parts do not depend on the threads. Facets that repeat
/// a vertex are left out.
std::vector<FacetList> split_into_parts(std::span<const exact::Point> points,
                                        std::span<const Triangle> triangles, const Context& context);

/// Descends from the part's cell and visits the leaves.
void for_each_leaf(const FacetList& part, std::span<const exact::Point> points,
                   std::span<const Triangle> triangles, const LeafVisitor& visit);

/// May the facet have a point in the closed cube? Exact but for the plane, which counts as met when rounding
/// leaves it open.
bool may_enter(const std::array<exact::Point, 3>& facet, const std::array<std::int32_t, 3>& low,
               std::int32_t side);

/// Has the segment a point in the closed cube? Exact.
bool enters(exact::Point p, exact::Point q, const std::array<std::int32_t, 3>& low, std::int32_t side);

}  // namespace octavo::mesh
