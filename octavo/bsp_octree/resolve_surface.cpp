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

/// What facets have in common beyond shared edges and vertices.
enum class Contact : std::uint8_t {
    none,
    borders,  ///< points and segments of the border of one of them at least; surfaces may cross along such
    crossing  ///< more
};

/// Of a welded surface. Error: cancelled.
Result<Contact> find_contact(const mesh::LatticeMesh& mesh, const Context& context) {
    std::vector<mesh::Triangle> triangles;  // with area
    for (const mesh::Triangle& t : mesh.triangles)
        if (!exact::collinear(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]))
            triangles.push_back(t);
    if (has_duplicates(triangles)) return Contact::crossing;
    const Result<mesh::SelfIntersections> found =
        mesh::find_self_intersections(mesh.points, triangles, context);
    if (!found) return found.error();
    if (!found->crossing.empty() || !found->penetrating.empty() || !found->overlapping.empty())
        return Contact::crossing;
    return found->touching.empty() ? Contact::none : Contact::borders;
}

/// Whether winding numbers beside the shells are 0 and 1. Facets without area, which close them, do not count.
bool shells_separate(const mesh::LatticeMesh& mesh) {
    const mesh::EdgeTable edges = mesh::build_edges(mesh.triangles, mesh.points.size());
    const mesh::Shells shells = mesh::find_shells(mesh.points, mesh.triangles, edges);
    return std::all_of(shells.shells.begin(), shells.shells.end(),
                       [](const mesh::Shell& shell) { return shell.flat() || shell.separates(); });
}

/// Where the surface winds about; its points are rounded once more by whoever takes them to the lattice.
Result<boolean::Evaluated> unite_with_itself(const mesh::LatticeMesh& mesh, const Context& context) {
    mesh::Mesh surface;
    surface.vertices.reserve(mesh.points.size());
    for (const exact::Point p : mesh.points) surface.vertices.push_back(mesh.lattice.to_world(p));
    surface.triangles = mesh.triangles;
    boolean::Options options;
    options.faults = boolean::Faults::ignored;
    return boolean::unite(std::span(&surface, 1), options, context);
}

/// A surface that separates 0 and 1 gives none.
Result<std::optional<boolean::Evaluated>> resolve_once(const mesh::LatticeMesh& mesh,
                                                       const Context& context) {
    using Resolved = std::optional<boolean::Evaluated>;
    const mesh::LatticeMesh welded = mesh::weld(mesh);
    const Result<Contact> contact = find_contact(welded, context);
    if (!contact) return contact.error();
    if (*contact == Contact::none && shells_separate(welded)) return Resolved{};
    Result<boolean::Evaluated> evaluated = unite_with_itself(welded, context);
    if (!evaluated) return evaluated.error();
    // A facet bounds the union when the winding numbers beside it are 0 and 1.
    if (*contact == Contact::borders && evaluated->report.dropped_facets == 0) return Resolved{};
    return Resolved{std::move(*evaluated)};
}

}  // namespace

Result<bool> separates(const mesh::LatticeMesh& mesh, const Context& context) {
    const Result<std::optional<boolean::Evaluated>> resolved = resolve_once(mesh, context);
    if (!resolved) return resolved.error();
    return !resolved->has_value();
}

Result<std::optional<mesh::LatticeMesh>> resolve(const mesh::LatticeMesh& mesh, const Context& context) {
    std::optional<mesh::LatticeMesh> resolved;
    for (int round = 0; round <= most_rounds; ++round) {
        Result<std::optional<boolean::Evaluated>> next = resolve_once(resolved ? *resolved : mesh, context);
        if (!next) return next.error();
        if (!*next) return resolved;
        Result<mesh::Snapped> snapped = mesh::snap((*next)->mesh, mesh.lattice);
        if (!snapped) return snapped.error();
        resolved = std::move(snapped->mesh);
    }
    return Error{
        ErrorCode::limit, "the surface crosses itself at distances that the lattice cannot tell apart", {}};
}

}  // namespace octavo::bsp_octree
