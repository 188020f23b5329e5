// SPDX-License-Identifier: Apache-2.0
#include <octavo/mesh/validate.hpp>

#include "file_faces.hpp"
#include "model.hpp"
#include "program.hpp"
#include "report_facts.hpp"

// `octavo check FILE`: is it a solid, and if not, what is wrong and at which facets. Exit code 1 when it is not.

namespace octavo::cli {
namespace {

struct CheckOptions {
    std::string input, format;
    std::size_t most_faces = 1000;
};

Result<ExitCode> check(Session& session, const CheckOptions& options) {
    const Context context = session.context();
    Result<io::ReadMesh> read = read_mesh(session, context, options.input, options.format);
    if (!read) return std::move(read).error();
    mesh::ValidateOptions validating;
    validating.most_faces = options.most_faces;
    Result<mesh::Report> report =
        session.timed("validate", [&] { return mesh::validate(read->mesh, validating, context); });
    if (!report) return in_file(std::move(report).error(), options.input);
    session.result = json_of(with_faces_of_file(*report, *read));
    session.text = report->describe();
    return report->solid ? ExitCode::ok : ExitCode::no;
}

}  // namespace

void add_check(Program& program) {
    const auto options = std::make_shared<CheckOptions>();
    Verb* verb = program.verb("check", "Inspect", "Tell whether a mesh is a solid, and if not, why and where",
                              [options](Session& session) { return check(session, *options); });
    verb->add_option("FILE", options->input, "The mesh; - is stdin")->required()->type_name("FILE");
    add_from_option(verb, options->format, "FILE");
    verb->add_option("--faces", options->most_faces, "With --json: most facets to list in a problem")
        ->check(whole_number(0, 4'000'000'000))
        ->type_name("N")
        ->capture_default_str();
}

}  // namespace octavo::cli
