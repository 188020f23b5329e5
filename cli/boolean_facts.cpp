// SPDX-License-Identifier: Apache-2.0
#include "boolean_facts.hpp"

#include <fmt/format.h>

#include <octavo/mesh/measure.hpp>

#include "model.hpp"
#include "option_checks.hpp"

namespace octavo::cli {
namespace {

void tell(Session& session, const boolean::Evaluated& evaluated, const std::string& output) {
    const mesh::Measures measures = mesh::measure(evaluated.mesh);
    const boolean::Report& report = evaluated.report;
    session.warn(report.warnings);
    session.result = {{"triangles", evaluated.mesh.triangles.size()},
                      {"vertices", evaluated.mesh.vertices.size()},
                      {"volume", measures.volume},
                      {"area", measures.area},
                      {"closed", report.closed},
                      {"manifold", report.manifold},
                      {"exact_fallbacks", report.exact_fallbacks},
                      {"operands", report.operands},
                      {"input_triangles", report.input_triangles},
                      {"cut_facets", report.cut_facets},
                      {"closing_facets", report.closing_facets},
                      {"largest_displacement", report.largest_displacement},
                      {"largest_rounding", report.largest_rounding},
                      {"inverted_facets", report.inverted_facets},
                      {"first_inverted", report.first_inverted}};
    session.text = fmt::format("{}: {} triangles, volume {}, area {}\n", output,
                               grouped(evaluated.mesh.triangles.size()), number_text(measures.volume),
                               number_text(measures.area));
}

}  // namespace

boolean::Options BooleanOutput::evaluation() const {
    boolean::Options options;
    options.simplify = simplify == "none" ? boolean::Simplify::none : boolean::Simplify::coplanar;
    options.open = open == "winding" ? boolean::OpenOperands::winding : boolean::OpenOperands::reject;
    return options;
}

void add_boolean_options(Verb* verb, BooleanOutput& options) {
    verb->add_option("-o,--output", options.output,
                     "The mesh to write: " + one_of(mesh_outputs().names) + "; - is stdout")
        ->required()
        ->type_name("FILE");
    take_one_of(
        verb->add_option("--simplify", options.simplify,
                         "What happens to cut facets in one plane: coplanar merges, none leaves them"),
        {"none", "coplanar"});
    take_one_of(
        verb->add_option("--open", options.open,
                         "What happens to operands that do not close: reject refuses them, winding closes "
                         "each hole by a cone over its rim and takes as inside what the surface winds about"),
        {"reject", "winding"});
    verb->add_option("--to", options.format, "Format of the output, instead of by its extension")
        ->type_name("FORMAT");
}

Result<ExitCode> write_boolean(Session& session, const Context& context, const boolean::Evaluated& evaluated,
                               const std::string& output, const std::string& format) {
    Result<io::WriteReport> written =
        write_mesh(session, context, output, evaluated.mesh, {.format = format});
    if (!written) return std::move(written).error();
    tell(session, evaluated, output);
    return ExitCode::ok;
}

}  // namespace octavo::cli
