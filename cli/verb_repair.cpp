// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <octavo/mesh/repair.hpp>
#include <octavo/mesh/validate.hpp>

#include "file_faces.hpp"
#include "model.hpp"
#include "program.hpp"
#include "report_facts.hpp"

// `octavo repair IN -o OUT`: mends what can be mended without guessing, lists what it did and what is left.

namespace octavo::cli {
namespace {

struct RepairOptions {
    std::string input, output, from, to;
};

/// What was done to which faces of the file.
Json steps_of(const mesh::RepairReport& report, const io::ReadMesh& read) {
    Json steps = Json::array();
    for (const mesh::RepairStep& step : report.steps)
        steps.push_back({{"kind", mesh::name_of(step.kind)},
                         {"count", step.count},
                         {"faces", faces_of_file(step.faces, read.polygon_of_triangle)},
                         {"sentence", step.sentence}});
    return steps;
}

/// What helps where repair does not; empty where nothing is left, or nothing known helps.
std::string advice_for(const mesh::Report& report, const std::string& file) {
    if (report.solid) return "";
    const std::string beginning = "what was written bounds no solid";
    if (report.count(mesh::ProblemKind::empty) > 0) return beginning;
    if (report.count(mesh::ProblemKind::open_edges) > 0)
        return beginning +
               "; octree, contains, distance, hexmesh and set operations close holes with --open winding";
    if (report.oriented)
        return fmt::format("{}; octavo union {} -o FILE makes the surface anew where it meets itself",
                           beginning, file == "-" ? "IN" : file);
    return beginning + "; octavo check --json lists the facets";
}

Result<ExitCode> repair(Session& session, const RepairOptions& options) {
    const Context context = session.context();
    const Result<std::string> format =
        settle_output(session, {options.input}, options.output, options.to, mesh_outputs());
    if (!format) return format.error();
    Result<io::ReadMesh> read = read_mesh(session, context, options.input, options.from);
    if (!read) return std::move(read).error();
    Result<mesh::Repaired> repaired =
        session.timed("repair", [&] { return mesh::repair(read->mesh, context); });
    if (!repaired) return in_file(std::move(repaired).error(), options.input);
    Result<mesh::Report> after =
        session.timed("validate", [&] { return mesh::validate(repaired->mesh, {}, context); });
    if (!after) return in_file(std::move(after).error(), options.input);

    io::WriteOptions writing{.format = *format};
    if (!read->unit.empty()) writing.unit = read->unit;
    Result<io::WriteReport> written = write_mesh(session, context, options.output, repaired->mesh, writing);
    if (!written) return std::move(written).error();
    warn_of_losses(session, *read, *format);
    if (const std::string advice = advice_for(*after, options.output); !advice.empty()) session.warn(advice);

    session.result = json_of(*after);
    session.result["repairs"] = steps_of(repaired->report, *read);
    session.text = repaired->report.describe() + after->describe();
    return ExitCode::ok;
}

}  // namespace

void add_repair(Program& program) {
    const auto options = std::make_shared<RepairOptions>();
    Verb* verb = program.verb("repair", "Edit", "Mend what can be mended without guessing, and list it",
                              [options](Session& session) { return repair(session, *options); });
    verb->add_option("IN", options->input, "The mesh to mend; - is stdin")->required()->type_name("FILE");
    verb->add_option("-o,--output", options->output,
                     "The mesh to write: " + one_of(mesh_outputs().names) + "; - is stdout")
        ->required()
        ->type_name("FILE");
    add_from_option(verb, options->from, "IN");
    add_to_option(verb, options->to, mesh_outputs());
}

}  // namespace octavo::cli
