// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include <octavo/mesh/snap.hpp>
#include <octavo/mesh/topology.hpp>
#include <octavo/mesh/used_vertices.hpp>

namespace octavo::mesh {
namespace {

bool contains(const exact::Lattice& lattice, Vec3 vertex) {
    constexpr std::int32_t last = exact::universe_side - 1;
    const Vec3 low = lattice.to_world({0, 0, 0}), high = lattice.to_world({last, last, last});
    bool inside = true;
    for (int axis = 0; axis < 3; ++axis)
        inside = inside && vertex[axis] >= low[axis] && vertex[axis] <= high[axis];
    return inside;
}

}  // namespace

Result<Snapped> snap(const Mesh& mesh, const exact::Lattice& lattice) {
    const std::vector<bool> used = used_vertices(mesh.triangles, mesh.vertices.size());
    Snapped snapped;
    snapped.mesh.lattice = lattice;
    snapped.mesh.triangles = mesh.triangles;
    snapped.mesh.points.resize(mesh.vertices.size());
    std::optional<exact::Point> corner;
    double largest_displacement = 0;
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        if (!used[i]) continue;
        const Vec3& vertex = mesh.vertices[i];
        if (!contains(lattice, vertex))
            return Error{
                ErrorCode::bad_input,
                "vertex " + std::to_string(i) + " is not finite or lies outside the lattice's universe",
                {}};
        const exact::Point point = lattice.snap(vertex);
        snapped.mesh.points[i] = point;
        if (!corner) corner = point;
        const Vec3 moved = lattice.to_world(point) - vertex;
        if (moved == Vec3{}) continue;
        ++snapped.report.moved_vertices;
        // In units, whose squares are doubles.
        largest_displacement = std::max(largest_displacement, length((1 / lattice.unit()) * moved));
    }
    snapped.report.largest_displacement = largest_displacement * lattice.unit();
    constexpr std::int32_t middle = exact::universe_side / 2;
    for (std::size_t i = 0; i < used.size(); ++i)
        if (!used[i]) snapped.mesh.points[i] = corner.value_or(exact::Point{middle, middle, middle});
    return snapped;
}

Result<Snapped> snap(const Mesh& mesh) {
    if (mesh.triangles.empty()) return snap(mesh, exact::Lattice{});
    Result<exact::Lattice> lattice = exact::Lattice::fit(bounds_of_facets(mesh));
    if (!lattice) return lattice.error();
    return snap(mesh, *lattice);
}

}  // namespace octavo::mesh
