// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <octavo/mesh/hex_mesh.hpp>

// The cells of a mesh by the solids that they belong to, inside or on the boundary: what a solver calls a material,
// an attribute, a zone or an element set. Overlaps are materials of their own, so a code may give them either's.

namespace octavo::mesh {

struct Materials {
    std::vector<std::vector<SolidIndex>> solids;  ///< of each material, ascending; sorted; each has cells
    std::vector<std::uint32_t> of_set;  ///< per set of the mesh; meaningless for a set without cells

    std::uint32_t of(const HexMesh& mesh, CellIndex cell) const { return of_set[mesh.set_of_cell[cell]]; }
};

Materials materials_of(const HexMesh& mesh);

}  // namespace octavo::mesh
