// SPDX-License-Identifier: Apache-2.0
#include <octavo/base/shared_progress.hpp>
#include <octavo/boolean/assemble.hpp>
#include <octavo/boolean/point_table.hpp>
#include <octavo/boolean/rounding_faults.hpp>
#include <octavo/boolean/surface.hpp>
#include <octavo/bsp_octree/borders.hpp>
#include <octavo/bsp_octree/faces.hpp>
#include <octavo/bsp_octree/fill.hpp>
#include <octavo/bsp_octree/fragment_edges.hpp>
#include <octavo/bsp_octree/to_mesh.hpp>
#include <octavo/mesh/weld.hpp>

namespace octavo::bsp_octree {
namespace {

using boolean::PointId;
using boolean::PointTable;
using boolean::Soup;
using boolean::Surface;

/// The planes of a store as facets of a soup: facet k is the triangle that plane k was made from.
Soup soup_of(const BspOctree& octree) {
    const bsp::PlaneTable& planes = octree.store().planes;
    Soup soup;
    soup.lattice = octree.lattice();
    std::vector<exact::Point> corners;
    corners.reserve(3 * planes.size());
    for (bsp::PlaneId id = 0; id < planes.size(); ++id) {
        corners.insert(corners.end(), planes.points(id).begin(), planes.points(id).end());
        soup.origin.push_back(id);
    }
    const mesh::WeldMap weld = mesh::equal_vertices(corners);
    for (const mesh::VertexIndex kept : weld.kept) soup.points.push_back(corners[kept]);
    for (std::size_t i = 0; i < corners.size(); i += 3)
        soup.facets.push_back({weld.index[i], weld.index[i + 1], weld.index[i + 2]});
    soup.first_triangle = {0, static_cast<std::uint32_t>(planes.size())};
    return soup;
}

bool is_unbounded(const BspOctree& octree) {
    return octree.classify(octree.lattice().to_world({0, 0, 0})) == bsp::Position::in;
}

}  // namespace

Result<ToMesh> to_mesh(const BspOctree& octree, const Context& context) {
    if (is_unbounded(octree)) return Error{ErrorCode::not_a_solid, "the solid has no outer boundary", {}};
    ToMesh result;
    const Soup soup = soup_of(octree);
    PointTable points(soup);
    FragmentEdges found = fragment_edges(octree, points, part_of(context, "faces", 0, 0.4));
    if (context.cancelled()) return Context::cancelled_error();
    result.report.fragments = found.fragments;
    context.report("borders", 0.4);
    const bsp::PlaneTable& planes = octree.store().planes;
    std::vector<Segment> borders;
    const bool closed = sum_borders(found.edges, planes, points, 0, borders, context) ||
                        sum_borders(std::move(found.edges), planes, points, 1, borders, context);
    if (context.cancelled()) return Context::cancelled_error();
    if (!closed) return Error{ErrorCode::not_a_solid, "the faces of the trees do not close to a surface", {}};
    result.report.segments = borders.size();

    context.report("facets", 0.7);
    const Surface surface = fill_borders(borders, planes, points);
    context.report("mesh", 0.9);
    const boolean::RoundedPoints rounded(soup, points);
    boolean::Assembled assembled =
        boolean::assemble(surface, soup, points, rounded, std::vector<char>(points.size(), 1), context);
    if (context.cancelled()) return Context::cancelled_error();
    result.report.largest_rounding = rounded.largest_rounding();
    result.report.inverted_facets = boolean::find_inverted(surface, soup, rounded).size();
    result.report.duplicated_vertices = assembled.duplicated_vertices;
    result.mesh = std::move(assembled.mesh);
    result.mesh.sources.clear();
    return result;
}

mesh::Measures measure(const BspOctree& octree) {
    OCTAVO_CHECK(!is_unbounded(octree), "a solid without an outer boundary has no measures");
    const auto& origin = octree.lattice().origin();
    const double unit = octree.lattice().unit();
    mesh::Mesh soup;
    for_each_boundary(octree, {}, [&](const bsp::FragmentPool& pool, const Fragments& fragments) {
        for (const bsp::Fragment& fragment : fragments) {
            const auto first = static_cast<std::uint32_t>(soup.vertices.size());
            for (const bsp::Corner& corner : pool.corners(fragment)) {
                const Vec3 at = pool.approximation(corner.vertex);
                soup.vertices.push_back({(static_cast<double>(origin[0]) + at.x) * unit,
                                         (static_cast<double>(origin[1]) + at.y) * unit,
                                         (static_cast<double>(origin[2]) + at.z) * unit});
            }
            for (std::uint32_t k = 1; k + 1 < fragment.count; ++k) {
                const std::uint32_t second = first + k, third = second + 1;
                if (fragment.facing.reversed())
                    soup.triangles.push_back({first, third, second});
                else
                    soup.triangles.push_back({first, second, third});
            }
        }
    });
    const mesh::Measures all = mesh::measure(soup);
    mesh::Measures measures;
    measures.volume = all.volume, measures.area = all.area;
    measures.centroid = all.centroid, measures.inertia = all.inertia;
    return measures;
}

}  // namespace octavo::bsp_octree
