// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/base/bytes.hpp>
#include <octavo/base/context.hpp>
#include <octavo/io/file_mesh.hpp>
#include <octavo/io/output.hpp>
#include <octavo/io/write.hpp>

// PLY (Greg Turk, The PLY Polygon File Format, 1994): a text header that describes elements made of typed
// properties, then the elements as text or binary of either byte order. The best lossless carrier of meshes:
// it holds doubles and indices.
//
// Of the element `vertex` the scalars x, y, z are taken, of `face` the list `vertex_indices` or
// `vertex_index`, of `tristrips` the same list, where -1 restarts a strip; any types, in any order, among any
// others.

namespace octavo::io {

enum class NonFinite : std::uint8_t { refuse, keep };

/// Reads the vertices and faces; a file without faces is fine here (points are files too).
Result<FileMesh> read_ply(Bytes bytes, const Context& context, NonFinite non_finite = NonFinite::refuse);

/// Writes binary little-endian unless text is asked for; float when every coordinate is one, else double.
Result<WriteReport> write_ply(Output& output, const mesh::Mesh& mesh, const WriteOptions& options);

}  // namespace octavo::io
