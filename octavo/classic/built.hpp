// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <octavo/octree/octree.hpp>

// What every builder of a classic octree gives back: the tree and how it came about.

namespace octavo::classic {

/// How a tree was built; for reports, never for decisions.
struct BuildReport {
    /// Tests of one primitive (a triangle, a CSG primitive) against one cell; a test that answers for all eight
    /// octants of a cell counts once.
    std::uint64_t primitive_tests = 0;
    /// The most nodes that existed at one time.
    std::uint64_t peak_nodes = 0;
    /// Input facets without area on the lattice: they bound nothing and were left out.
    std::uint64_t facets_without_area = 0;
    /// Facets that were added to close holes; only with OpenPolicy::winding.
    std::uint64_t closing_facets = 0;
    /// Input facets at open edges, a few of them; only with OpenPolicy::winding.
    std::vector<std::uint32_t> open_facets;
};

struct Built {
    octree::Octree octree;
    BuildReport report;
};

}  // namespace octavo::classic
