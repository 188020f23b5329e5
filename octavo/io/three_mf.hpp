// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/base/bytes.hpp>
#include <octavo/base/context.hpp>
#include <octavo/io/file_mesh.hpp>
#include <octavo/io/output.hpp>
#include <octavo/io/read.hpp>
#include <octavo/io/write.hpp>

// 3MF (3MF Consortium, 3D Manufacturing Format Core Specification 1.3, and the Production Extension 1.1): a ZIP
// archive with XML in it. Objects are meshes or made of components, which are other objects moved by a
// transform; the build lists the objects that are the model. Everything the build lists becomes one mesh, in
// its order, in the file's unit.
//
// Support structures, materials, colours, slices and pictures are left out. A file that says that an extension
// is required which changes the shape (beam lattices, volumes) is refused.

namespace octavo::io {

/// Reads a file; instancing stops at `options.max_triangles`, unpacking at 200 times the size of the file.
Result<FileMesh> read_three_mf(Bytes bytes, const ReadOptions& options, const Context& context);

/// Writes one object. Fails with ErrorCode::unsupported when `options.unit` is none of 3MF's.
Result<WriteReport> write_three_mf(Output& output, const mesh::Mesh& mesh, const WriteOptions& options);

}  // namespace octavo::io
