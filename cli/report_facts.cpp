// SPDX-License-Identifier: Apache-2.0
#include "report_facts.hpp"

namespace octavo::cli {

Json json_of(const mesh::Report& report) {
    Json problems = Json::array();
    for (const mesh::Problem& problem : report.problems)
        problems.push_back({{"kind", mesh::name_of(problem.kind)},
                            {"error", mesh::is_error(problem.kind)},
                            {"count", problem.count},
                            {"faces", problem.faces},
                            {"sentence", problem.sentence}});
    return {{"valid", report.solid},
            {"problems", problems},
            {"closed", report.closed},
            {"closed_as_stored", report.closed_as_stored},
            {"oriented", report.oriented},
            {"manifold", report.manifold},
            {"vertices", report.vertices},
            {"merged_vertices", report.merged_vertices},
            {"triangles", report.facets},
            {"components", report.components},
            {"merged_components", report.merged_components},
            {"shells", report.shells},
            {"cavities", report.cavities},
            {"nested_bodies", report.nested_bodies},
            {"largest_displacement", report.largest_displacement}};
}

}  // namespace octavo::cli
