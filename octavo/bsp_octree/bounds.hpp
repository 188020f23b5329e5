// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/base/vec3.hpp>
#include <octavo/bsp_octree/bsp_octree.hpp>

namespace octavo::bsp_octree {

/// A box of the world that holds the solid, less than two lattice units larger than it must be; empty for the empty
/// solid. One without an outer boundary has the whole universe. Cost: a look at each leaf, and at the faces of few.
Box3 bounds_of(const BspOctree& solid);

}  // namespace octavo::bsp_octree
