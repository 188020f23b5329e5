// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <octavo/mesh/hex_mesh.hpp>

// How much of each cell all solids together fill, from how much each of them does.
//
// Problem: parts of solids that overlap must not be added, those of solids that only touch must.
// Idea: solids overlap where one lies in a cell that another one fills, or where two fill more than the cell. A cell is
// filled as its most filled solids fill it that were not seen to overlap each other anywhere. That is exact where
// solids are disjoint, equal or nested; where they cross it is the part of the larger ones, less than the truth. Only
// overlaps that are nowhere larger than a cell are not seen, and count twice. Cost: one pass over the cells, another
// one over those of several solids.

namespace octavo::mesh {

/// Per cell, 0 to 1. `fractions` as in HexMesh; not empty unless no cell is on a boundary.
std::vector<double> filled_parts(std::span<const SolidSet> sets, std::span<const std::uint16_t> set_of_cell,
                                 std::span<const double> fractions);

}  // namespace octavo::mesh
