// SPDX-License-Identifier: Apache-2.0
#include "boolean_facts.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include <octavo/base/counted.hpp>
#include <octavo/mesh/measure.hpp>

#include "model.hpp"
#include "option_checks.hpp"

namespace octavo::cli {
namespace {

std::optional<double> parse_length(const std::string& text) {
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool good = error == std::errc() && end == text.data() + text.size() && std::isfinite(number);
    return good && number >= 0 ? std::optional(number) : std::nullopt;
}

Json facts_of(const boolean::FlushReport& flush) {
    Json removed = Json::array();
    for (const mesh::Source& source : flush.first_removed) removed.push_back({source.operand, source.face});
    return {{"tolerance", flush.tolerance},
            {"rounds", flush.rounds},
            {"merged_vertices", flush.merged_vertices},
            {"added_vertices", flush.added_vertices},
            {"bent_edges", flush.bent_edges},
            {"bent_facets", flush.bent_facets},
            {"joined_facets", flush.joined_facets},
            {"removed_facets", flush.removed_facets},
            {"first_removed", removed},
            {"removed_shells", flush.removed_shells},
            {"folded_facets", flush.folded_facets},
            {"left_alone", flush.left_alone},
            {"largest_move", flush.largest_move},
            {"settled", flush.settled}};
}

/// Whether coordinates are rounded to floats in the format.
bool holds_floats(const std::string& format) { return format == "stl"; }

void tell(Session& session, const boolean::Evaluated& evaluated, const std::string& output,
          const std::string& format) {
    const mesh::Moments measures = mesh::moments(evaluated.mesh);
    const boolean::Report& report = evaluated.report;
    session.warn(report.warnings);
    if (holds_floats(format) && report.largest_rounding > 0)
        session.warn("binary STL holds floats: coordinates were rounded by up to " +
                     number_text(report.largest_rounding));
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
                      {"mended_points", report.mended_points},
                      {"inverted_facets", report.inverted_facets},
                      {"first_inverted", report.first_inverted},
                      {"crossing_facets", report.crossing_facets},
                      {"first_crossing", report.first_crossing},
                      {"dangling_facets", report.dangling_facets},
                      {"flush", facts_of(report.flush)}};
    session.text = fmt::format("{}: {}, volume {}, area {}\n", output,
                               counted(evaluated.mesh.triangles.size(), "triangle", "triangles"),
                               number_text(measures.volume), number_text(measures.area));
    if (report.flush.rounds > 0)
        session.text += fmt::format(
            "made flush within {}: {} merged, {} and {} bent by at most {}, {} removed\n",
            number_text(report.flush.tolerance), counted(report.flush.merged_vertices, "vertex", "vertices"),
            counted(report.flush.bent_edges, "edge", "edges"),
            counted(report.flush.bent_facets, "facet", "facets"), number_text(report.flush.largest_move),
            counted(report.flush.removed_facets, "facet", "facets"));
    if (report.dangling_facets > 0)
        session.text += counted(report.dangling_facets, "facet dangles\n", "facets dangle\n");
}

}  // namespace

boolean::Options BooleanOutput::evaluation(const std::string& settled, boolean::Tolerance standard) const {
    boolean::Options options;
    options.numbers = holds_floats(settled) ? boolean::Numbers::floats : boolean::Numbers::doubles;
    options.tolerance = tolerance.empty()
                            ? standard
                            : boolean::Tolerance{*parse_length(tolerance), boolean::Tolerance::Of::length};
    options.simplify = simplify == "none" ? boolean::Simplify::none : boolean::Simplify::coplanar;
    options.open = open == "winding" ? boolean::OpenOperands::winding : boolean::OpenOperands::reject;
    options.dangling = regularized == "no" ? boolean::Dangling::kept : boolean::Dangling::dropped;
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
    verb->add_option(
            "--tolerance", options.tolerance,
            "Faces, edges and vertices nearer than this become flush; 0 is none. Two units of the "
            "lattice when not given, for .csg files 2e-6 of the size, which is what they are written to")
        ->check([](const std::string& text) {
            return parse_length(text) ? std::string() : "must be a length, 0 or more, not " + text;
        })
        ->type_name("LENGTH");
    take_one_of(verb->add_option(
                    "--regularized", options.regularized,
                    "Whether the result is a solid throughout: no keeps faces that operands share outside of "
                    "it too, as sheets without thickness"),
                {"yes", "no"});
    take_one_of(
        verb->add_option("--open", options.open,
                         "What happens to operands that do not close: reject refuses them, winding closes "
                         "each hole by a cone over its rim and takes as inside what the surface winds about"),
        {"reject", "winding"});
    add_to_option(verb, options.format, mesh_outputs());
}

Error with_advice(Error error, const BooleanOutput& options) {
    if (error.code == ErrorCode::not_a_solid && options.open == "reject")
        error.sentence += "; --open winding takes such operands";
    return error;
}

Result<ExitCode> write_boolean(Session& session, const Context& context, const boolean::Evaluated& evaluated,
                               const std::string& output, const std::string& format) {
    Result<io::WriteReport> written =
        write_mesh(session, context, output, evaluated.mesh, {.format = format});
    if (!written) return std::move(written).error();
    tell(session, evaluated, output, format);
    return ExitCode::ok;
}

}  // namespace octavo::cli
