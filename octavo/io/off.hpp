// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/base/bytes.hpp>
#include <octavo/base/context.hpp>
#include <octavo/io/file_mesh.hpp>
#include <octavo/io/output.hpp>
#include <octavo/io/write.hpp>

// OFF (Geomview manual, "OFF Files"): an optional header word, counts of vertices, faces and edges, then the
// vertices and the faces, each face its number of corners, their indices from 0 and an optional colour. The
// header word says what each vertex carries: [ST][C][N][4][n]OFF for texture coordinates, colour, normal,
// a homogeneous fourth coordinate and a stated dimension; a second word BINARY makes the rest big-endian
// 32-bit numbers. Comments run from # to the end of the line.
//
// What stands behind the coordinates of a vertex and behind the corners of a face, up to the line's end, is
// not geometry and left out, whatever the header word says; so a vertex begins on a line of its own. Read are
// three dimensions, and fourth coordinates of 1.

namespace octavo::io {

Result<FileMesh> read_off(Bytes bytes, const Context& context);

/// Whether `bytes` begin with a header word of OFF.
bool looks_like_off(Bytes bytes);

/// Writes text.
Result<WriteReport> write_off(Output& output, const mesh::Mesh& mesh, const WriteOptions& options);

}  // namespace octavo::io
