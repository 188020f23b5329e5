// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <span>
#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>
#include <octavo/mesh/mesh.hpp>

// All pairs of facets of one mesh that meet where they should not; exact on the lattice.
//
// Facets that share a vertex are the bulk of all near pairs, and a broad phase would find each of them again
// and again; they are taken from the vertices' stars instead, each once. The rest, and the stars of vertices with very
// many facets, are found by an octree descent over lists of facets (facet_octree.hpp), which keeps slivers and fans
// from costing n². Pairs are tested box by box, then exactly (facet_pair.hpp).
//
// Cost: armadillo (346K facets) 0.2 s on one core, memory 60 bytes a facet. Results are sorted: they do not
// depend on the number of threads.

namespace octavo::mesh {

struct FacePair {
    FaceIndex first = 0, second = 0;  ///< first < second
    friend auto operator<=>(const FacePair&, const FacePair&) = default;
};

/// Pairs by kind (see facet_pair.hpp), each sorted; a pair is in one list only.
struct SelfIntersections {
    std::vector<FacePair> crossing;
    std::vector<FacePair> penetrating;
    std::vector<FacePair> overlapping;
    std::vector<FacePair> touching;
};

/// Precondition: equal points have equal indices (weld first, or facets at the same place count as touching).
/// Facets that repeat a vertex take no part. Error: cancelled.
Result<SelfIntersections> find_self_intersections(std::span<const exact::Point> points,
                                                  std::span<const Triangle> triangles,
                                                  const Context& context = {});

}  // namespace octavo::mesh
