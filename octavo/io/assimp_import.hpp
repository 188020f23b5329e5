// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <octavo/base/bytes.hpp>
#include <octavo/base/context.hpp>
#include <octavo/io/file_mesh.hpp>
#include <octavo/io/read.hpp>

// Every format without a reader of ours (glTF, Collada, FBX, 3DS, …) through the library assimp. It hands over
// floats whatever the file holds, so the result carries a warning. All meshes of the scene are put where the
// scene's nodes put them, as often as they do, and bit-equal points are welded, because these formats repeat
// points at creases.
//
// Not guaranteed: errors have no line, and a file made to crash assimp may do so; exceptions are caught.

namespace octavo::io {

/// Whether assimp reads files with this extension (lower case, without the dot).
bool assimp_reads(const std::string& extension);

/// Reads a file that may refer to others beside it.
Result<FileMesh> read_by_assimp(const std::string& path, const ReadOptions& options, const Context& context);

/// Reads a file from memory; `extension` says what it is.
Result<FileMesh> read_by_assimp(Bytes bytes, const std::string& extension, const ReadOptions& options,
                                const Context& context);

}  // namespace octavo::io
