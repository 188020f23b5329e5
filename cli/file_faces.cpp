// SPDX-License-Identifier: Apache-2.0
#include "file_faces.hpp"

#include <algorithm>

namespace octavo::cli {

std::vector<std::uint32_t> faces_of_file(std::vector<std::uint32_t> triangles,
                                         const std::vector<std::uint32_t>& polygon_of_triangle) {
    if (polygon_of_triangle.empty()) return triangles;
    for (std::uint32_t& index : triangles) index = polygon_of_triangle[index];
    std::sort(triangles.begin(), triangles.end());
    triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
    return triangles;
}

mesh::Report with_faces_of_file(mesh::Report report, const io::ReadMesh& read) {
    for (mesh::Problem& problem : report.problems)
        problem.faces = faces_of_file(std::move(problem.faces), read.polygon_of_triangle);
    return report;
}

Error with_faces_of_file(Error error,
                         const std::map<std::string, std::vector<std::uint32_t>>& polygon_of_triangle) {
    if (const auto file = polygon_of_triangle.find(error.place.file); file != polygon_of_triangle.end())
        error.place.faces = faces_of_file(std::move(error.place.faces), file->second);
    return error;
}

}  // namespace octavo::cli
