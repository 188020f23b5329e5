// SPDX-License-Identifier: Apache-2.0
#include "boolean_facts.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include <octavo/base/counted.hpp>
#include <octavo/mesh/measure.hpp>

#include "model.hpp"
#include "option_checks.hpp"

namespace octavo::cli {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Where the first number after "operand " or "operands " stands, else npos.
std::size_t operand_number(std::string_view sentence) {
    const std::string_view word = "operand";
    for (std::size_t at = sentence.find(word); at != sentence.npos; at = sentence.find(word, at + 1)) {
        std::size_t end = at + word.size();
        if (end < sentence.size() && sentence[end] == 's') ++end;
        if (end + 1 < sentence.size() && sentence[end] == ' ' && is_digit(sentence[end + 1])) return end + 1;
    }
    return sentence.npos;
}

/// A warning of the library, which says "operand 1" and "operands 0, 2", with names instead.
std::string with_names(const std::string& sentence, const std::vector<std::string>& names) {
    const std::size_t first = operand_number(sentence);
    if (names.empty() || first == std::string::npos) return sentence;
    std::string named = sentence.substr(0, sentence.rfind("operand", first));
    for (std::size_t at = first;;) {
        std::size_t end = at;
        while (end < sentence.size() && is_digit(sentence[end])) ++end;
        named += names.at(std::stoul(sentence.substr(at, end - at)));
        const bool more =
            sentence.compare(end, 2, ", ") == 0 && end + 2 < sentence.size() && is_digit(sentence[end + 2]);
        if (!more) return named + sentence.substr(end);
        named += ", ";
        at = end + 2;
    }
}

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
            {"largest_move", flush.largest_move},
            {"settled", flush.settled}};
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

boolean::Options BooleanOutput::evaluation(boolean::Tolerance standard) const {
    boolean::Options options;
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
