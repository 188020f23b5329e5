// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <span>

#include <octavo/boolean/evaluate.hpp>
#include <octavo/bsp_octree/resolve_surface.hpp>
#include <octavo/exact/orient.hpp>
#include <octavo/mesh/self_intersection.hpp>
#include <octavo/mesh/shells.hpp>
#include <octavo/mesh/snap.hpp>
#include <octavo/mesh/topology.hpp>
#include <octavo/mesh/weld.hpp>

namespace octavo::bsp_octree {
namespace {

/// Rounds of resolving; real meshes need one or two.
constexpr int most_rounds = 6;

/// Facets with the same three corners.
bool has_duplicates(std::vector<mesh::Triangle> triangles) {
    for (mesh::Triangle& t : triangles) std::sort(t.begin(), t.end());
    std::sort(triangles.begin(), triangles.end());
    return std::adjacent_find(triangles.begin(), triangles.end()) != triangles.end();
}

}  // namespace

Result<bool> separates(const mesh::LatticeMesh& mesh, const Context& context) {
    mesh::LatticeMesh welded = mesh::weld(mesh);
    std::erase_if(welded.triangles, [&](const mesh::Triangle& t) {
        return exact::collinear(welded.points[t[0]], welded.points[t[1]], welded.points[t[2]]);
    });
    if (has_duplicates(welded.triangles)) return false;
    const Result<mesh::SelfIntersections> found =
        mesh::find_self_intersections(welded.points, welded.triangles, context);
    if (!found) return found.error();
    if (!found->crossing.empty() || !found->penetrating.empty() || !found->overlapping.empty()) return false;
    const mesh::EdgeTable edges = mesh::build_edges(welded.triangles, welded.points.size());
    const mesh::Shells shells = mesh::find_shells(welded.points, welded.triangles, edges);
    return std::all_of(shells.shells.begin(), shells.shells.end(), [](const mesh::Shell& shell) {
        return shell.winding_around() == (shell.volume6 > 0 ? 0 : 1);
    });
}

Result<std::optional<mesh::LatticeMesh>> resolve(const mesh::LatticeMesh& mesh, const Context& context) {
    std::optional<mesh::LatticeMesh> resolved;
    for (int round = 0; round <= most_rounds; ++round) {
        const mesh::LatticeMesh& at = resolved ? *resolved : mesh;
        const Result<bool> done = separates(at, context);
        if (!done) return done.error();
        if (*done) return resolved;
        mesh::Mesh surface;
        surface.vertices.reserve(at.points.size());
        for (const exact::Point p : at.points) surface.vertices.push_back(at.lattice.to_world(p));
        surface.triangles = at.triangles;
        Result<boolean::Evaluated> evaluated = boolean::unite(std::span(&surface, 1), {}, context);
        if (!evaluated) return evaluated.error();
        Result<mesh::Snapped> snapped = mesh::snap(evaluated->mesh, mesh.lattice);
        if (!snapped) return snapped.error();
        resolved = std::move(snapped->mesh);
    }
    return Error{
        ErrorCode::limit, "the surface crosses itself at distances that the lattice cannot tell apart", {}};
}

}  // namespace octavo::bsp_octree
