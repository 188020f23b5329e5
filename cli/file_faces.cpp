// SPDX-License-Identifier: Apache-2.0
#include "file_faces.hpp"

#include <algorithm>

namespace octavo::cli {

std::vector<std::uint32_t> faces_of_file(std::vector<std::uint32_t> triangles, const io::ReadMesh& read) {
    if (read.polygon_of_triangle.empty()) return triangles;
    for (std::uint32_t& index : triangles) index = read.polygon_of_triangle[index];
    std::sort(triangles.begin(), triangles.end());
    triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
    return triangles;
}

mesh::Report with_faces_of_file(mesh::Report report, const io::ReadMesh& read) {
    for (mesh::Problem& problem : report.problems)
        problem.faces = faces_of_file(std::move(problem.faces), read);
    return report;
}

Error with_faces_of_file(Error error, const io::ReadMesh& read) {
    error.place.faces = faces_of_file(std::move(error.place.faces), read);
    return error;
}

}  // namespace octavo::cli
