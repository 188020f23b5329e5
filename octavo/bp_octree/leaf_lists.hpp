// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/base/context.hpp>
#include <octavo/bp_octree/bp_octree.hpp>

namespace octavo::bp_octree {

/// Fills leaf_begin and leaf_triangles of a tree whose mesh, frame, nodes and links are there: by sending the
/// triangles down the tree with the exact test that built it. Errors: bad_input when a triangle meets a white or
/// black cell, or a leaf meets none: then tree and triangles do not belong together; limit; cancelled.
Status fill_leaf_lists(BpOctree& tree, const Context& context = {});

}  // namespace octavo::bp_octree
