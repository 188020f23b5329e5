// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>
#include <octavo/io/write.hpp>
#include <octavo/mesh/hex_mesh.hpp>

// A mesh of hexahedra as an unstructured grid (.vtu), for ParaView. For looking, not for solving: the format knows no
// constraints, so a solver that reads it finds cracks at hanging nodes.
//
// Cell data: `set` (number of the set of solids), `solid` (the first of them, −1 outside), `fraction` (the part of
// the cell in its solids, when it was computed), `level` (of an octree's cells), and what the caller adds. Point data:
// `masters` (2 or 4 for hanging nodes, else 0).

namespace octavo::io {

/// A number for each cell.
struct CellData {
    std::string name;
    std::span<const double> values;
};

/// Writes the file `path`, or standard output when it is "-".
Result<WriteReport> write_vtu(const std::string& path, const mesh::HexMesh& mesh,
                              std::span<const CellData> more = {}, const Context& context = {});

}  // namespace octavo::io
