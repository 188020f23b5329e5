// SPDX-License-Identifier: Apache-2.0
#include "boolean_facts.hpp"

#include <regex>

#include <fmt/format.h>

#include <octavo/mesh/measure.hpp>

#include "model.hpp"
#include "option_checks.hpp"

namespace octavo::cli {
namespace {

/// A warning of the library, which says "operand 1" and "operands 0, 2", with names instead.
std::string with_names(const std::string& sentence, const std::vector<std::string>& names) {
    static const std::regex numbers("operands? ([0-9]+(, [0-9]+)*)"), number("[0-9]+");
    std::smatch found;
    if (names.empty() || !std::regex_search(sentence, found, numbers)) return sentence;
    const std::string list = found[1];
    std::string named;
    for (std::sregex_iterator at(list.begin(), list.end(), number), end; at != end; ++at)
        named += (named.empty() ? "" : ", ") + names.at(std::stoul(at->str()));
    return found.prefix().str() + named + found.suffix().str();
}

void tell(Session& session, const boolean::Evaluated& evaluated, const std::string& output,
          const OperandNames& operands) {
    const mesh::Measures measures = mesh::measure(evaluated.mesh);
    const boolean::Report& report = evaluated.report;
    for (const std::string& warning : report.warnings)
        session.warn(with_names(warning, operands.names.empty() ? operands.files : operands.names));
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

Error error_of_operand(Error error, const BooleanOutput& options, const OperandNames& operands) {
    if (error.code == ErrorCode::not_a_solid && options.open == "reject")
        error.sentence += "; --open winding takes such operands";
    return in_its_file(std::move(error), "operand", operands.files, operands.names);
}

Result<ExitCode> write_boolean(Session& session, const Context& context, const boolean::Evaluated& evaluated,
                               const std::string& output, const std::string& format,
                               const OperandNames& operands) {
    Result<io::WriteReport> written =
        write_mesh(session, context, output, evaluated.mesh, {.format = format});
    if (!written) return std::move(written).error();
    tell(session, evaluated, output, operands);
    return ExitCode::ok;
}

}  // namespace octavo::cli
