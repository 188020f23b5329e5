// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/base/bytes.hpp>
#include <octavo/base/context.hpp>
#include <octavo/io/file_mesh.hpp>
#include <octavo/io/output.hpp>
#include <octavo/io/write.hpp>

// STL (3D Systems, StereoLithography Interface Specification, 1989): facets as loose triangles, as text or as
// 50 bytes each after an 80-byte header and a count, little-endian. Corners that are equal bit for bit are
// welded; the normals and the two attribute bytes are ignored, because nobody keeps them right.
//
// The header of a binary file may begin with "solid" as text does, so the size decides first: a file of
// 84 + 50 n bytes with n where the count stands is binary.

namespace octavo::io {

/// Reads either kind. Text may hold several solids; they become one mesh.
Result<FileMesh> read_stl(Bytes bytes, const Context& context);

/// Writes floats (binary) or shortest doubles (text). Fails when a coordinate is too large for a float.
Result<WriteReport> write_stl(Output& output, const mesh::Mesh& mesh, const WriteOptions& options);

}  // namespace octavo::io
