// SPDX-License-Identifier: Apache-2.0
#include "hexmesh_facts.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <octavo/mesh/materials.hpp>

#include "file_faces.hpp"
#include "model.hpp"

namespace octavo::cli {
namespace {

bool has_fractions(const hexmesh::Built& built) {
    return built.mesh.is_octree() && (!built.mesh.fractions.empty() || built.report.boundary_cells == 0);
}

/// How much of the solids the cells fill, all together. Without fractions nothing is known of boundary cells, so that
/// half of each is an estimate; conforming meshes have none, and what they fill are their cells.
double volume_of(const hexmesh::Report& report, bool exact) {
    double volume = 0;
    for (const hexmesh::SolidReport& solid : report.solids)
        volume += exact ? solid.filled_volume : solid.inside_volume + solid.boundary_volume / 2;
    return volume;
}

Json json_of(const hexmesh::SolidReport& solid, const std::string& name, bool exact) {
    Json json = {{"name", name},
                 {"interior", solid.inside_cells},
                 {"boundary", solid.boundary_cells},
                 {"interior_volume", solid.inside_volume},
                 {"boundary_volume", solid.boundary_volume},
                 {"exact_volume", solid.exact_volume},
                 {"largest_displacement", solid.largest_displacement}};
    if (exact) json["filled_volume"] = solid.filled_volume;
    return json;
}

/// How much of the solid the cells fill, in words.
std::string filled_text(const hexmesh::SolidReport& solid) {
    constexpr double rounding_of_sums = 1e-9;
    const double missing = 1 - solid.filled_volume / solid.exact_volume;
    if (std::fabs(missing) <= rounding_of_sums) return "all of it filled";
    return fmt::format("{} % of it filled", number_text(100 * (1 - missing)));
}

std::vector<bool> solids_with_cells(const mesh::HexMesh& mesh, std::size_t solids) {
    std::vector<bool> has_cells(solids, false);
    const mesh::Materials materials = mesh::materials_of(mesh);
    for (const std::vector<mesh::SolidIndex>& material : materials.solids)
        for (const mesh::SolidIndex solid : material) has_cells[solid] = true;
    return has_cells;
}

}  // namespace

Json json_of(const hexmesh::Built& built, std::span<const std::string> names) {
    const hexmesh::Report& report = built.report;
    const bool exact = has_fractions(built);
    const bool is_known = exact || report.boundary_cells == 0;
    Json solids = Json::array(), levels = Json::array();
    for (std::size_t i = 0; i < report.solids.size(); ++i) {
        solids.push_back(json_of(report.solids[i], names[i], exact));
    }
    const double unit = built.mesh.lattice.unit();
    for (int level = 0; level <= octree::max_level; ++level)  // a conforming mesh has none
        if (const std::uint64_t cells = report.cells_of_level[static_cast<std::size_t>(level)])
            levels.push_back({{"level", level}, {"side", unit * octree::cell_side(level)}, {"cells", cells}});
    return {{"cells", built.mesh.cell_count()},
            {"nodes", built.mesh.node_count()},
            {"hanging_nodes", built.mesh.hanging_nodes()},
            {"interior", report.inside_cells},
            {"boundary", report.boundary_cells},
            {is_known ? "volume" : "estimated_volume", volume_of(report, exact)},
            {"smallest_cell", report.smallest_cell},
            {"largest_cell", report.largest_cell},
            {"tree_cells", report.tree_cells},
            {"cells_added", report.half_filled.added},
            {"cells_left_out", report.half_filled.left_out},
            {"cells_cut_off", report.cut_off_cells},
            {"overlaps", report.overlaps},
            {"levels", levels},
            {"solids", solids}};
}

std::string text_of(const hexmesh::Built& built, std::span<const std::string> names) {
    const hexmesh::Report& report = built.report;
    std::string text =
        fmt::format("{} cells from {} to {}, {} nodes, {} of them hang\n", grouped(built.mesh.cell_count()),
                    number_text(report.smallest_cell), number_text(report.largest_cell),
                    grouped(built.mesh.node_count()), grouped(built.mesh.hanging_nodes()));
    const bool exact = has_fractions(built);
    for (std::size_t i = 0; i < report.solids.size(); ++i) {
        const hexmesh::SolidReport& solid = report.solids[i];
        text += fmt::format("{}: {} cells inside, {} on the boundary, volume {}", names[i],
                            grouped(solid.inside_cells), grouped(solid.boundary_cells),
                            number_text(solid.exact_volume));
        if (exact && solid.exact_volume != 0) text += ", " + filled_text(solid);
        text += "\n";
    }
    return text;
}

void add_quality(Session& session, const hexmesh::Quality& quality) {
    session.result["quality"] = {{"least_scaled_jacobian", quality.least},
                                 {"mean_scaled_jacobian", quality.mean},
                                 {"histogram", quality.histogram},
                                 {"shortest_edge", quality.shortest_edge},
                                 {"largest_edge_ratio", quality.largest_edge_ratio},
                                 {"not_proved_positive", quality.not_proved_positive}};
    std::uint64_t most = 1;
    for (const std::uint64_t count : quality.histogram) most = std::max(most, count);
    session.text += fmt::format(
        "shortest edge {}; edges of one cell differ by {} times at most\nscaled Jacobian at least {}, mean "
        "{}\n",
        number_text(quality.shortest_edge), number_text(quality.largest_edge_ratio),
        number_text(quality.least), number_text(quality.mean));
    for (std::size_t i = 0; i < quality.histogram.size(); ++i) {
        const auto bar = static_cast<std::size_t>(
            std::ceil(40.0 * static_cast<double>(quality.histogram[i]) / static_cast<double>(most)));
        session.text += fmt::format("  {:>3} {:>12} {}\n", number_text(0.1 * static_cast<double>(i)),
                                    grouped(quality.histogram[i]), std::string(bar, '#'));
    }
    if (quality.not_proved_positive > 0)
        session.warn(grouped(quality.not_proved_positive) +
                     " cells are not proved to be positive everywhere");
}

void add_fit(Session& session, const hexmesh::FitReport& report, const mesh::HexMesh& fitted) {
    session.result["cells"] = fitted.cell_count();
    session.result["nodes"] = fitted.node_count();
    session.result["hanging_nodes"] = fitted.hanging_nodes();
    session.result["fit"] = {{"buffer_layer", report.has_buffer_layer},
                             {"boundary_nodes", report.boundary_nodes},
                             {"nodes_on_surface", report.nodes_on_surface},
                             {"mean_distance", report.mean_distance},
                             {"largest_distance", report.largest_distance},
                             {"mean_distance_before", report.mean_distance_before},
                             {"largest_distance_before", report.largest_distance_before}};
    if (report.has_buffer_layer)
        session.text += fmt::format(
            "with a layer of cells on the boundary: {} cells, {} nodes, {} of them hang\n",
            grouped(fitted.cell_count()), grouped(fitted.node_count()), grouped(fitted.hanging_nodes()));
    session.text += fmt::format(
        "{} of {} boundary nodes are on the surface; distance {} on average (was {}), {} at most (was {})\n",
        grouped(report.nodes_on_surface), grouped(report.boundary_nodes), number_text(report.mean_distance),
        number_text(report.mean_distance_before), number_text(report.largest_distance),
        number_text(report.largest_distance_before));
}

void warn_about(Session& session, const hexmesh::Built& built, std::span<const std::string> names,
                std::span<const std::string> paths) {
    const hexmesh::Report& report = built.report;
    const std::vector<bool> has_cells = solids_with_cells(built.mesh, report.solids.size());
    for (std::size_t i = 0; i < report.solids.size(); ++i) {
        const hexmesh::SolidReport& solid = report.solids[i];
        if (!solid.open_facets.empty()) {
            const std::vector<std::uint32_t> near =
                faces_of_file({solid.open_facets.front()}, session.polygon_of_triangle[paths[i]]);
            session.warn(fmt::format("{}: the surface is open; its holes were closed, near facet {}",
                                     names[i], near.front()));
        }
        if (!has_cells[i])
            session.warn(fmt::format("{}: no cell of the mesh belongs to it; the cells are too large for it",
                                     names[i]));
        else if (solid.inside_cells == 0 && solid.boundary_cells > 0)
            session.warn(fmt::format("{}: no cell lies inside; the cells are too large for it", names[i]));
    }
    for (const std::size_t box : report.missed_boxes)
        session.warn(fmt::format("--box number {} misses the model and changes nothing", box + 1));
    if (report.cut_off_cells > 0)
        session.warn(
            fmt::format("smaller cells cover a part of a side of {} larger ones, however often these are "
                        "split; no layer of cells can be laid on the boundary",
                        grouped(report.cut_off_cells)));
    if (report.overlaps)
        session.warn(
            "a solid overlaps itself, or does where its vertices are rounded to the lattice; inside is where "
            "its "
            "surface winds at least once, and its exact volume counts overlaps as often as they are covered, "
            "but "
            "cells inside count once");
}

}  // namespace octavo::cli
