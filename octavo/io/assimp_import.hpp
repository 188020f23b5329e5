// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

#include <octavo/base/bytes.hpp>
#include <octavo/base/context.hpp>
#include <octavo/io/file_mesh.hpp>
#include <octavo/io/read.hpp>

// Formats of meshes that people have and that have no reader of ours (glTF, Collada, FBX, 3DS, …) through the library
// assimp. It knows some fifty; of those that are left out, scenes and animations of old programs, several crash or hang
// on a few hundred bytes that are none. It hands over floats whatever the file holds, so the result carries a warning.
// All meshes of the scene are put where the scene's nodes put them, as often as they do, and bit-equal points are
// welded, because these formats repeat points at creases.
//
// Not guaranteed: errors have no line, and a file made to crash assimp may do so; exceptions are caught.

namespace octavo::io {

/// The formats, by their extensions: 3ds, amf, …
std::span<const std::string_view> assimp_formats();

/// Whether this extension (lower case, without the dot) is one of them.
bool assimp_reads(const std::string& extension);

/// Reads a file that may refer to others beside it.
Result<FileMesh> read_by_assimp(const std::string& path, const ReadOptions& options, const Context& context);

/// Reads a file from memory; `extension` says what it is.
Result<FileMesh> read_by_assimp(Bytes bytes, const std::string& extension, const ReadOptions& options,
                                const Context& context);

}  // namespace octavo::io
