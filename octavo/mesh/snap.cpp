// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <octavo/mesh/snap.hpp>

namespace octavo::mesh {

Result<Snapped> snap(const Mesh& mesh, const exact::Lattice& lattice) {
    const Vec3 low = lattice.to_world({0, 0, 0});
    const exact::Point last{exact::universe_side - 1, exact::universe_side - 1, exact::universe_side - 1};
    const Vec3 high = lattice.to_world(last);
    Snapped snapped;
    snapped.mesh.lattice = lattice;
    snapped.mesh.triangles = mesh.triangles;
    snapped.mesh.points.reserve(mesh.vertices.size());
    for (const Vec3& vertex : mesh.vertices) {
        bool inside = true;
        for (int axis = 0; axis < 3; ++axis)
            inside = inside && vertex[axis] >= low[axis] && vertex[axis] <= high[axis];
        if (!inside)
            return Error{ErrorCode::bad_input,
                         "vertex " + std::to_string(snapped.mesh.points.size()) +
                             " is not finite or lies outside the lattice's universe",
                         {}};
        const exact::Point point = lattice.snap(vertex);
        snapped.mesh.points.push_back(point);
        const Vec3 moved = lattice.to_world(point) - vertex;
        if (moved == Vec3{}) continue;
        ++snapped.report.moved_vertices;
        snapped.report.largest_displacement = std::max(snapped.report.largest_displacement, length(moved));
    }
    return snapped;
}

Result<Snapped> snap(const Mesh& mesh) {
    if (mesh.vertices.empty()) return Snapped{};
    Result<exact::Lattice> lattice = exact::Lattice::fit(mesh.bounds());
    if (!lattice) return lattice.error();
    return snap(mesh, *lattice);
}

}  // namespace octavo::mesh
