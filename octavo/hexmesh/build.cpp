// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>

#include <octavo/hexmesh/build.hpp>
#include <octavo/hexmesh/classify.hpp>
#include <octavo/hexmesh/covered_sides.hpp>
#include <octavo/hexmesh/half_filled.hpp>
#include <octavo/hexmesh/number.hpp>
#include <octavo/hexmesh/walls.hpp>
#include <octavo/mesh/measure.hpp>
#include <octavo/mesh/self_overlap.hpp>
#include <octavo/mesh/snap.hpp>
#include <octavo/mesh/used_vertices.hpp>

namespace octavo::hexmesh {
namespace {

using octree::CellKey;

struct Prepared {
    exact::Lattice lattice;
    Box3 content;
    std::vector<SolidFacets> facets;
    std::vector<SolidReport> reports;
    bool overlaps = false;  ///< a solid overlaps itself
};

Error of_solid(Error error, std::size_t solid, std::size_t count) {
    if (count > 1) error.place.operand = static_cast<std::uint32_t>(solid);
    return error;
}

/// Says where the first open edge runs: with the facets alone a small hole is hard to find.
Error open_error(const mesh::LatticeMesh& mesh, const std::vector<classic::OpenEdge>& open) {
    Error error = classic::open_surface_error(open);
    std::array<char, 160> place;
    const Vec3 from = mesh.lattice.to_world(mesh.points[open[0].from]),
               to = mesh.lattice.to_world(mesh.points[open[0].to]);
    std::snprintf(place.data(), place.size(),
                  "; the first runs from (%.9g, %.9g, %.9g) to (%.9g, %.9g, %.9g)", from.x, from.y, from.z,
                  to.x, to.y, to.z);
    error.sentence += place.data();
    return error;
}

Error inside_out_error(std::vector<std::uint32_t> facets) {
    Error error{ErrorCode::not_a_solid,
                "the surface is inside out: its volume is negative, since its facets run clockwise seen from "
                "outside; "
                "repair turns such shells over",
                {}};
    error.place.faces = std::move(facets);
    std::sort(error.place.faces.begin(), error.place.faces.end());
    return error;
}

Error overlap_error(std::vector<std::uint32_t> facets, const SolidReport& solid) {
    if (solid.exact_volume < 0) return inside_out_error(std::move(facets));
    Error error{ErrorCode::not_a_solid,
                "the surface overlaps itself, or a part of it is inside out: winding numbers other than 0 "
                "and 1 occur; "
                "a union of the solid resolves overlaps",
                {}};
    error.place.faces = std::move(facets);
    std::sort(error.place.faces.begin(), error.place.faces.end());
    return error;
}

/// Closes or refuses what is open, and refuses what encloses nothing.
Result<SolidFacets> closed_facets(const mesh::LatticeMesh& surface, classic::OpenPolicy policy,
                                  SolidReport& report) {
    Result<std::vector<classic::Facet>> facets = classic::facets_of(surface);
    if (!facets) return facets.error();
    const std::vector<classic::OpenEdge> open = classic::open_edges(surface);
    std::optional<mesh::LatticeMesh> closed;
    if (!open.empty()) {
        if (policy == classic::OpenPolicy::reject) return open_error(surface, open);
        report.open_facets = classic::open_surface_error(open).place.faces;
        closed = classic::close_holes(surface, open);
        facets = classic::facets_of(*closed);
        if (!facets) return facets.error();
        // What closes a hole goes by the facet at its first open edge: the caller's mesh has no other.
        for (classic::Facet& facet : *facets)
            if (facet.source >= surface.triangles.size()) facet.source = report.open_facets.front();
    }
    const mesh::LatticeMesh& mesh = closed ? *closed : surface;
    if (mesh::exact_volume6(mesh) == 0 && !mesh.triangles.empty()) {
        Error error{ErrorCode::not_a_solid,
                    "the surface encloses nothing: its facets cancel each other, or are flat",
                    {}};
        error.place.faces = {0};
        return error;
    }
    report.exact_volume =
        std::ldexp(static_cast<double>(mesh::exact_volume6(mesh)), 3 * mesh.lattice.exponent()) / 6;
    return SolidFacets{std::move(*facets)};
}

/// Overlaps thinner than a cell leave no trace in the winding numbers of corners, so the surface is searched. Holes are
/// not closed for that: where fans that close them cross it is a guess anyway.
Result<Prepared> prepare(std::span<const mesh::Mesh> solids, const Options& options, const Context& context) {
    Prepared prepared;
    prepared.content = mesh::bounds_of_facets(solids);
    if (prepared.content.empty())
        return Error{ErrorCode::bad_input, "there is nothing to mesh: the solids have no facets", {}};
    const Result<exact::Lattice> lattice = grid_lattice(prepared.content);
    if (!lattice) return lattice.error();
    prepared.lattice = *lattice;
    for (std::size_t i = 0; i < solids.size(); ++i) {
        Result<mesh::Snapped> snapped = mesh::snap(solids[i], *lattice);
        if (!snapped) return of_solid(snapped.error(), i, solids.size());
        SolidReport& report = prepared.reports.emplace_back();
        report.largest_displacement = snapped->report.largest_displacement;
        Result<SolidFacets> facets = closed_facets(snapped->mesh, options.open, report);
        if (!facets) return of_solid(facets.error(), i, solids.size());
        Result<std::vector<mesh::FaceIndex>> overlap = mesh::find_self_overlap(snapped->mesh, context);
        if (!overlap) return of_solid(overlap.error(), i, solids.size());
        if (!overlap->empty() && options.overlaps == OverlapPolicy::reject)
            return of_solid(overlap_error(std::move(*overlap), report), i, solids.size());
        prepared.overlaps = prepared.overlaps || !overlap->empty();
        prepared.facets.push_back(std::move(*facets));
    }
    return prepared;
}

/// Gives the cells of a refinement the sets of the cells that they lie in, none of which is a split boundary cell.
ClassifiedCells inherit(ClassifiedCells coarse, std::vector<CellKey> keys) {
    std::vector<std::uint16_t> sets(keys.size());
    std::size_t at = 0;
    for (std::size_t i = 0; i < keys.size(); ++i) {
        while (coarse.keys[at].last_descendant() < keys[i]) ++at;
        sets[i] = coarse.set_of_cell[at];
    }
    coarse.set_of_cell = std::move(sets);
    coarse.keys = std::move(keys);
    return coarse;
}

bool splits_a_boundary_cell(const ClassifiedCells& coarse, std::span<const CellKey> keys) {
    std::size_t next = 0;
    for (std::size_t i = 0; i < coarse.keys.size(); ++i) {
        if (keys[next] != coarse.keys[i] && !coarse.sets[coarse.set_of_cell[i]].boundary.empty()) return true;
        while (next < keys.size() && keys[next] <= coarse.keys[i].last_descendant()) ++next;
    }
    return false;
}

/// Cells that must exist so that each of `cells` has neighbours of its own size on all sides; sorted.
std::vector<CellKey> neighbourhood(const std::vector<CellKey>& cells) {
    std::vector<CellKey> all;
    for (const CellKey cell : cells)
        for (int z = -1; z <= 1; ++z)
            for (int y = -1; y <= 1; ++y)
                for (int x = -1; x <= 1; ++x)
                    if (const std::optional<CellKey> next = cell.neighbour(x, y, z)) all.push_back(*next);
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
}

/// Splits leaves until every cell of `wanted` is a leaf or is split itself. Both are sorted.
std::vector<CellKey> split_for(std::span<const CellKey> leaves, std::span<const CellKey> wanted) {
    std::vector<CellKey> result;
    const auto split = [&](const auto& self, CellKey cell, std::span<const CellKey> inside) -> void {
        const bool is_larger =
            std::any_of(inside.begin(), inside.end(), [&](CellKey w) { return w.level() > cell.level(); });
        if (!is_larger) return result.push_back(cell);
        for (int octant = 0; octant < 8; ++octant) {
            const CellKey child = cell.child(octant);
            const auto low = std::lower_bound(inside.begin(), inside.end(), child.first_descendant());
            const auto high = std::upper_bound(low, inside.end(), child.last_descendant());
            self(self, child, {low, high});
        }
    };
    std::size_t at = 0;
    for (const CellKey leaf : leaves) {
        while (at < wanted.size() && wanted[at] < leaf.first_descendant()) ++at;
        std::size_t end = at;
        while (end < wanted.size() && wanted[end] <= leaf.last_descendant()) ++end;
        split(split, leaf, wanted.subspan(at, end - at));
        at = end;
    }
    return result;
}

/// The refinement that Options::layers asks for; it stops at the first layer with too many cells.
std::vector<CellKey> with_layers(const ClassifiedCells& cells, RefinedAtWalls refined,
                                 const Options& options) {
    std::vector<CellKey> keys = std::move(refined.keys), front = std::move(refined.cells);
    for (std::size_t i = 0; i < cells.keys.size(); ++i)
        if (!cells.sets[cells.set_of_cell[i]].boundary.empty()) front.push_back(cells.keys[i]);
    for (int layer = 0; layer < options.layers && keys.size() <= options.max_cells; ++layer) {
        front = neighbourhood(front);
        keys = split_for(keys, front);
    }
    return keys;
}

Result<ClassifiedCells> balanced_cells(const Prepared& prepared, const Options& options,
                                       const Context& context) {
    const Result<SizeField> sizes =
        SizeField::from(options, prepared.facets.size(), prepared.content, prepared.lattice);
    if (!sizes) return sizes.error();
    Result<ClassifiedCells> refined = refine(prepared.facets, *sizes, options, context);
    if (!refined) return refined;
    Result<RefinedAtWalls> at_walls = refine_at_walls(*refined, prepared.facets, *sizes, options, context);
    if (!at_walls) return at_walls.error();
    std::vector<CellKey> keys = octree::balance(
        options.layers > 0 ? with_layers(*refined, std::move(*at_walls), options) : at_walls->keys,
        options.balance);
    if (keys.size() > options.max_cells) return too_many_cells(options.max_cells);
    if (splits_a_boundary_cell(*refined, keys)) return classify(prepared.facets, keys, options, context);
    return inherit(std::move(*refined), std::move(keys));
}

/// Adds with the rounding errors kept (A. Neumaier, 1974).
class CompensatedSum {
  public:
    void add(double value) {
        const double sum = sum_ + value;
        lost_ += std::fabs(sum_) >= std::fabs(value) ? (sum_ - sum) + value : (value - sum) + sum_;
        sum_ = sum;
    }
    double total() const { return sum_ + lost_; }

