// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <numeric>

#include <octavo/base/counted.hpp>
#include <octavo/mesh/repair.hpp>
#include <octavo/mesh/repair_steps.hpp>
#include <octavo/mesh/topology.hpp>
#include <octavo/mesh/weld.hpp>

namespace octavo::mesh {
namespace {

struct Wording {
    const char* name;
    const char* one;
    const char* many;
};

constexpr std::array<Wording, 11> wordings{{
    {"merged_vertices", "vertex was merged with another at the same place",
     "vertices were merged with others at the same place"},
    {"dropped_collapsed_facets", "facet that named a vertex twice was dropped",
     "facets that named a vertex twice were dropped"},
    {"dropped_duplicate_facets", "facet that repeated another was dropped",
     "facets that repeated others were dropped"},
    {"dropped_inner_walls", "facet of a wall without thickness inside the solid was dropped",
     "facets of walls without thickness inside the solid were dropped"},
    {"dropped_flaps", "facet of a flap without thickness was dropped",
     "facets of flaps without thickness were dropped"},
    {"flipped_edges", "facet without area was resolved by flipping its long side",
     "facets without area were resolved by flipping their long sides"},
    {"turned_facets", "facet was turned over to agree with its neighbours",
     "facets were turned over to agree with their neighbours"},
    {"separated_edges", "edge with more than two facets was separated",
     "edges with more than two facets were separated"},
    {"separated_vertices", "vertex was doubled where surfaces only touch",
     "vertices were doubled where surfaces only touch"},
    {"turned_shells", "shell that was inside out was turned over",
     "shells that were inside out were turned over"},
    {"dropped_vertices", "vertex that no facet used was dropped", "vertices that no facet used were dropped"},
}};

const Wording& wording_of(RepairKind kind) { return wordings[static_cast<std::size_t>(kind)]; }

void note(RepairReport& report, RepairKind kind, RepairDone done) {
    if (done.count == 0) return;
    std::sort(done.faces.begin(), done.faces.end());
    done.faces.erase(std::unique(done.faces.begin(), done.faces.end()), done.faces.end());
    const Wording& wording = wording_of(kind);
    report.steps.push_back(
        {kind, done.count, std::move(done.faces), counted(done.count, wording.one, wording.many)});
}

/// The lattice position of every used vertex.
Status snap_used(RepairSoup& soup) {
    const std::vector<bool> used = used_vertices(soup.triangles, soup.vertices.size());
    Box3 bounds;
    for (std::size_t vertex = 0; vertex < soup.vertices.size(); ++vertex) {
        if (!used[vertex]) continue;
        if (!is_finite(soup.vertices[vertex]))
            return Error{ErrorCode::bad_input, "a vertex of a facet is not finite", {}};
        bounds.add(soup.vertices[vertex]);
    }
    soup.points.resize(soup.vertices.size());
    if (bounds.empty()) return Done{};
    const Result<exact::Lattice> lattice = exact::Lattice::fit(bounds);
    if (!lattice) return lattice.error();
    for (std::size_t vertex = 0; vertex < soup.vertices.size(); ++vertex)
        if (used[vertex]) soup.points[vertex] = lattice->snap(soup.vertices[vertex]);
    return Done{};
}

std::uint64_t drop_unused_vertices(RepairSoup& soup) {
    const std::vector<bool> used = used_vertices(soup.triangles, soup.vertices.size());
    std::vector<VertexIndex> index(soup.vertices.size());
    std::vector<Vec3> kept;
    for (std::size_t vertex = 0; vertex < index.size(); ++vertex) {
        index[vertex] = static_cast<VertexIndex>(kept.size());
        if (used[vertex]) kept.push_back(soup.vertices[vertex]);
    }
    for (Triangle& t : soup.triangles)
        for (VertexIndex& vertex : t) vertex = index[vertex];
    const std::uint64_t dropped = soup.vertices.size() - kept.size();
    soup.vertices = std::move(kept);
    return dropped;
}

/// What was done, by kind.
using DoneByKind = std::array<RepairDone, wordings.size()>;

/// Drops what repeats and flips what has no area, until neither is left to do; false when there was nothing.
bool simplify(RepairSoup& soup, DoneByKind& done) {
    const auto note = [&](RepairKind kind, const RepairDone& more) {
        done[static_cast<std::size_t>(kind)].add(more);
        return more.count > 0;
    };
    for (bool any = false;; any = true) {
        bool now = note(RepairKind::dropped_duplicate_facets, drop_duplicate_facets(soup));
        const DroppedWalls walls = drop_walls(soup);
        now |= note(RepairKind::dropped_inner_walls, walls.inner);
        now |= note(RepairKind::dropped_flaps, walls.flaps);
        now |= note(RepairKind::flipped_edges, flip_needles(soup));
        if (!now) return any;
    }
}

}  // namespace

std::string_view name_of(RepairKind kind) { return wording_of(kind).name; }

std::string RepairReport::describe() const {
    if (steps.empty()) return "Nothing was to be repaired.\n";
    std::string text;
    for (const RepairStep& step : steps) text += step.sentence + ".\n";
    return text;
}

Result<Repaired> repair(const Mesh& mesh, const Context& context) {
    if (const Status numbered = check_sides_can_be_numbered(mesh.triangles.size()); !numbered)
        return numbered.error();
    RepairSoup soup;
    {
        Mesh welded = weld(mesh);
        // Vertices that an earlier repair has doubled are merged here and doubled again below, to the same mesh.
        soup.vertices = std::move(welded.vertices);
        soup.triangles = std::move(welded.triangles);
        soup.origin.resize(soup.triangles.size());
        std::iota(soup.origin.begin(), soup.origin.end(), FaceIndex{0});
    }
    const auto goes_on = [&](double done) {
        context.report("repair", done);
        return !context.cancelled();
    };
    DoneByKind done;
    const auto of = [&](RepairKind kind) -> RepairDone& { return done[static_cast<std::size_t>(kind)]; };
    of(RepairKind::merged_vertices).count = mesh.vertices.size() - soup.vertices.size();
    if (!goes_on(0.1)) return Context::cancelled_error();
    const Status snapped = snap_used(soup);
    if (!snapped) return snapped.error();
    of(RepairKind::dropped_collapsed_facets) = drop_collapsed_facets(soup);
    if (!goes_on(0.2)) return Context::cancelled_error();

    // What is turned may face what it faced away from, and cancel it; what is dropped may let facets be turned; and
    // where shells cross themselves one that has been turned may look otherwise than before. Mostly there is one round,
    // and two where something was turned.
    constexpr int most_turns_in_a_row = 16;
    for (int turns_in_a_row = 0;;) {
        if (simplify(soup, done)) turns_in_a_row = 0;
        if (!goes_on(0.5)) return Context::cancelled_error();
        std::vector<bool> mixed;
        const RepairDone facets = orient_neighbours(soup, mixed);
        if (!goes_on(0.6)) return Context::cancelled_error();
        const RepairDone shells = turn_shells(soup, mixed);
        if (!goes_on(0.7)) return Context::cancelled_error();
        of(RepairKind::turned_facets).add(facets);
        of(RepairKind::turned_shells).add(shells);
        if (facets.count + shells.count == 0 || ++turns_in_a_row == most_turns_in_a_row) break;
    }
    of(RepairKind::separated_edges) = separate_edges(soup, of(RepairKind::separated_vertices));
    if (!goes_on(1)) return Context::cancelled_error();
    of(RepairKind::dropped_vertices).count = drop_unused_vertices(soup);

    Repaired result;
    for (std::size_t kind = 0; kind < done.size(); ++kind)
        note(result.report, static_cast<RepairKind>(kind), std::move(done[kind]));
    for (const FaceIndex face : soup.origin)
        result.mesh.sources.push_back(mesh.sources.empty() ? Source{0, face} : mesh.sources[face]);
    result.mesh.vertices = std::move(soup.vertices);
    result.mesh.triangles = std::move(soup.triangles);
    return result;
}

}  // namespace octavo::mesh
