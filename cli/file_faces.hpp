// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <octavo/io/read.hpp>
#include <octavo/mesh/report.hpp>

// The faces of a file, which may be polygons, in place of the triangles that they were cut into: the library numbers
// triangles, and who looks for what is wrong looks into the file.

namespace octavo::cli {

/// The faces, ascending, each once, that these triangles are of; the triangles themselves when `polygon_of_triangle`
/// is empty.
std::vector<std::uint32_t> faces_of_file(std::vector<std::uint32_t> triangles,
                                         const std::vector<std::uint32_t>& polygon_of_triangle);

mesh::Report with_faces_of_file(mesh::Report report, const io::ReadMesh& read);

/// `polygon_of_triangle` by file.
Error with_faces_of_file(Error error,
                         const std::map<std::string, std::vector<std::uint32_t>>& polygon_of_triangle);

}  // namespace octavo::cli
