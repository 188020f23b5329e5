// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdint>
#include <utility>

#include <octavo/exact/orient.hpp>
#include <octavo/exact/plane.hpp>
#include <octavo/mesh/repeats.hpp>
#include <octavo/mesh/self_intersection.hpp>
#include <octavo/mesh/self_overlap.hpp>
#include <octavo/mesh/shells.hpp>
#include <octavo/mesh/topology.hpp>
#include <octavo/mesh/weld.hpp>

namespace octavo::mesh {
namespace {

using exact::Plane;
using exact::Point;

/// The facets without those that cancel each other, and where they came from.
struct DistinctFacets {
    std::vector<Triangle> triangles;
    std::vector<FaceIndex> source;
    std::vector<FaceIndex> doubled;  ///< two on the same corners, facing the same way, that nothing cancels
};

/// Of the facets on the same corners only what is left when those that face each other cancel: one, as a rule, or none.
DistinctFacets cancel_repeated(const std::vector<Triangle>& triangles, const EdgeTable& edges) {
    DistinctFacets distinct;
    std::vector<bool> is_dropped(triangles.size(), false);
    for (const std::vector<FaceIndex>& group : groups_of_repeated_facets(triangles, edges)) {
        std::vector<FaceIndex> up, down;
        for (const FaceIndex face : group) (is_ascending(triangles[face]) ? up : down).push_back(face);
        if (up.size() < down.size()) std::swap(up, down);
        const std::size_t left = up.size() - down.size();
        if (left > 1) distinct.doubled = {up[0], up[1]};
        for (const FaceIndex face : down) is_dropped[face] = true;
        for (std::size_t k = left > 0 ? 1 : 0; k < up.size(); ++k) is_dropped[up[k]] = true;
    }
    for (FaceIndex face = 0; face < triangles.size(); ++face) {
        if (is_dropped[face]) continue;
        distinct.triangles.push_back(triangles[face]);
        distinct.source.push_back(face);
    }
    return distinct;
}

class OverlapSearch {
  public:
    OverlapSearch(const std::vector<Point>& points, const std::vector<Triangle>& triangles)
        : points_(points), triangles_(triangles) {}

    /// The first pair that overlaps, or nothing.
    std::vector<FaceIndex> among(const SelfIntersections& found) const {
        for (const auto* pairs : {&found.crossing, &found.penetrating})
            for (const FacePair& pair : *pairs)
                // What is crossed by facets without area is crossed by their neighbours, too.
                if (!is_flat(pair.first) && !is_flat(pair.second)) return {pair.first, pair.second};
        // Where facets in one plane face both ways, as in a patch that is folded flat, they may cancel each other.
        std::vector<bool> is_opposed(triangles_.size(), false);
        for (const FacePair& pair : found.overlapping)
            if (!face_the_same_way(pair)) is_opposed[pair.first] = is_opposed[pair.second] = true;
        for (const FacePair& pair : found.overlapping)
            if (face_the_same_way(pair) && !is_opposed[pair.first] && !is_opposed[pair.second])
                return {pair.first, pair.second};
        return {};
    }

    /// A facet of the first shell beside which space winds otherwise than once or not at all.
    std::vector<FaceIndex> among(const Shells& shells, const SelfIntersections& found) const {
        std::vector<bool> has_contact(shells.shells.size(), false);
        for (const auto* pairs : {&found.touching, &found.overlapping})
            for (const FacePair& pair : *pairs) {
                const std::uint32_t a = shells.of_face[pair.first], b = shells.of_face[pair.second];
                if (a != b || (a != no_index && shells.shells[a].crowded))
                    for (const std::uint32_t shell : {a, b})
                        if (shell != no_index) has_contact[shell] = true;
            }
        for (FaceIndex face = 0; face < triangles_.size(); ++face) {
            const std::uint32_t number = shells.of_face[face];
            if (number == no_index || has_contact[number]) continue;
            const Shell& shell = shells.shells[number];
            if (!shell.closed || shell.flat()) continue;
            if (!shell.separates()) return {face};
        }
        return {};
    }

  private:
    Plane plane_of(FaceIndex face) const {
        const Triangle& t = triangles_[face];
        return Plane::through(points_[t[0]], points_[t[1]], points_[t[2]]);
    }
    bool is_flat(FaceIndex face) const {
        const Triangle& t = triangles_[face];
        return exact::collinear(points_[t[0]], points_[t[1]], points_[t[2]]);
    }
    /// Their planes are one, so one component that is not zero tells.
    bool face_the_same_way(const FacePair& pair) const {
        const Plane a = plane_of(pair.first), b = plane_of(pair.second);
        if (a.a() != 0) return (a.a() > 0) == (b.a() > 0);
        if (a.b() != 0) return (a.b() > 0) == (b.b() > 0);
        return (a.c() > 0) == (b.c() > 0);
    }

    const std::vector<Point>& points_;
    const std::vector<Triangle>& triangles_;
};

}  // namespace

Result<std::vector<FaceIndex>> find_self_overlap(const LatticeMesh& mesh, const Context& context) {
    if (const Status numbered = check_sides_can_be_numbered(mesh.triangles.size()); !numbered)
        return numbered.error();
    const LatticeMesh welded = weld(mesh);
    EdgeTable edges = build_edges(welded.triangles, welded.points.size());
    const DistinctFacets distinct = cancel_repeated(welded.triangles, edges);
    if (!distinct.doubled.empty()) return distinct.doubled;
    const Result<SelfIntersections> found =
        find_self_intersections(welded.points, distinct.triangles, context);
    if (!found) return found.error();
    const OverlapSearch search(welded.points, distinct.triangles);
    std::vector<FaceIndex> faces = search.among(*found);
    if (faces.empty()) {
        if (distinct.triangles.size() != welded.triangles.size())
            edges = build_edges(distinct.triangles, welded.points.size());
        faces = search.among(find_shells(welded.points, distinct.triangles, edges), *found);
    }
    for (FaceIndex& face : faces) face = distinct.source[face];
    return faces;
}

}  // namespace octavo::mesh
