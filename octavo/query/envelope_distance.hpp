// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/bp_octree/bp_octree.hpp>
#include <octavo/query/closest.hpp>

// Two cheaper answers than the exact distance, from a BP-octree.
//
// `EnvelopeDistance` bounds the distance from below by the envelopes of one level: what a reader of the first kilobytes
// of a file can tell. A node's bound is the largest of how far the point lies beyond its cell, beyond each of its
// planes, and its parent's bound, so bounds only grow downwards and the node with the least is opened first. Its error:
// the bound is never more than the distance from the solid, 0 within an envelope, and less where an envelope stands off
// the solid or where the nearest point of an envelope lies on an edge of it.
//
// `distance_in_leaf` looks at the triangles of the point's own leaf only, as the thesis's haptic rendering does (F. J.
// Melero, BP-Octree, 2008, section 5.2.2). Its error: the nearest triangle may lie in another leaf; the answer says
// whether that is excluded, and is none in white and black leaves.

namespace octavo::query {

class EnvelopeDistance {
  public:
    /// The tree must outlive this. Levels below the deepest are taken as the deepest.
    EnvelopeDistance(const bp_octree::BpOctree& tree, int level);

    /// World units. NaN for a point with a coordinate that is not a number, infinity for an infinite one.
    double operator()(Vec3 point) const;
    /// The same for many points, parallel. Cancelled: the rest is NaN.
    std::vector<double> operator()(std::span<const Vec3> points, const Context& context = {}) const;

  private:
    struct Open {
        double bound;
        bp_octree::NodeIndex node;
        octree::Cell cell;
    };
    double bound_of(const Open& parent, bp_octree::NodeIndex node, const octree::Cell& cell,
                    Vec3 place) const;

    const bp_octree::BpOctree& tree_;
    int level_;
};

struct LeafDistance {
    double distance = 0;  ///< world units, without a sign
    mesh::FaceIndex triangle = 0;
    bool is_exact = false;  ///< no triangle outside of the leaf can be nearer
};

/// None where the point's leaf has no triangles, outside of the root cell, and for points that are not finite. The tree
/// must have its triangles.
std::optional<LeafDistance> distance_in_leaf(const bp_octree::BpOctree& tree, Vec3 point);

}  // namespace octavo::query
