// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/base/bytes.hpp>
#include <octavo/base/context.hpp>
#include <octavo/io/file_mesh.hpp>
#include <octavo/io/output.hpp>
#include <octavo/io/write.hpp>

// OBJ (Wavefront, Advanced Visualizer Manual, appendix B1, 1995): lines of a keyword and arguments. Vertices
// `v` and faces `f` are taken, of all objects and groups together; normals, texture coordinates, colours and
// materials are not geometry and are left out. Indices count from 1, or backwards from the last vertex when
// negative. A backslash at the end of a line continues it.

namespace octavo::io {

Result<FileMesh> read_obj(Bytes bytes, const Context& context);

Result<WriteReport> write_obj(Output& output, const mesh::Mesh& mesh, const WriteOptions& options);

}  // namespace octavo::io
