// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>
#include <octavo/hexmesh/classify.hpp>
#include <octavo/hexmesh/options.hpp>
#include <octavo/hexmesh/size_field.hpp>

// Surfaces that lie in the walls between cells, as faces of a part on the grid do.
//
// Such a surface passes through no cell, so that the descent sees no reason to split: a cube on the grid would be one
// cell, whatever size its surface asks for. But it is in the sets of the cells: a solid that one cell lies in and the
// cell across the wall does not has its surface in that wall. So cells that lie there are split until they are small
// enough; octants of a cell that no surface passes through inherit its set, and no facet is looked at again. Only walls
// in planes that hold a facet are looked at, and only when cells larger than asked for can have a wall there: a scan
// has none, and costs one look at each facet. Not seen: the rest of a face of which a surface crosses the cell on the
// other side; that cell is small, and balance keeps the one beside it within twice its size. Cost: where there are such
// planes one pass over all cells for each level that they have to go down.

namespace octavo::hexmesh {

struct RefinedAtWalls {
    std::vector<octree::CellKey> keys;   ///< sorted; they fill the universe
    std::vector<octree::CellKey> cells;  ///< those of the mesh with a surface in a wall; sorted
};

/// Splits `cells` of the mesh, as Options::keep has it, at surfaces in their walls as those must be that the same
/// surface passes through. A boundary cell of another solid may be among those split. Errors: limit beyond
/// Options::max_cells; cancelled.
Result<RefinedAtWalls> refine_at_walls(const ClassifiedCells& cells, std::span<const SolidFacets> solids,
                                       const SizeField& sizes, const Options& options,
                                       const Context& context);

}  // namespace octavo::hexmesh
