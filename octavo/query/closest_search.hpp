// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

#include <octavo/query/closest_tree.hpp>
#include <octavo/query/triangle_distance.hpp>

// The walk to the nearest triangle: depth first, nearest child first. It keeps an upper bound of the distance and the
// few triangles that floats cannot exclude, and compares those exactly at the end. Of equally near triangles the one
// with the lowest number is the answer, so it does not depend on the order of the walk.

namespace octavo::query {

struct NearestTriangle {
    mesh::FaceIndex face = TreeLeaf::no_face;
    Corners corners;
    NearestFeature feature;
};

/// `at_most` is no less than the distance, in lattice units, but for 2^-26 of them, which is less than what boxes and
/// leaves are widened by: the nearer, the shorter the walk. The tree is not empty.
NearestTriangle search(const ClosestTree& tree, const FixedPoint& q,
                       float at_most = std::numeric_limits<float>::infinity());

}  // namespace octavo::query
