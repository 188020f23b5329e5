// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>
#include <octavo/io/write.hpp>
#include <octavo/mesh/hex_mesh.hpp>

// MFEM's own mesh files: version 1.1 with the parents of hanging vertices, from which MFEM makes its constraints, or
// version 1.0 when nothing hangs.
//
// MFEM knows a vertex in the middle of an edge by the ends of the edge, and one in the middle of a face by two opposite
// middles of its edges. So a face must be split as a whole: where some quarters of a larger side have a
// neighbour and others are boundary the mesh is refused; keeping the cells outside, or one size on the surface,
// avoids that.
//
// Attributes count from 1: an element's is its material (mesh/materials.hpp) plus one, a boundary element's that of its
// cell. Vertices and elements are in the order of the mesh.

namespace octavo::io {

/// Writes to the file `path`, or to standard output when it is "-".
/// Errors: unsupported (see above, and balance by face); io; cancelled.
Result<WriteReport> write_mfem(const std::string& path, const mesh::HexMesh& mesh,
                               const Context& context = {});

}  // namespace octavo::io
