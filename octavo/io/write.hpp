// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>
#include <octavo/mesh/mesh.hpp>

// Writes triangle meshes: STL, OBJ, PLY, OFF, 3MF, and TetGen's .poly and .smesh. Numbers are written so that they read
// back as the same doubles; only binary STL must round to floats, and says by how much. A mesh without facets is a
// legal result and makes a legal empty file.

namespace octavo::io {

enum class Encoding : std::uint8_t {
    automatic,  ///< binary where the format has it
    binary,
    ascii,
};

struct WriteOptions {
    /// Name of the format ("stl", "obj", "ply", "off", "3mf", "poly", "smesh"); empty takes it from the file's
    /// extension.
    std::string format;
    Encoding encoding = Encoding::automatic;
    /// Unit of length to state where the format can (3MF): "micron", "millimeter", "centimeter", "inch",
    /// "foot" or "meter". The coordinates are written as they are.
    std::string unit = "millimeter";
};

struct WriteReport {
    std::string format;
    std::size_t bytes = 0;
    /// The largest distance that rounding to the format's numbers moved a coordinate; 0 when it is lossless.
    double largest_displacement = 0;
    std::vector<std::string> warnings;
};

/// Writes `mesh` to the file `path`, or to standard output when it is "-" (then `options.format` must say
/// what). The file appears whole or not at all. Fails with ErrorCode::unsupported for an unknown format (the
/// sentence lists the known ones), limit for coordinates that the format cannot hold or that are not finite,
/// and io when the system refuses.
Result<WriteReport> write_mesh(const std::string& path, const mesh::Mesh& mesh,
                               const WriteOptions& options = {}, const Context& context = {});

/// A file in memory.
struct WrittenBytes {
    std::vector<std::byte> bytes;
    WriteReport report;
};

/// The same into memory; `options.format` says what.
Result<WrittenBytes> write_mesh(const mesh::Mesh& mesh, const WriteOptions& options,
                                const Context& context = {});

}  // namespace octavo::io
