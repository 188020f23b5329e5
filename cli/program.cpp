// SPDX-License-Identifier: Apache-2.0
#include "program.hpp"

#include <algorithm>
#include <exception>
#include <iterator>
#include <span>
#include <sstream>
#include <string_view>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "definitions.hpp"
#include "help_formatter.hpp"
#include "option_checks.hpp"
#include "suggestion.hpp"

namespace octavo::cli {
namespace {

constexpr const char* footer =
    "Formats follow from the file's extension; - is stdin or stdout. Data goes to stdout, messages to "
    "stderr.\n"
    "Meshes: stl, obj, ply, off, 3mf, poly, smesh read and written; 3ds, amf, dae, dxf, "
    "fbx, glb, gltf, lwo, x, x3d read through assimp.\n"
    "CSG trees of OpenSCAD: csg read. Octrees: oct read and written; vtu, htg written for ParaView.\n"
    "BP-octrees: bpo read and written. BSP-octrees: bso read and written.\n"
    "Points: csv, xyz, npy, ply read. Answers: csv, npy, ply written. Pictures: png, svg, pdf written.\n"
    "\n"
    "Exit codes: 0 ok, 1 the answer is no, 2 usage, 3 bad input, 4 a limit was reached, 5 internal error, "
    "130 interrupted; 129 and 143 ended by SIGHUP and SIGTERM.\n"
    "2 stands for what is wrong whatever the files hold: an unknown option, one that the formats have no use "
    "for, "
    "an output that is an input.\n"
    "check answers no when the mesh is no solid. repair ends with 0 when it has written a file, solid or "
    "not: see "
    "\"valid\" of --json.\n"
    "\n"
    "Help on one verb: octavo help VERB. The manual: octavo man | man -l -";

constexpr const char* verb_footer = "Formats and exit codes: octavo --help";

std::string with_suggestion(const std::string& sentence, const std::string& word,
                            std::span<const std::string> known) {
    const std::string meant = nearest_word(word, known);
    return meant.empty() ? sentence : sentence + "; did you mean " + meant + "?";
}

bool is_option(const std::string& word) { return word.size() > 1 && word.starts_with('-'); }

/// The long names; a letter is near to any other, so that short ones are no suggestions.
std::vector<std::string> long_names(const std::vector<OptionDefinition>& options) {
    std::vector<std::string> names;
    for (const OptionDefinition& option : options)
        std::copy_if(option.names.begin(), option.names.end(), std::back_inserter(names),
                     [](const std::string& name) { return name.starts_with("--"); });
    return names;
}

/// The same for an option that is not known. One letter is near to nothing.
std::string with_option(const std::string& sentence, const std::string& word,
                        const std::vector<OptionDefinition>& known) {
    return word.size() > 2 ? with_suggestion(sentence, word, long_names(known)) : sentence;
}

/// What is wrong with the command line when no verb was found in it, among words that mean nothing.
std::string sentence_without_verb(const CLI::App& app, const std::vector<std::string>& words) {
    if (words.empty()) return "a verb is missing";
    const std::string& first = words.front();
    if (is_option(first)) return with_option("there is no option " + first, first, common_definitions(app));
    std::vector<std::string> verbs;
    for (const VerbDefinition& verb : definitions_of(app)) verbs.push_back(verb.name);
    return with_suggestion("there is no verb " + first, first, verbs);
}

/// What is wrong when an option has another number of values than it takes. CLI11 says it in sentences that it makes of
/// the option's name, a number and the placeholder.
std::string sentence_of_mismatch(const std::string& message) {
    const std::size_t colon = message.find(": ");
    if (colon == std::string::npos) return message;
    const std::string name = message.substr(0, colon), rest = message.substr(colon + 2);
    const auto between = [&](std::string_view begin, std::string_view end) {
        return rest.substr(begin.size(), rest.size() - begin.size() - end.size());
    };
    constexpr std::string_view too_many = "At Most 1 required but received ", too_few = "1 required ",
                               missing = " missing";
    if (rest.starts_with(too_many))
        return fmt::format("{} is given {} times, and takes one value", name, between(too_many, ""));
    if (rest.starts_with(too_few) && rest.ends_with(missing))
        return fmt::format("{} needs a value: {}", name, between(too_few, missing));
    return message;
}

/// What is wrong with an option that stands where nobody takes it.
std::string sentence_of_option(const std::string& option, const std::string& verb,
                               const std::vector<OptionDefinition>& known) {
    const bool stands_before = std::any_of(known.begin(), known.end(), [&](const OptionDefinition& one) {
        return std::find(one.names.begin(), one.names.end(), option) != one.names.end();
    });
    if (stands_before)
        return fmt::format("{} belongs to {} and stands behind it: octavo {} {}", option, verb, verb, option);
    return with_option(fmt::format("{} has no option {}", verb, option), option, known);
}

/// What is wrong with the command line, in the words of this program.
std::string sentence_of(const CLI::ParseError& error, const CLI::App& app) {
    const std::string what =
        error.get_name() == "ArgumentMismatch" ? sentence_of_mismatch(error.what()) : error.what();
    const std::vector<const CLI::App*> chosen =
        app.get_subcommands([](const CLI::App* verb) { return verb->parsed(); });
    // What is there too much explains best, also where something else is missing.
    const std::vector<std::string> extras = app.remaining(true);
    // Its name is that of the verb.
    const bool is_extra = error.get_exit_code() == static_cast<int>(CLI::ExitCodes::ExtrasError);
    if (chosen.empty())
        return is_extra || error.get_name() == "RequiredError" ? sentence_without_verb(app, extras) : what;
    const std::string verb = chosen.front()->get_name();
    const auto option = std::find_if(extras.begin(), extras.end(), is_option);
    if (option == extras.end())
        return is_extra && !extras.empty()
                   ? fmt::format("{} takes no further argument {}", verb, extras.front())
                   : what;
    std::vector<OptionDefinition> known;
    for (VerbDefinition& definition : definitions_of(app))
        if (definition.name == verb) known = std::move(definition.options);
    return sentence_of_option(*option, verb, known);
}

/// Whether an object is wanted on stdout; asked when the command line could not be parsed.
bool names_json(int argc, const char* const* argv) {
    return std::any_of(argv, argv + argc,
                       [](const char* word) { return std::string_view(word) == "--json"; });
}

}  // namespace

Program::Program() : app_(std::make_unique<CLI::App>("Exact solid modelling on octrees.", "octavo")) {
    app_->set_version_flag("--version", std::string("octavo ") + OCTAVO_VERSION);
    app_->require_subcommand(1);
    app_->footer(footer);
    app_->formatter(std::make_shared<HelpFormatter>());
    add_common_options(verbs_.emplace_back(app_.get()));

    add_info(*this);
    add_check(*this);
    add_render(*this);
    add_repair(*this);
    add_convert(*this);
    add_boolean(*this);
    add_eval(*this);
    add_mill(*this);
    add_shape(*this);
    add_octree(*this);
    add_build(*this);
    add_bsp(*this);
    add_stats(*this);
    add_contains(*this);
    add_distance(*this);
    add_hexmesh(*this);

    add_completion(*this);
    add_man(*this);
    add_help(*this);
}

Program::~Program() = default;

std::string Program::notes() const { return app_->get_footer(); }

Verb* Program::verb(const std::string& name, const std::string& group, const std::string& summary, Run run) {
    CLI::App* verb = app_->add_subcommand(name, summary);
    verb->group(group);
    verb->footer(verb_footer);
    verb->callback([this, name, run] {
        session_.command = name;
        chosen_ = run;
    });
    add_common_options(verbs_.emplace_back(verb));
    return &verbs_.back();
}

void Program::add_common_options(Verb& verb) {
    CommonOptions& options = session_.options;
    const std::string group = common_heading;
    verb.add_flag("--json", options.json, "Print one JSON object on stdout, also when it fails")
        ->group(group);
    verb.add_flag("-q,--quiet", options.quiet, "Print errors only")->group(group);
    verb.add_option("--threads", options.threads,
                    "Threads to use, at most one a core; 0 is all, the result is the same for any number")
        ->check(whole_number(0, 1024))
        ->type_name("N")
        ->capture_default_str()
        ->group(group);
    take_one_of(
        verb.add_option("--progress", options.progress, "Progress on stderr; auto is a bar on a terminal"),
        {"auto", "bar", "plain", "none"})
        ->group(group);
    take_one_of(verb.add_option("--color", options.color, "Colour in messages; auto is on a terminal"),
                {"auto", "always", "never"})
        ->group(group);
}

int Program::main(int argc, const char* const* argv) {
    try {
        app_->parse(argc, argv);
    } catch (const CLI::Success& success) {  // --help and --version
        std::ostringstream text;
        app_->exit(success, text, text);
        session_.options = {};
        session_.text = text.str();
        return session_.finish(ExitCode::ok);
    } catch (const CLI::ParseError& error) {
        session_.options.json = session_.options.json || names_json(argc, argv);
        for (const CLI::App* verb : app_->get_subcommands()) session_.command = verb->get_name();
        return session_.finish(session_.usage_error(sentence_of(error, *app_)));
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
