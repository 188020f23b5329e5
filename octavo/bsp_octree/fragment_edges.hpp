// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/boolean/point_table.hpp>
#include <octavo/bsp_octree/borders.hpp>
#include <octavo/bsp_octree/bsp_octree.hpp>

// The edges of all fragments of a BSP-octree's boundary, their ends named by value: in the order of the leaves, so ids
// do not depend on threads. A vertex that several fragments of a leaf share is looked up once.

namespace octavo::bsp_octree {

struct FragmentEdges {
    std::vector<BoundedSegment> edges;
    std::size_t fragments = 0;
};

/// Names the ends in `points`. Cancelled, edges are missing. Phase "faces".
FragmentEdges fragment_edges(const BspOctree& octree, boolean::PointTable& points, const Context& context);

}  // namespace octavo::bsp_octree
