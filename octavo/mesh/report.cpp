// SPDX-License-Identifier: Apache-2.0
#include <array>

#include <octavo/base/grouped.hpp>
#include <octavo/mesh/report.hpp>

namespace octavo::mesh {

std::string_view name_of(ProblemKind kind) {
    constexpr std::array<std::string_view, 15> names{
        "empty",           "open_edges",         "inconsistent_orientation", "self_intersections",
        "penetrations",    "overlaps",           "duplicate_facets",         "inside_out_shells",
        "flat_shells",     "non_manifold_edges", "non_manifold_vertices",    "zero_area_facets",
        "touching_facets", "snapped_facets",     "unused_vertices"};
    return names[static_cast<std::size_t>(kind)];
}

std::string Report::describe() const {
    std::string text = solid ? "The mesh bounds a solid" : "The mesh does not bound a solid";
    if (solid)
        text += closed ? " and is closed" : ", although more than two facets meet in some edges";
    else
        text += closed ? ", although it is closed" : " and is not closed";
    if (closed != closed_as_stored)
        text += closed ? " once equal vertices are merged" : " when equal vertices are merged";
    text += ". It has " + grouped(facets) + (facets == 1 ? " facet in " : " facets in ");
    text += grouped(shells) + (shells == 1 ? " shell" : " shells");
    if (cavities != 0)
        text +=
            ", " + grouped(cavities) + (cavities == 1 ? " of which is a cavity" : " of which are cavities");
    text += ".\n";
    for (const Problem& problem : problems)
        text += std::string(is_error(problem.kind) ? "error: " : "note: ") + problem.sentence + ".\n";
    return text;
}

}  // namespace octavo::mesh