  private:
    double sum_ = 0, lost_ = 0;
};

using PerLevel = std::array<double, octree::max_level + 1>;

/// The sides of cells of each level, in world units.
PerLevel sides_of_levels(const exact::Lattice& lattice) {
    PerLevel sides{};
    for (int level = 0; level <= octree::max_level; ++level)
        sides[static_cast<std::size_t>(level)] = std::ldexp(lattice.unit(), exact::coordinate_bits - level);
    return sides;
}

/// Counts and measures the solids, in all cells.
void measure_solids(const exact::Lattice& lattice, const ClassifiedCells& cells,
                    std::vector<SolidReport>& solids) {
    std::vector<CompensatedSum> filled(solids.size());
    PerLevel volumes = sides_of_levels(lattice);
    for (double& volume : volumes) volume = volume * volume * volume;
    std::size_t fraction = 0;
    for (std::size_t cell = 0; cell < cells.keys.size(); ++cell) {
        const mesh::SolidSet& set = cells.sets[cells.set_of_cell[cell]];
        const double volume = volumes[static_cast<std::size_t>(cells.keys[cell].level())];
        for (const mesh::SolidIndex solid : set.inside) {
            ++solids[solid].inside_cells;
            solids[solid].inside_volume += volume;
            filled[solid].add(volume);
        }
        for (const mesh::SolidIndex solid : set.boundary) {
            ++solids[solid].boundary_cells;
            solids[solid].boundary_volume += volume;
            if (!cells.fractions.empty()) filled[solid].add(volume * cells.fractions[fraction++]);
        }
    }
    for (std::size_t solid = 0; solid < solids.size(); ++solid)
        solids[solid].filled_volume = filled[solid].total();
}

/// The boxes that lie beside what holds all solids, and so change nothing.
std::vector<std::size_t> missed_boxes(std::span<const BoxSize> boxes, const Box3& content) {
    std::vector<std::size_t> missed;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const Box3& box = boxes[i].box;
        bool meets = true;
        for (int axis = 0; axis < 3; ++axis)
            meets = meets && box.low[axis] <= content.high[axis] && content.low[axis] <= box.high[axis];
        if (!meets) missed.push_back(i);
    }
    return missed;
}

/// Counts the cells of the mesh.
void count_cells(const mesh::HexMesh& mesh, Report& report) {
    for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell) {
        const mesh::SolidSet& set = mesh.set_of(static_cast<mesh::CellIndex>(cell));
        ++report.cells_of_level[static_cast<std::size_t>(mesh.cells[cell].level())];
        report.boundary_cells += !set.boundary.empty();
        report.inside_cells += set.boundary.empty() && !set.inside.empty();
    }
    const PerLevel sides = sides_of_levels(mesh.lattice);
    for (std::size_t level = 0; level < sides.size(); ++level) {
        if (report.cells_of_level[level] == 0) continue;
        if (report.largest_cell == 0) report.largest_cell = sides[level];
        report.smallest_cell = sides[level];
    }
}

