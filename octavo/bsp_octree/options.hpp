// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <octavo/base/result.hpp>
#include <octavo/bsp/build.hpp>

// How fine a BSP-octree is, and how its trees are built.

namespace octavo::bsp_octree {

/// When a cell is simple enough to be a leaf.
enum class StopRule : std::uint8_t {
    few_planes,    ///< its faces lie in few planes, or in planes through one point in the cell or beside it
    common_point,  ///< its faces lie in planes through one point, in the cell or not, as the source has it
};

struct Options {
    StopRule stop = StopRule::few_planes;
    /// Most planes of a leaf under `few_planes`, 1 to `most_planes`. More make fewer cells and larger trees: measured
    /// in docs/methods/bsp_octree.md.
    std::uint32_t planes = 16;
    /// Cells of this level are leaves, however many faces they have; 0 to 26.
    int depth = 26;
    bsp::BuildOptions tree;

    /// With none, every face would be subdivided to the last level; with very many, a leaf takes quadratic time.
    static constexpr std::uint32_t most_planes = 1000;
};

/// Error: bad_input for options that are out of range.
Status check(const Options& options);

}  // namespace octavo::bsp_octree
