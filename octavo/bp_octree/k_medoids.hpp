// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/base/context.hpp>
#include <octavo/bp_octree/bp_octree.hpp>

// The thesis's choice of planes, as a reference to compare with: bottom up, faces' planes at the leaves, children's
// planes above, thinned by clustering.
//
// A node's candidates are the directions of its faces (leaf) or of its children's planes (split), each displaced
// outwards until all content of the cell is inside. Level 0 keeps at most part · (number of faces) of them, each level
// half as many as the one above, and a node with fewer candidates than that halves its number until some are dropped.
// Which ones: k-medoids on the spherical angles (θ, ρ) of the normals. Source: F. J. Melero, BP-Octree, 2008, sections
// 3.4 and 3.5.
//
// Departures: medoids alternate with assignments (H.-S. Park and C.-H. Jun, 2009) instead of PAM's swaps, from evenly
// spaced starts instead of random ones, so the result is reproducible and large nodes are possible; at least one plane
// is kept where the thesis's rule would fall below one and then, by an oversight, keep all; supports are the certified
// ones; directions are rounded to those that planes may have; and envelopes lie within their parents' like all here.

namespace octavo::bp_octree {

struct KMedoidsOptions {
    double part = 0.01;  ///< of the faces, on level 0; the thesis's k
};

/// Replaces all planes of the tree and the figures of its levels. Errors: cancelled.
Status choose_by_k_medoids(BpOctree& tree, const KMedoidsOptions& options = {}, const Context& context = {});

}  // namespace octavo::bp_octree
