// SPDX-License-Identifier: Apache-2.0
#include "hexmesh_body.hpp"

#include <cmath>

#include <fmt/format.h>

#include <octavo/base/counted.hpp>
#include <octavo/hexmesh/pieces.hpp>
#include <octavo/mesh/topology.hpp>

#include "number_text.hpp"

namespace octavo::cli {
namespace {

double volume_of_octants(const hexmesh::Built& built) {
    double volume = 0;
    const double unit = built.mesh.lattice.unit();
    for (int level = 0; level <= octree::max_level; ++level) {
        const double side = unit * octree::cell_side(level);
        volume += static_cast<double>(built.report.cells_of_level[static_cast<std::size_t>(level)]) * side *
                  side * side;
    }
    return volume;
}

/// Surfaces that share no vertex: a solid with a cavity has more of them than pieces, none has less.
std::uint64_t shells_of(std::span<const mesh::Mesh> solids) {
    std::uint64_t shells = 0;
    for (const mesh::Mesh& solid : solids)
        shells += mesh::components_by_vertex(solid.triangles, solid.vertices.size()).count;
    return shells;
}

}  // namespace

void add_body(Session& session, const hexmesh::Built& built, std::span<const mesh::Mesh> solids,
              const std::optional<hexmesh::Quality>& quality, const BodyOptions& options) {
    const double volume = quality ? quality->volume : volume_of_octants(built);
    const std::uint64_t pieces = hexmesh::count_pieces(built.mesh);
    session.result["mesh_volume"] = volume;
    session.result["pieces"] = pieces;
    session.text +=
        fmt::format("the mesh: {}, volume {}", counted(pieces, "piece", "pieces"), number_text(volume));

    // Of several solids nobody knows how much they overlap.
    const double solid = built.report.solids.size() == 1 ? built.report.solids[0].exact_volume : 0;
    const double excess = solid > 0 ? volume / solid - 1 : 0;
    const std::string difference = fmt::format("{:.2g} % {} volume than the solid", 100 * std::fabs(excess),
                                               excess > 0 ? "more" : "less");
    constexpr double noise = 1e-6, worth_a_warning = 0.05;
    if (std::fabs(excess) > noise) session.text += ", " + difference;
    session.text += "\n";
    if (options.for_solver && std::fabs(excess) > worth_a_warning)
        session.warn(fmt::format("the mesh has {}, and solvers take whole cells: {} cells come nearer",
                                 difference, options.is_fitted ? "smaller" : "--fit and smaller"));
    if (const std::uint64_t shells = shells_of(solids); pieces > shells)
        session.warn(fmt::format("the mesh falls into {}, the {} of {}: cells are too large for thin parts",
                                 counted(pieces, "piece", "pieces"),
                                 solids.size() == 1 ? "solid is" : "solids are",
                                 counted(shells, "shell", "shells")));
}

}  // namespace octavo::cli
