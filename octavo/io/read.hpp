// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <octavo/base/bytes.hpp>
#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>
#include <octavo/mesh/mesh.hpp>

// Reads meshes: STL, OBJ, PLY, OFF, 3MF and TetGen's .poly and .smesh by readers of our own, which take every decimal
// to the nearest double and name the line or byte of what is wrong; some others (assimp_import.hpp) through assimp,
// which delivers floats. Vertices and faces come in the order of the file. Nothing is repaired, and nothing is merged
// except the bit-equal corners of formats that store loose triangles (STL, and those of assimp).

namespace octavo::io {

struct ReadOptions {
    /// Name of the format ("stl", "obj", "ply", "off", "3mf", "poly", "smesh", or one of assimp_import.hpp); empty
    /// takes it from the file's extension, and from the content when that says nothing.
    std::string format;
    /// Where bytes in memory come from, for formats that keep a part of a mesh in a file beside (.poly and .smesh their
    /// points). Reading a file sets it.
    std::string path = "";
    /// A compressed or instanced file may not grow beyond this many triangles, nor beyond as many vertices (a small 3MF
    /// can claim any number); more is ErrorCode::limit. The default needs about 7 GB.
    std::uint64_t max_triangles = 200'000'000;
};

/// A mesh and what the file says about it.
struct ReadMesh {
    mesh::Mesh mesh;
    std::string format;                 ///< name of the format that was read
    std::vector<std::string> warnings;  ///< remarks on what was ignored or changed, one sentence each
    std::vector<std::string>
        beside;                      ///< files beside the one named that were read too: the points of a .poly
    std::uint64_t polygons = 0;      ///< faces in the file
    std::uint64_t triangulated = 0;  ///< of them, those with more than three corners
    /// The face of the file that each triangle is of; empty when triangle i is face i.
    std::vector<std::uint32_t> polygon_of_triangle;
    std::string unit;                 ///< unit of length, when the file states one; coordinates are as stored
    double millimetres_per_unit = 0;  ///< 0 when it does not
    /// Kinds of data that the file holds and a mesh does not: "normals", "materials", "groups", … Who only asks about
    /// the shape misses nothing; who writes it again loses them.
    std::vector<std::string> left_behind;
};

/// Polygons as the file has them, for formats that carry them (OBJ, PLY, OFF; POLY and SMESH, which alone have holes);
/// triangles otherwise.
struct ReadPolygons {
    mesh::PolygonMesh mesh;
    std::string format;
    std::vector<std::string> warnings;
};

/// Reads the file `path`, or standard input when it is "-". Fails with ErrorCode::bad_input and a Place when
/// the file is not what it claims to be or has vertices and no facets (without either it is an empty solid, with a
/// warning), unsupported for what Octavo does not read, limit for more vertices or facets than 32-bit indices number,
/// and io when the system refuses.
Result<ReadMesh> read_mesh(const std::string& path, const ReadOptions& options = {},
                           const Context& context = {});

/// The same from memory; `options.format` may be empty, then the content decides.
Result<ReadMesh> read_mesh(Bytes bytes, const ReadOptions& options = {}, const Context& context = {});

Result<ReadPolygons> read_polygons(const std::string& path, const ReadOptions& options = {},
                                   const Context& context = {});
Result<ReadPolygons> read_polygons(Bytes bytes, const ReadOptions& options = {}, const Context& context = {});

}  // namespace octavo::io
