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

// A descent over lists of facets that ends in cells with few of them: whatever two facets have in common, they are
// visited as a pair in some cell that holds a place of it.
//
// Cells are half-open cubes [low, low + side) of real points, with lattice corners. Facets go to octants by
// their boxes, and those that are long and lie askew also by separating axes (T. Akenine-Möller, "Fast 3D
// triangle-box overlap testing", 2001): in integers, except for the facet's plane, whose test is in doubles and
// keeps the facet when in doubt. To list a facet where it is not costs time; where it is it is always listed.
//
// What makes such searches quadratic are slivers, and three rules keep them from it:
//  * Slivers that run through a cell from end to end would meet again in every small cell along their way. Their pairs
//    are visited at once, in the large cell; below, they are *settled* and visited only with what is fresh.
//  * The n² pairs of a fan round one vertex lie wherever the cell at that vertex is cut. But what two facets with a
//    common vertex have in common beyond it ends on a side opposite to the vertex. In a cell without such a side of
//    either the pair has nothing to show, so the facets of a fan that do not end in the cell are settled there for
//    free.
//  * Splitting costs longer lists and pays in fewer pairs; paths on which it does not pay end.
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
    double waste = 1;  ///< how much longer the lists have become without fewer pairs to show for it
};

/// Pairs of facets that are near each other in a cell: the first `fresh` ones with the rest and, unless they are a
/// fan, among themselves.
struct NearPairs {
    std::span<const FaceIndex> faces;
    std::size_t fresh = 0;
    bool fan = false;
};

using PairVisitor = std::function<void(const FacetCell& cell, const NearPairs& pairs)>;

/// A piece of the search that one thread can do: a cell to descend from, or pairs to visit as they are.
struct PairTask {
    FacetCell cell;
    std::vector<FaceIndex> faces;  ///< as in NearPairs
    std::size_t fresh = 0;
    enum class Kind : std::uint8_t { descend, visit, visit_fan } kind = Kind::descend;
};

/// What is searched.
struct PairSearch {
    std::span<const exact::Point> points;
    std::span<const Triangle> triangles;
    const std::vector<bool>&
        is_hub;  ///< by vertex: has it so many facets that a fan round it is worth looking for?
};

/// Splits the search over the whole universe into pieces, which do not depend on the threads. Facets that repeat a
/// vertex are left out. Cancelled: some pieces are missing.
std::vector<PairTask> make_pair_tasks(const PairSearch& search, const Context& context);

/// Visits the pairs of facets that may meet in the task's cell.
void for_near_pairs(const PairTask& task, const PairSearch& search, const PairVisitor& visit);

/// May the facet have a point in the closed cube? Exact but for the plane, which counts as met when rounding
/// leaves it open.
bool may_enter(const std::array<exact::Point, 3>& facet, const std::array<std::int32_t, 3>& low,
               std::int32_t side);

/// Has the segment a point in the closed cube? Exact.
bool enters(exact::Point p, exact::Point q, const std::array<std::int32_t, 3>& low, std::int32_t side);

}  // namespace octavo::mesh
