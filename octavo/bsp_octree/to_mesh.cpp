// SPDX-License-Identifier: Apache-2.0
#include <octavo/base/shared_progress.hpp>
#include <octavo/boolean/assemble.hpp>
#include <octavo/boolean/point_table.hpp>
#include <octavo/boolean/rounding_faults.hpp>
#include <octavo/boolean/surface.hpp>
#include <octavo/bsp_octree/borders.hpp>
#include <octavo/bsp_octree/bounds.hpp>
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

mesh::Moments measure(const BspOctree& octree, const Context& context) {
    OCTAVO_CHECK(!is_unbounded(octree), "a solid without an outer boundary has no measures");
    const Box3 bounds = bounds_of(octree);
    if (bounds.empty()) return {};
    // A node seldom gives more than one fragment, of two triangles. Were there more than this, the last digits would
    // depend on the order of the leaves, which is always the same.
    const mesh::MomentSum none(bounds, 16 * octree.stats().bsp_nodes);
    const auto& origin = octree.lattice().origin();
    const double unit = octree.lattice().unit();
    const auto take = [&](const bsp::FragmentPool& pool, std::span<const bsp::Fragment> fragments,
                          mesh::MomentSum& sum) {
        for (const bsp::Fragment& fragment : fragments) {
            const std::span<const bsp::Corner> ring = pool.corners(fragment);
            const auto corner = [&](std::size_t i) {
                const Vec3 at = pool.approximation(ring[i].vertex);
                return Vec3{(static_cast<double>(origin[0]) + at.x) * unit,
                            (static_cast<double>(origin[1]) + at.y) * unit,
                            (static_cast<double>(origin[2]) + at.z) * unit};
            };
            const Vec3 first = corner(0);
            Vec3 second = corner(1);
            for (std::size_t k = 2; k < ring.size(); ++k) {
                const Vec3 third = corner(k);
                if (fragment.facing.reversed())
                    sum.add(first, third, second);
                else
                    sum.add(first, second, third);
                second = third;
            }
        }
    };
    mesh::MomentSum sum = none;
    for_each_boundary(octree, context, none, take, [&](std::span<const mesh::MomentSum> parts) {
        for (const mesh::MomentSum& part : parts) sum.add(part);
    });
    return sum.moments();
}

}  // namespace octavo::bsp_octree
