// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <octavo/io/read.hpp>
#include <octavo/mesh/report.hpp>

// The faces of a file, which may be polygons, in place of the triangles that they were cut into: the library numbers
// triangles, and who looks for what is wrong looks into the file.

namespace octavo::cli {

/// The faces, ascending, each once, that these triangles of `read` are of.
std::vector<std::uint32_t> faces_of_file(std::vector<std::uint32_t> triangles, const io::ReadMesh& read);

mesh::Report with_faces_of_file(mesh::Report report, const io::ReadMesh& read);
Error with_faces_of_file(Error error, const io::ReadMesh& read);

}  // namespace octavo::cli
