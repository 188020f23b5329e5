// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <octavo/boolean/subdivision.hpp>

// Which polygons cover each triangle of a subdivision, when their borders are segments of it: a flood from outside in
// which crossing a border of a polygon enters or leaves it.
//
// Cost: one look at every edge; a copy of the list of polygons only where a border is crossed.

namespace octavo::boolean {

struct Cells {
    std::vector<std::uint32_t> of_triangle;
    std::vector<std::vector<std::uint32_t>> covers;  ///< per cell: the tags of the polygons on it, ascending
};

/// Segments with the tag `no_border` bound nothing. The subdivision must have begun with `begin_round`.
Cells find_cells(const Subdivision& subdivision, std::uint32_t no_border);

}  // namespace octavo::boolean
