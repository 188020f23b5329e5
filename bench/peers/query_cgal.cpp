// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>

#include "query_peer.hpp"

// CGAL with exact predicates: Side_of_triangle_mesh and the closest point of an AABB tree.

namespace octavo::bench {

std::vector<QueryAnswer> run_cgal_queries(const QueryJob& job) {
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;
    using Traits = CGAL::AABB_traits<Kernel, CGAL::AABB_face_graph_triangle_primitive<SurfaceMesh>>;
    const Stopwatch watch;
    SurfaceMesh mesh;
    std::vector<SurfaceMesh::Vertex_index> vertices;
    for (const auto& v : job.vertices) vertices.push_back(mesh.add_vertex({v[0], v[1], v[2]}));
    for (const auto& t : job.triangles)
        if (mesh.add_face(vertices[t[0]], vertices[t[1]], vertices[t[2]]) == SurfaceMesh::null_face())
            return {};
    CGAL::AABB_tree<Traits> tree(faces(mesh).first, faces(mesh).second, mesh);
    tree.accelerate_distance_queries();
    const CGAL::Side_of_triangle_mesh<SurfaceMesh, Kernel> side(tree);
    const Usage build = watch.stop();
    const std::size_t count = std::min(job.points.size(), job.slow_points);
    const auto point = [&](std::size_t i) {
        return Kernel::Point_3(job.points[i][0], job.points[i][1], job.points[i][2]);
    };
    QueryAnswer inside{"CGAL side of mesh", build, 0, std::vector<std::int8_t>(count), {}};
    inside.nanoseconds = time_a_point(job.runs, count, [&] {
        for (std::size_t i = 0; i < count; ++i) {
            const CGAL::Bounded_side answer = side(point(i));
            inside.inside[i] = answer == CGAL::ON_BOUNDED_SIDE ? -1 : answer == CGAL::ON_BOUNDARY ? 0 : 1;
        }
    });
    QueryAnswer distance{"CGAL closest point", build, 0, {}, std::vector<double>(count)};
    distance.nanoseconds = time_a_point(job.runs, count, [&] {
        for (std::size_t i = 0; i < count; ++i)
            distance.distance[i] = std::sqrt(tree.squared_distance(point(i)));
    });
    return {inside, distance};
}

}  // namespace octavo::bench
