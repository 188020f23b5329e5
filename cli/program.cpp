// SPDX-License-Identifier: Apache-2.0
#include "program.hpp"

#include <exception>

#include <fmt/format.h>

namespace octavo::cli {
namespace {

constexpr const char* footer =
    "Formats follow from the file's extension: stl obj ply off 3mf and more to read meshes, csg for OpenSCAD "
    "trees, oct\n"
    "and bpo for octrees; - is stdin or stdout. Data goes to stdout, messages to stderr.\n"
    "\n"
    "Exit codes: 0 ok, 1 the answer is no, 2 usage, 3 bad input, 4 a limit was reached, 5 internal error, "
    "130 interrupted.\n"
    "\n"
    "Help on one verb: octavo VERB --help";

/// What is wrong with the command line, in the words of this program.
std::string sentence_of(const CLI::ParseError& error, int argc, const char* const* argv) {
    if (error.get_name() != "RequiredError" ||
        std::string_view(error.what()).find("subcommand") == std::string_view::npos)
        return error.what();
    return argc > 1 ? fmt::format("there is no verb {}", argv[1]) : "a verb is missing";
}

int usage_error(const CLI::App& app, const std::string& sentence) {
    fmt::print(stderr, "octavo: {}\n", sentence);
    const CLI::App* at = &app;
    for (const CLI::App* verb : app.get_subcommands()) at = verb;
    fmt::print(stderr, "Try: octavo {}--help\n", at == &app ? "" : at->get_name() + " ");
    return static_cast<int>(ExitCode::usage);
}

}  // namespace

Program::Program() : app_("Exact solid modelling on octrees.", "octavo") {
    app_.set_version_flag("--version", std::string("octavo ") + OCTAVO_VERSION);
    app_.require_subcommand(1);
    app_.footer(footer);
    app_.get_formatter()->column_width(34);
    app_.get_formatter()->label("SUBCOMMAND", "VERB");

    add_info(*this);
    add_check(*this);
    add_render(*this);
    add_repair(*this);
    add_convert(*this);
    add_boolean(*this);
    add_eval(*this);
    add_shape(*this);
    add_octree(*this);
    add_build(*this);
    add_stats(*this);
    add_contains(*this);
    add_distance(*this);
    add_hexmesh(*this);

    add_completion(*this);
    add_man(*this);
}

CLI::App* Program::verb(const std::string& name, const std::string& group, const std::string& summary,
                        Run run) {
    CLI::App* verb = app_.add_subcommand(name, summary);
    verb->group(group);
    verb->callback([this, name, run] {
        session_.command = name;
        chosen_ = run;
    });
    add_common_options(verb);
    return verb;
}

void Program::add_common_options(CLI::App* verb) {
    CommonOptions& options = session_.options;
    verb->add_flag("--json", options.json, "Print one JSON object on stdout")->group("Common options");
    verb->add_flag("-q,--quiet", options.quiet, "Print errors only")->group("Common options");
    verb->add_option("--threads", options.threads,
                     "Threads to use; 0 is all, the result is the same for any number")
        ->check(CLI::Range(0, 1024))
        ->type_name("N")
        ->group("Common options");
    verb->add_option("--progress", options.progress, "Progress on stderr: auto, bar, plain or none")
        ->check(CLI::IsMember({"auto", "bar", "plain", "none"}))
        ->type_name("STYLE")
        ->group("Common options");
    verb->add_option("--color", options.color, "Colour in messages: auto, always or never")
        ->check(CLI::IsMember({"auto", "always", "never"}))
        ->type_name("WHEN")
        ->group("Common options");
}

int Program::main(int argc, const char* const* argv) {
    try {
        app_.parse(argc, argv);
    } catch (const CLI::Success& success) {  // --help and --version
        return app_.exit(success);
    } catch (const CLI::ParseError& error) {
        return usage_error(app_, sentence_of(error, argc, argv));
    }
    try {
        return session_.finish(chosen_(session_));
    } catch (const std::bad_alloc&) {
        return session_.finish(Error{ErrorCode::limit, "out of memory", {}});
    } catch (const std::exception& unexpected) {
        return session_.finish(
            Error{ErrorCode::internal, std::string("unexpected: ") + unexpected.what(), {}});
    }
}

}  // namespace octavo::cli
