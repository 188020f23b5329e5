// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

#include <octavo/io/file_mesh.hpp>
#include <octavo/io/output.hpp>
#include <octavo/io/read.hpp>
#include <octavo/io/write.hpp>

// The mesh formats with readers and writers of our own, and how a file's format is found out.

namespace octavo::io {

struct Format {
    std::string_view name;         ///< also its extension
    std::string_view description;  ///< for people
    bool stores_polygons;          ///< faces may have more than three corners
    Result<FileMesh> (*read)(Bytes, const ReadOptions&, const Context&);
    Result<WriteReport> (*write)(Output&, const mesh::Mesh&, const WriteOptions&);
};

std::span<const Format> mesh_formats();

/// The format of that name in any case, with or without a dot before it; nullptr when it is not ours.
const Format* mesh_format_named(std::string_view name);

/// "stl, obj, …", for messages.
std::string mesh_format_names();

/// The lower-case extension of a path, without the dot; empty when it has none.
std::string extension_of(std::string_view path);

/// The format that the content shows, nullptr when it shows none of ours.
const Format* sniff_mesh_format(Bytes bytes);

}  // namespace octavo::io
