// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <octavo/hexmesh/classify.hpp>

// Larger cells of a mesh beside smaller ones that the boundary cuts off in the middle of a side or an edge.
//
// Where smaller cells of the mesh cover a part of a larger side the rest of it is boundary, but no side of a cell;
// where the boundary runs along half an edge the node in its middle hangs and must still go its own way. A layer of
// cells cannot be laid there, and some formats cannot say it. When those larger cells are split nothing is left like
// that, except where their octants now meet still smaller cells in the same way; balance keeps that from going on for
// long.

namespace octavo::hexmesh {

/// The kept cells, those whose set is not the empty one, that have such a side or edge; sorted. Leaves are balanced.
std::vector<octree::CellKey> cut_off_in_the_middle(const ClassifiedCells& cells);

/// The leaves with all of `cells`, which are leaves, replaced by their octants. Both are sorted.
std::vector<octree::CellKey> split(std::span<const octree::CellKey> leaves,
                                   std::span<const octree::CellKey> cells);

}  // namespace octavo::hexmesh
