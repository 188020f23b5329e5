// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <optional>
#include <utility>

#include <octavo/base/counted.hpp>
#include <octavo/base/shared_progress.hpp>
#include <octavo/exact/orient.hpp>
#include <octavo/mesh/collinear.hpp>
#include <octavo/mesh/repeats.hpp>
#include <octavo/mesh/self_intersection.hpp>
#include <octavo/mesh/shells.hpp>
#include <octavo/mesh/snap.hpp>
#include <octavo/mesh/topology.hpp>
#include <octavo/mesh/validate.hpp>
#include <octavo/mesh/weld.hpp>

namespace octavo::mesh {
namespace {

/// A count and the facets behind it, which may be named several times and in any order.
struct Finding {
    std::uint64_t count = 0;
    std::vector<FaceIndex> faces;
};

std::string sentence_of(ProblemKind kind, std::uint64_t n) {
    switch (kind) {
        case ProblemKind::empty:
            return "there is no facet with area";
        case ProblemKind::open_edges:
            return counted(n, "edge has only one facet", "edges have only one facet");
        case ProblemKind::inconsistent_orientation:
            return counted(n, "edge has neighbouring facets that are turned opposite ways",
                           "edges have neighbouring facets that are turned opposite ways");
        case ProblemKind::self_intersections:
            return counted(n, "pair of facets crosses", "pairs of facets cross");
        case ProblemKind::penetrations:
            return counted(n, "pair of facets crosses through edges or vertices",
                           "pairs of facets cross through edges or vertices");
        case ProblemKind::overlaps:
            return counted(n, "pair of facets overlaps in a plane", "pairs of facets overlap in a plane");
        case ProblemKind::inside_out_shells:
            return counted(n, "closed shell is inside out", "closed shells are inside out");
        case ProblemKind::flat_shells:
            return counted(n, "closed shell encloses no volume on the lattice",
                           "closed shells enclose no volume on the lattice");
        case ProblemKind::non_manifold_edges:
            return counted(n, "edge has more than two facets", "edges have more than two facets");
        case ProblemKind::non_manifold_vertices:
            return counted(n, "vertex joins surfaces that only touch there",
                           "vertices join surfaces that only touch there");
        case ProblemKind::duplicate_facets:
            return counted(n, "facet repeats an earlier one", "facets repeat earlier ones");
        case ProblemKind::zero_area_facets:
            return counted(n, "facet has no area", "facets have no area");
        case ProblemKind::touching_facets:
            return counted(n, "pair of facets touches without sharing a vertex or edge there",
                           "pairs of facets touch without sharing a vertex or edge there");
        case ProblemKind::snapped_facets:
            return counted(n, "facet is too thin to keep its area on the lattice",
                           "facets are too thin to keep their area on the lattice");
        case ProblemKind::unused_vertices:
            return counted(n, "vertex is used by no facet", "vertices are used by no facet");
    }
    return {};
}

class Validation {
  public:
    Validation(const Mesh& mesh, const ValidateOptions& options, const Context& context)
        : mesh_(mesh), options_(options), context_(context) {}

    Result<Report> run() {
        report_.facets = mesh_.triangles.size();
        report_.vertices = mesh_.vertices.size();
        const Status prepared = prepare();
        if (!prepared) return prepared.error();
        if (!goes_on(0.05)) return Context::cancelled_error();
        // Shares of the time as measured on scans.
        judge_edges();
        if (!goes_on(0.1)) return Context::cancelled_error();
        judge_vertices();
        if (!goes_on(0.15)) return Context::cancelled_error();
        if (options_.topology_only) {
            conclude();
            return std::move(report_);
        }
        judge_facets();
        if (!goes_on(0.2)) return Context::cancelled_error();
        judge_shells();
        if (!goes_on(0.3)) return Context::cancelled_error();
        if (options_.self_intersections) {
            const Status searched = judge_pairs();
            if (!searched) return searched.error();
        }
        context_.report(phase, 1);
        conclude();
        return std::move(report_);
    }

