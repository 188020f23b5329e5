// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <octavo/bsp_octree/self_contact.hpp>
#include <octavo/exact/orient.hpp>
#include <octavo/mesh/self_intersection.hpp>
#include <octavo/mesh/shells.hpp>
#include <octavo/mesh/topology.hpp>
#include <octavo/mesh/weld.hpp>

namespace octavo::bsp_octree {
namespace {

/// Facets with the same three corners.
bool has_duplicates(std::vector<mesh::Triangle> triangles) {
    for (mesh::Triangle& t : triangles) std::sort(t.begin(), t.end());
    std::sort(triangles.begin(), triangles.end());
    return std::adjacent_find(triangles.begin(), triangles.end()) != triangles.end();
}

/// Whether facets of a welded surface have more in common than shared edges and vertices. Error: cancelled.
Result<bool> has_contacts(const mesh::LatticeMesh& mesh, const Context& context) {
    std::vector<mesh::Triangle> triangles;  // with area
    for (const mesh::Triangle& t : mesh.triangles)
        if (!exact::collinear(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]))
            triangles.push_back(t);
    if (has_duplicates(triangles)) return true;
    const Result<mesh::SelfIntersections> found =
        mesh::find_self_intersections(mesh.points, triangles, context);
    if (!found) return found.error();
    return !(found->crossing.empty() && found->penetrating.empty() && found->overlapping.empty() &&
             found->touching.empty());
}

/// Whether winding numbers beside the shells are 0 and 1. Facets without area, which close them, do not count.
bool shells_separate(const mesh::LatticeMesh& mesh) {
    const mesh::EdgeTable edges = mesh::build_edges(mesh.triangles, mesh.points.size());
    const mesh::Shells shells = mesh::find_shells(mesh.points, mesh.triangles, edges);
    return std::all_of(shells.shells.begin(), shells.shells.end(),
                       [](const mesh::Shell& shell) { return shell.flat() || shell.separates(); });
}

}  // namespace

Result<bool> may_meet_itself(const mesh::LatticeMesh& mesh, const Context& context) {
    const mesh::LatticeMesh welded = mesh::weld(mesh);
    const Result<bool> contacts = has_contacts(welded, context);
    if (!contacts || *contacts) return contacts;
    return !shells_separate(welded);
}

}  // namespace octavo::bsp_octree
