// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <octavo/octree/octree.hpp>

// The squares between leaves of an octree that count as solid and those that do not.

namespace octavo::classic {

struct BoundarySquare {
    std::array<std::int32_t, 3> low;  ///< lattice point with the least coordinates
    std::int32_t side = 0;
    std::uint8_t axis = 0;  ///< of the normal
    bool faces_up = false;  ///< the outside is at greater coordinates
};

/// Nodes are unfolded to words of 32 bits, of which some are colours.
constexpr std::uint64_t most_unfolded_nodes = 0xFFFFFFF0;

/// `solid` says for each colour whether it counts. Outside the universe nothing does.
/// Errors: limit beyond `most_unfolded_nodes`, which take 16 GB.
Result<std::vector<BoundarySquare>> boundary_squares(const octree::Octree& octree, std::array<bool, 3> solid);

}  // namespace octavo::classic