  private:
    static constexpr std::string_view phase = "check";

    /// Tells how far the work is; false when it should stop.
    bool goes_on(double done) const {
        context_.report(phase, done);
        return !context_.cancelled();
    }
    Status prepare();
    void judge_edges();
    void judge_vertices();
    void judge_facets();
    void judge_shells();
    Status judge_pairs();
    std::vector<FacePair> pairs_that_snapping_makes_one(const std::vector<Triangle>& on_lattice) const;
    void conclude();
    void add(ProblemKind kind, Finding finding);
    void add_pairs(ProblemKind kind, std::span<const FacePair> pairs);

    const Mesh& mesh_;
    const ValidateOptions& options_;
    const Context& context_;
    Report report_;
    std::vector<Triangle> triangles_;   ///< naming merged vertices
    std::vector<VertexIndex> kept_;     ///< a stored vertex for each merged one
    std::vector<exact::Point> points_;  ///< of the merged vertices; equal ones possible
    EdgeTable edges_;
};

Status Validation::prepare() {
    context_.report(phase, 0);
    WeldMap map = equal_vertices(mesh_.vertices);
    report_.merged_vertices = map.kept.size();
    triangles_ = renamed(mesh_.triangles, map);
    kept_ = std::move(map.kept);

    // Vertices of no facet have no say, be they ever so far away.
    const std::vector<bool> used = used_vertices(triangles_, kept_.size());
    Box3 bounds;
    for (VertexIndex vertex = 0; vertex < kept_.size(); ++vertex) {
        if (!used[vertex]) continue;
        const Vec3 position = mesh_.vertices[kept_[vertex]];
        if (!is_finite(position))
            return Error{
                ErrorCode::bad_input, "vertex " + std::to_string(kept_[vertex]) + " is not finite", {}};
        bounds.add(position);
    }
    points_.resize(kept_.size());
    if (bounds.empty() || options_.topology_only) return Done{};
    const Result<exact::Lattice> lattice = exact::Lattice::fit(bounds);
    if (!lattice) return lattice.error();
    for (VertexIndex vertex = 0; vertex < kept_.size(); ++vertex) {
        if (!used[vertex]) continue;
        const Vec3 position = mesh_.vertices[kept_[vertex]];
        points_[vertex] = lattice->snap(position);
        report_.largest_displacement =
            std::max(report_.largest_displacement, length(lattice->to_world(points_[vertex]) - position));
    }
    return Done{};
}

void Validation::judge_edges() {
    edges_ = build_edges(triangles_, kept_.size());
    Finding open, crowded, misoriented;
    for (EdgeIndex edge = 0; edge < edges_.size(); ++edge) {
        const auto sides = edges_.sides_of(edge);
        int balance = 0;
        for (const SideIndex side : sides) balance += runs_upward(triangles_, side) ? 1 : -1;
        if (sides.size() == 2 && balance == 0) continue;
        const auto note = [&](Finding& finding) {
            ++finding.count;
            for (const SideIndex side : sides) finding.faces.push_back(side / 3);
        };
        if (sides.size() == 1) note(open);
        if (sides.size() > 2) note(crowded);
        if (sides.size() > 1 && balance != 0) note(misoriented);
    }
    const auto is_closed = [](const EdgeTable& edges) {
        for (EdgeIndex edge = 0; edge < edges.size(); ++edge)
            if (edges.sides_of(edge).size() != 2) return false;
        return edges.size() > 0;
    };
    report_.closed = edges_.size() > 0 && open.count == 0 && crowded.count == 0;
    report_.oriented = misoriented.count == 0;
    report_.closed_as_stored = kept_.size() == mesh_.vertices.size()
                                   ? report_.closed
                                   : is_closed(build_edges(mesh_.triangles, mesh_.vertices.size()));
    add(ProblemKind::open_edges, std::move(open));
    add(ProblemKind::non_manifold_edges, std::move(crowded));
    add(ProblemKind::inconsistent_orientation, std::move(misoriented));
}

void Validation::judge_vertices() {
    report_.merged_components = components_by_vertex(triangles_, kept_.size()).count;
    report_.components = kept_.size() == mesh_.vertices.size()
                             ? report_.merged_components
                             : components_by_vertex(mesh_.triangles, mesh_.vertices.size()).count;
    const std::vector<SideIndex> fans = fan_of_corner(edges_, triangles_);
    std::vector<SideIndex> fan_of_vertex(kept_.size(), no_index);
    std::vector<bool> touched(kept_.size());
    Finding non_manifold;
    for (SideIndex corner = 0; corner < fans.size(); ++corner) {
        if (edges_.edge_of_side[corner] == no_index) continue;
        const VertexIndex vertex = triangles_[corner / 3][corner % 3];
        if (fan_of_vertex[vertex] == no_index) fan_of_vertex[vertex] = fans[corner];
        if (fan_of_vertex[vertex] == fans[corner] || touched[vertex]) continue;
        touched[vertex] = true;
        ++non_manifold.count;
    }
    for (FaceIndex face = 0; non_manifold.count != 0 && face < triangles_.size(); ++face)
        for (const VertexIndex vertex : triangles_[face])
            if (touched[vertex]) non_manifold.faces.push_back(face);
    report_.manifold = report_.closed && non_manifold.count == 0;
    add(ProblemKind::non_manifold_vertices, std::move(non_manifold));

    const std::vector<bool> used = used_vertices(mesh_.triangles, mesh_.vertices.size());
    add(ProblemKind::unused_vertices,
        {static_cast<std::uint64_t>(std::count(used.begin(), used.end(), false)), {}});
}

void Validation::judge_facets() {
    Finding flat, snapped, duplicate;
    bool area = false;
    for (FaceIndex face = 0; face < triangles_.size(); ++face) {
        const auto [i, j, k] = triangles_[face];
        const bool flat_on_lattice = exact::collinear(points_[i], points_[j], points_[k]);
        area = area || !flat_on_lattice;
        // Rounding can also give area to what has none: rare, but then the file decides.
        if (collinear(mesh_.vertices[kept_[i]], mesh_.vertices[kept_[j]], mesh_.vertices[kept_[k]]))
            ++flat.count, flat.faces.push_back(face);
        else if (flat_on_lattice)
            ++snapped.count, snapped.faces.push_back(face);
    }
    for (const std::vector<FaceIndex>& group : groups_of_repeated_facets(triangles_, edges_)) {
        duplicate.count += group.size() - 1;
        duplicate.faces.insert(duplicate.faces.end(), group.begin() + 1, group.end());
    }
    if (!area) add(ProblemKind::empty, {1, {}});
    add(ProblemKind::zero_area_facets, std::move(flat));
    add(ProblemKind::snapped_facets, std::move(snapped));
    add(ProblemKind::duplicate_facets, std::move(duplicate));
}

void Validation::judge_shells() {
    const Shells shells = find_shells(points_, triangles_, edges_);
    report_.shells = static_cast<std::uint32_t>(shells.shells.size());
    Finding inside_out, flat;
    for (const Shell& shell : shells.shells) {
        inside_out.count += shell.inside_out();
        report_.cavities += shell.cavity();
        report_.nested_bodies += shell.nested_body();
    }
    // Shells of nothing but facets without area are no surface and do no harm.
    std::vector<bool> is_sheet(shells.shells.size());
    for (FaceIndex face = 0; face < triangles_.size(); ++face) {
        const std::uint32_t shell = shells.of_face[face];
        if (shell == no_index) continue;
        if (shells.shells[shell].inside_out() &&
            shells.shells[shell].winding_around() + shells.in_front[face] < 0)
            inside_out.faces.push_back(face);
        if (!shells.shells[shell].flat() || is_sheet[shell]) continue;
        const auto [i, j, k] = triangles_[face];
        is_sheet[shell] = !exact::collinear(points_[i], points_[j], points_[k]);
    }
    flat.count = static_cast<std::uint64_t>(std::count(is_sheet.begin(), is_sheet.end(), true));
    for (FaceIndex face = 0; flat.count != 0 && face < triangles_.size(); ++face)
        if (shells.of_face[face] != no_index && is_sheet[shells.of_face[face]]) flat.faces.push_back(face);
    add(ProblemKind::inside_out_shells, std::move(inside_out));
    add(ProblemKind::flat_shells, std::move(flat));
}

Status Validation::judge_pairs() {
    // Vertices that only meet on the lattice are one there, or their facets would seem to touch.
    const WeldMap map = equal_vertices(points_);
    const bool met = map.kept.size() != points_.size();
    const Context searching = part_of(context_, phase, 0.3, 1);
    std::vector<exact::Point> points;
    for (const VertexIndex vertex : map.kept) points.push_back(points_[vertex]);
    const Result<SelfIntersections> pairs =
        met ? find_self_intersections(points, renamed(triangles_, map), searching)
            : find_self_intersections(points_, triangles_, searching);
    if (!pairs) return pairs.error();
    add_pairs(ProblemKind::self_intersections, pairs->crossing);
    add_pairs(ProblemKind::penetrations, pairs->penetrating);
    std::vector<FacePair> overlapping = pairs->overlapping;
    if (met) {
        const std::vector<FacePair> coincident = pairs_that_snapping_makes_one(renamed(triangles_, map));
        overlapping.insert(overlapping.end(), coincident.begin(), coincident.end());
    }
    add_pairs(ProblemKind::overlaps, overlapping);
    add_pairs(ProblemKind::touching_facets, pairs->touching);
    return Done{};
}

/// Facets with other corners in the file and the same ones on the lattice, each with the first such; `on_lattice` names
/// lattice points.
std::vector<FacePair> Validation::pairs_that_snapping_makes_one(
    const std::vector<Triangle>& on_lattice) const {
    std::vector<FacePair> pairs;
    const EdgeTable edges = build_edges(on_lattice, points_.size());
    for (const std::vector<FaceIndex>& group : groups_of_repeated_facets(on_lattice, edges)) {
        const auto corners_of = [&](FaceIndex face) {
            Triangle corners = triangles_[face];
            std::sort(corners.begin(), corners.end());
            return corners;
        };
        const auto [i, j, k] = triangles_[group[0]];
        if (exact::collinear(points_[i], points_[j], points_[k])) continue;
        for (std::size_t other = 1; other < group.size(); ++other)
            if (corners_of(group[other]) != corners_of(group[0])) pairs.push_back({group[0], group[other]});
    }
    return pairs;
}

void Validation::add_pairs(ProblemKind kind, std::span<const FacePair> pairs) {
    Finding finding;
    finding.count = pairs.size();
    for (const FacePair& pair : pairs) finding.faces.insert(finding.faces.end(), {pair.first, pair.second});
    add(kind, std::move(finding));
}

void Validation::add(ProblemKind kind, Finding finding) {
    if (finding.count == 0) return;
    std::sort(finding.faces.begin(), finding.faces.end());
    finding.faces.erase(std::unique(finding.faces.begin(), finding.faces.end()), finding.faces.end());
    if (finding.faces.size() > options_.most_faces) finding.faces.resize(options_.most_faces);
    report_.problems.push_back(
        {kind, finding.count, std::move(finding.faces), sentence_of(kind, finding.count)});
}

void Validation::conclude() {
    std::sort(report_.problems.begin(), report_.problems.end(),
              [](const Problem& a, const Problem& b) { return a.kind < b.kind; });
    report_.solid =
        !options_.topology_only && (report_.problems.empty() || !is_error(report_.problems.front().kind));
}

}  // namespace

Result<Report> validate(const Mesh& mesh, const ValidateOptions& options, const Context& context) {
    if (const Status numbered = check_sides_can_be_numbered(mesh.triangles.size()); !numbered)
        return numbered.error();
    return Validation(mesh, options, context).run();
}

}  // namespace octavo::mesh
