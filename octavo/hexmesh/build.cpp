// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <octavo/hexmesh/build.hpp>
#include <octavo/hexmesh/classify.hpp>
#include <octavo/hexmesh/number.hpp>
#include <octavo/mesh/measure.hpp>
#include <octavo/mesh/snap.hpp>

namespace octavo::hexmesh {
namespace {

using octree::CellKey;

struct Prepared {
    exact::Lattice lattice;
    Box3 content;
    std::vector<SolidFacets> facets;
    std::vector<SolidReport> reports;
};

Error of_solid(Error error, std::size_t solid, std::size_t count) {
    if (count > 1) error.sentence = "solid " + std::to_string(solid) + ": " + error.sentence;
    return error;
}

/// Closes or refuses what is open.
Result<SolidFacets> closed_facets(mesh::LatticeMesh mesh, classic::OpenPolicy policy, SolidReport& report) {
    Result<std::vector<classic::Facet>> facets = classic::facets_of(mesh);
    if (!facets) return facets.error();
    const std::vector<classic::OpenEdge> open = classic::open_edges(mesh);
    if (!open.empty()) {
        const Error error = classic::open_surface_error(open);
        if (policy == classic::OpenPolicy::reject) return error;
        mesh = classic::close_holes(mesh, open);
        facets = classic::facets_of(mesh);
        if (!facets) return facets.error();
        report.open_facets = error.place.faces;
    }
    report.exact_volume =
        std::ldexp(static_cast<double>(mesh::exact_volume6(mesh)), 3 * mesh.lattice.exponent()) / 6;
    return SolidFacets{std::move(*facets)};
}

Result<Prepared> prepare(std::span<const mesh::Mesh> solids, const Options& options) {
    Prepared prepared;
    for (const mesh::Mesh& solid : solids) prepared.content.add(solid.bounds());
    if (prepared.content.empty())
        return Error{ErrorCode::bad_input, "there is nothing to mesh: the solids have no vertices", {}};
    const Result<exact::Lattice> lattice = grid_lattice(prepared.content);
    if (!lattice) return lattice.error();
    prepared.lattice = *lattice;
    for (std::size_t i = 0; i < solids.size(); ++i) {
        Result<mesh::Snapped> snapped = mesh::snap(solids[i], *lattice);
        if (!snapped) return of_solid(snapped.error(), i, solids.size());
        SolidReport& report = prepared.reports.emplace_back();
        report.largest_displacement = snapped->report.largest_displacement;
        Result<SolidFacets> facets = closed_facets(std::move(snapped->mesh), options.open, report);
        if (!facets) return of_solid(facets.error(), i, solids.size());
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

Result<ClassifiedCells> balanced_cells(const Prepared& prepared, const Options& options,
                                       const Context& context) {
    const Result<SizeField> sizes =
        SizeField::from(options, prepared.facets.size(), prepared.content, prepared.lattice);
    if (!sizes) return sizes.error();
    Result<ClassifiedCells> refined = refine(prepared.facets, *sizes, options, context);
    if (!refined) return refined;
    std::vector<CellKey> keys = octree::balance(refined->keys, options.balance);
    if (splits_a_boundary_cell(*refined, keys)) return classify(prepared.facets, keys, options, context);
    return inherit(std::move(*refined), std::move(keys));
}

Error overlap_error(const ClassifiedCells& cells, std::size_t solids) {
    Error error{
        ErrorCode::not_a_solid,
        "the surface overlaps itself or is inside out: winding numbers other than 0 and 1 occur; a union of "
        "the solid resolves overlaps",
        {}};
    error.place.faces = cells.overlap;
    std::sort(error.place.faces.begin(), error.place.faces.end());
    return of_solid(std::move(error), cells.overlapping_solid, solids);
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

/// Counts and measures the mesh.
Report report_of(const mesh::HexMesh& mesh, std::vector<SolidReport> solids) {
    Report report;
    report.solids = std::move(solids);
    std::vector<CompensatedSum> filled(report.solids.size());
    std::size_t fraction = 0;
    for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell) {
        const int level = mesh.cells[cell].level();
        const double side = std::ldexp(mesh.lattice.unit(), exact::coordinate_bits - level);
        const double volume = side * side * side;
        const mesh::SolidSet& set = mesh.set_of(static_cast<mesh::CellIndex>(cell));
        ++report.cells_of_level[static_cast<std::size_t>(level)];
        report.boundary_cells += !set.boundary.empty();
        report.inside_cells += set.boundary.empty() && !set.inside.empty();
        report.smallest_cell = cell == 0 ? side : std::min(report.smallest_cell, side);
        report.largest_cell = std::max(report.largest_cell, side);
        for (const mesh::SolidIndex solid : set.inside) {
            ++report.solids[solid].inside_cells;
            report.solids[solid].inside_volume += volume;
            filled[solid].add(volume);
        }
        for (const mesh::SolidIndex solid : set.boundary) {
            ++report.solids[solid].boundary_cells;
            report.solids[solid].boundary_volume += volume;
            if (!mesh.fractions.empty()) filled[solid].add(volume * mesh.fractions[fraction++]);
        }
    }
    for (std::size_t solid = 0; solid < report.solids.size(); ++solid)
        report.solids[solid].filled_volume = filled[solid].total();
    return report;
}

/// Keeps the cells that belong to the mesh, and numbers their nodes.
Result<mesh::HexMesh> assemble(const exact::Lattice& lattice, ClassifiedCells cells, const Options& options) {
    std::vector<std::uint8_t> kept;
    if (options.outside == Outside::carve) {
        kept.resize(cells.keys.size());
        for (std::size_t i = 0; i < kept.size(); ++i) kept[i] = cells.set_of_cell[i] != 0;
    }
    Result<Numbering> numbering = number_nodes(cells.keys, kept);
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
    if (!kept.empty()) {
        std::size_t next = 0;
        for (std::size_t i = 0; i < kept.size(); ++i) {
            if (!kept[i]) continue;
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

Result<Built> build(std::span<const mesh::Mesh> solids, const Options& options, const Context& context) {
    Result<Prepared> prepared = prepare(solids, options);
    if (!prepared) return prepared.error();
    Result<ClassifiedCells> cells = balanced_cells(*prepared, options, context);
    if (!cells) return cells.error();
    const bool overlaps = !cells->overlap.empty();
    if (overlaps && options.overlaps == OverlapPolicy::reject) return overlap_error(*cells, solids.size());
    if (context.cancelled()) return Context::cancelled_error();
    prepared->facets = {};

    const std::uint64_t tree_cells = cells->keys.size();
    context.report("number", 0);
    Result<mesh::HexMesh> mesh = assemble(prepared->lattice, std::move(*cells), options);
    if (!mesh) return mesh.error();
    Built built;
    built.report = report_of(*mesh, std::move(prepared->reports));
    built.report.tree_cells = tree_cells;
    built.report.overlaps = overlaps;
    built.mesh = std::move(*mesh);
    context.report("number", 1);
    return built;
}

}  // namespace octavo::hexmesh