bool is_by_half(Keep keep) { return keep == Keep::half || keep == Keep::manifold; }

/// Measures the solids and, where that is asked for, says which boundary cells are in and which are out. For
/// Keep::manifold larger cells are split until smaller ones cover none of their sides in part.
Result<ClassifiedCells> decided_cells(const Prepared& prepared, ClassifiedCells cells, const Options& options,
                                      Report& report, const Context& context) {
    for (int round = 0;; ++round) {
        report.tree_cells = cells.keys.size();
        report.solids = prepared.reports;
        measure_solids(prepared.lattice, cells, report.solids);
        if (!is_by_half(options.keep)) return cells;
        const Result<HalfFilled> decided = decide_by_half(cells, options.keep);
        if (!decided) return decided.error();
        report.half_filled = *decided;
        if (options.keep != Keep::manifold) return cells;
        const std::vector<CellKey> covered = cut_off_in_the_middle(cells);
        report.cut_off_cells = covered.size();
        if (covered.empty() || round >= options.splitting_rounds) return cells;
        const std::vector<CellKey> keys = octree::balance(split(cells.keys, covered), options.balance);
        if (keys.size() > options.max_cells) return too_many_cells(options.max_cells);
        Result<ClassifiedCells> finer = classify(prepared.facets, keys, options, context);
        if (!finer) return finer;
        cells = std::move(*finer);
    }
}

