// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/base/context.hpp>
#include <octavo/bp_octree/bp_octree.hpp>

namespace octavo::bp_octree {

/// Proves that a tree is what it claims, from its triangles alone: leaves have the triangles that meet them, colours
/// and winding numbers are right, and every plane has all content of its cell on its inner side.
/// For trees from files, which may lie; `build` makes nothing else. Costs a fraction of `build`.
/// Errors: bad_input with a sentence that names the first node that is wrong; cancelled.
Status certify(const BpOctree& tree, const Context& context = {});

}  // namespace octavo::bp_octree
