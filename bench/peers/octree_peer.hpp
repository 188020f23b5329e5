// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "peer_clock.hpp"

// What a peer of the octree comparison is given and gives back. Plain arrays, so that no peer sees the headers of
// another.

namespace octavo::bench {

/// The job: a mesh in the coordinates of its universe, a cube [0, cells)^3 of unit cells.
struct OctreeJob {
    int depth = 9;  ///< 2^depth cells a side
    std::vector<std::array<double, 3>> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    /// Cells that Octavo found to be all inside or all outside, as their lowest corners.
    std::vector<std::array<std::uint32_t, 3>> sample;
};

struct OctreeAnswer {
    std::string system, what;
    Usage usage;               ///< of making the octree or grid with its colours
    double inside_volume = 0;  ///< cells
    std::uint64_t leaves = 0;
    /// For each cell of the sample whether its centre is inside.
    std::vector<bool> inside;
};

OctreeAnswer run_openvdb(const OctreeJob& job);
OctreeAnswer run_cgal(const OctreeJob& job);

}  // namespace octavo::bench