/// Keeps the cells that belong to the mesh, and numbers their nodes.
Result<mesh::HexMesh> assemble(const exact::Lattice& lattice, ClassifiedCells cells, const Options& options) {
    std::vector<std::uint8_t> kept;
    if (options.keep != Keep::all) {
        kept.resize(cells.keys.size());
        for (std::size_t i = 0; i < kept.size(); ++i) kept[i] = cells.set_of_cell[i] != 0;
    }
    Result<Numbering> numbering = number_nodes(cells.keys, std::move(kept));
    if (!numbering) return numbering.error();

    mesh::HexMesh mesh;
    mesh.lattice = lattice;
    mesh.corners = std::move(numbering->corners);
    mesh.nodes = std::move(numbering->nodes);
    mesh.edge_hanging = std::move(numbering->edge_hanging);
    mesh.face_hanging = std::move(numbering->face_hanging);
    mesh.constraints_are_direct = options.balance != octree::Contact::face;
    mesh.sets = std::move(cells.sets);
    mesh.fractions = std::move(cells.fractions);  // outside cells have none
    if (options.keep != Keep::all) {
        std::size_t next = 0;
        for (std::size_t i = 0; i < cells.keys.size(); ++i) {
            if (cells.set_of_cell[i] == 0) continue;
            cells.keys[next] = cells.keys[i];
            cells.set_of_cell[next++] = cells.set_of_cell[i];
        }
        cells.keys.resize(next);
        cells.set_of_cell.resize(next);
    }
    mesh.cells = std::move(cells.keys);
    mesh.set_of_cell = std::move(cells.set_of_cell);
    return mesh;
}

}  // namespace

Error empty_error(std::span<const SolidReport> solids) {
    for (std::size_t i = 0; i < solids.size(); ++i)
        if (solids[i].exact_volume < 0) return of_solid(inside_out_error({0}), i, solids.size());
    return {
        ErrorCode::bad_input,
        "the mesh has no cells: those asked for are too large for the solid; ask for smaller ones (level, "
        "precision)",
        {}};
}

Result<Built> build(std::span<const mesh::Mesh> solids, const Options& options, const Context& context) {
    if (options.layers < 0 || options.layers > 100)
        return Error{ErrorCode::bad_input, "the number of layers must be 0 to 100", {}};
    if (is_by_half(options.keep) && options.fractions == Fractions::skip)
        return Error{
            ErrorCode::bad_input, "to keep cells that are half filled, fractions must be computed", {}};
    Result<Prepared> prepared = prepare(solids, options, context);
    if (!prepared) return prepared.error();
    Result<ClassifiedCells> cells = balanced_cells(*prepared, options, context);
    if (!cells) return cells.error();
    if (!cells->overlap.empty() && options.overlaps == OverlapPolicy::reject) {
        const mesh::SolidIndex solid = cells->overlapping_solid;
        return of_solid(overlap_error(cells->overlap, prepared->reports[solid]), solid, solids.size());
    }
    if (context.cancelled()) return Context::cancelled_error();

    Built built;
    built.report.overlaps = prepared->overlaps || !cells->overlap.empty();
    if (options.keep != Keep::all) built.report.missed_boxes = missed_boxes(options.boxes, prepared->content);
    cells = decided_cells(*prepared, std::move(*cells), options, built.report, context);
    if (!cells) return cells.error();
    prepared->facets = {};
    context.report("number", 0);
    Result<mesh::HexMesh> mesh = assemble(prepared->lattice, std::move(*cells), options);
    if (!mesh) return mesh.error();
    if (mesh->corners.empty()) return empty_error(built.report.solids);
    count_cells(*mesh, built.report);
    built.mesh = std::move(*mesh);
    context.report("number", 1);
    return built;
}

}  // namespace octavo::hexmesh
