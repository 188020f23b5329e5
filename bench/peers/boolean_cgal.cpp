// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Surface_mesh.h>
#include <sys/resource.h>

#include "peak_memory.hpp"

// CGAL's corefinement on two OFF files as a line of JSON, for boolean.py: user CPU seconds from arrays in memory to a
// mesh in memory.
//   octavo_boolean_cgal union|intersection|difference A.off B.off RESULT.off

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
namespace pmp = CGAL::Polygon_mesh_processing;

double user_seconds() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_utime.tv_sec) + 1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
}

struct Arrays {
    std::vector<Kernel::Point_3> points;
    std::vector<std::array<unsigned, 3>> triangles;
};

Arrays read(const char* path) {
    std::ifstream in(path);
    std::string word;
    std::size_t points = 0, triangles = 0, edges = 0, corners = 0;
    in >> word >> points >> triangles >> edges;
    Arrays arrays;
    for (double x, y, z; arrays.points.size() < points && in >> x >> y >> z;)
        arrays.points.emplace_back(x, y, z);
    for (std::array<unsigned, 3> t{};
         arrays.triangles.size() < triangles && in >> corners >> t[0] >> t[1] >> t[2];)
        arrays.triangles.push_back(t);
    return arrays;
}

Mesh build(const Arrays& arrays) {
    Mesh mesh;
    for (const auto& point : arrays.points) mesh.add_vertex(point);
    for (const auto& t : arrays.triangles)
        mesh.add_face(Mesh::Vertex_index(t[0]), Mesh::Vertex_index(t[1]), Mesh::Vertex_index(t[2]));
    return mesh;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 5) return 2;
    const Arrays first = read(argv[2]), second = read(argv[3]);
    const octavo::bench::PeakMemory memory;
    const double start = user_seconds();
    Mesh a = build(first), b = build(second), result;
    bool done = false;
    try {
        done = std::strcmp(argv[1], "union") == 0 ? pmp::corefine_and_compute_union(a, b, result)
               : std::strcmp(argv[1], "intersection") == 0
                   ? pmp::corefine_and_compute_intersection(a, b, result)
                   : pmp::corefine_and_compute_difference(a, b, result);
    } catch (const std::exception&) {
        std::printf("{\"error\": \"exception\"}\n");
        return 0;
    }
    const double seconds = user_seconds() - start, peak = memory.megabytes();
    if (!done) {
        std::printf("{\"error\": \"refused\"}\n");
        return 0;
    }
    result.collect_garbage();
    std::ofstream(argv[4]) << result;
    std::printf("{\"cpu\": %.6f, \"peak_mb\": %.1f}\n", seconds, peak);
    return 0;
}
