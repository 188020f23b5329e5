// SPDX-License-Identifier: Apache-2.0
#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Octree.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>

#include "octree_peer.hpp"

// CGAL's octree holds points only, so the split predicate asks an AABB tree whether the mesh meets the cell, and each
// leaf that it does not meet is coloured by Side_of_triangle_mesh at its centre. The two corners of the universe are
// the octree's points: they make its root that cube.

namespace octavo::bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using SurfaceMesh = CGAL::Surface_mesh<Point>;
using Primitive = CGAL::AABB_face_graph_triangle_primitive<SurfaceMesh>;
using AabbTree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;
using Points = std::vector<Point>;
using CgalOctree = CGAL::Octree<Kernel, Points>;

SurfaceMesh surface_of(const OctreeJob& job) {
    SurfaceMesh mesh;
    std::vector<SurfaceMesh::Vertex_index> vertices;
    for (const auto& v : job.vertices) vertices.push_back(mesh.add_vertex(Point(v[0], v[1], v[2])));
    for (const auto& t : job.triangles) mesh.add_face(vertices[t[0]], vertices[t[1]], vertices[t[2]]);
    return mesh;
}

}  // namespace

OctreeAnswer run_cgal(const OctreeJob& job) {
    const SurfaceMesh mesh = surface_of(job);
    const double side = static_cast<double>(std::uint64_t{1} << job.depth);
    OctreeAnswer answer;
    answer.system = "CGAL " CGAL_STR(CGAL_VERSION);
    answer.what = "Octree + AABB_tree + Side_of_triangle_mesh";
    const Stopwatch watch;
    AabbTree tree(faces(mesh).begin(), faces(mesh).end(), mesh);
    tree.build();
    Points corners{Point(0, 0, 0), Point(side, side, side)};
    CgalOctree octree(corners, CGAL::Identity_property_map<Point>(), 1.0);
    const std::size_t depth = static_cast<std::size_t>(job.depth);
    octree.refine([&](const CgalOctree::Node& node) {
        return node.depth() < depth && tree.do_intersect(octree.bbox(node));
    });
    const CGAL::Side_of_triangle_mesh<SurfaceMesh, Kernel> side_of(mesh);
    double black_volume = 0;
    for (const CgalOctree::Node node : octree.traverse<CGAL::Orthtrees::Leaves_traversal>()) {
        ++answer.leaves;
        const CGAL::Bbox_3 box = octree.bbox(node);
        if (node.depth() == depth && tree.do_intersect(box)) continue;
        const Point centre((box.xmin() + box.xmax()) / 2, (box.ymin() + box.ymax()) / 2,
                           (box.zmin() + box.zmax()) / 2);
        if (side_of(centre) == CGAL::ON_BOUNDED_SIDE) black_volume += std::pow(box.xmax() - box.xmin(), 3);
    }
    answer.usage = watch.stop();
    answer.inside_volume = black_volume;
    for (const auto& cell : job.sample)
        answer.inside.push_back(side_of(Point(cell[0] + 0.5, cell[1] + 0.5, cell[2] + 0.5)) ==
                                CGAL::ON_BOUNDED_SIDE);
    return answer;
}

}  // namespace octavo::bench
