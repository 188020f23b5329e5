// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <octavo/base/result.hpp>
#include <octavo/hexmesh/classify.hpp>
#include <octavo/hexmesh/options.hpp>

// Which cells on a boundary belong to the mesh when each is to be inside or outside: those at least half filled, by all
// solids together (mesh/filled_parts.hpp).
//
// Taken one by one such cells may touch in a single edge or corner, or face each other across a corner, and no layer
// of cells can be laid on a boundary like that. So Keep::manifold looks at every corner of the boundary: of the
// 256 ways in which its eight octants can be in or out, 104 have a boundary that is a disc there, or none, and no two
// sides that face each other; and where another is found the cell is turned whose part is nearest to a half among those
// that mend it. What then is left is mended by leaving cells out, which ends because there are only so many.

namespace octavo::hexmesh {

struct HalfFilled {
    std::uint64_t added = 0;     ///< cells less than half filled that are kept
    std::uint64_t left_out = 0;  ///< cells at least half filled that are not
};

/// Leaves every cell to the solids that fill half of it; `cells` has fractions. Keep::half or Keep::manifold.
/// Errors: limit beyond 2^16 sets of solids.
Result<HalfFilled> decide_by_half(ClassifiedCells& cells, Keep keep);

}  // namespace octavo::hexmesh
