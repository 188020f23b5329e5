// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include <octavo/base/vec3.hpp>
#include <octavo/bp_octree/bpo_reader.hpp>

// The part of a stored tree that a view needs: fine where the eye is, coarse elsewhere, nothing read for what is out of
// sight.
//
// The tree is walked level by level, and whoever looks decides for each split node whether its octants are wanted, by
// its place and size; so a level costs one request for each run of chunks side by side. Nodes that are not split
// further stand for all below them by their envelopes, so whatever is decided, the result contains the solid.

namespace octavo::bp_octree {

/// Whether the octants of this cell, whose box in the world is given, are wanted.
using Refine = std::function<bool(const octree::Cell& cell, const Box3& box)>;

/// The tree down to where `refine` says no, without triangles; nodes that were not refined are gray leaves without
/// triangles, and their winding numbers are 0. `levels` are the figures of this tree. Errors: bad_input, io.
Result<BpOctree> read_view(BpoReader& reader, const Refine& refine);

}  // namespace octavo::bp_octree
