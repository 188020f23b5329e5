// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>

#include "definitions.hpp"
#include "program.hpp"
#include "suggestion.hpp"

// `octavo help` and `octavo help VERB`: what --help prints.

namespace octavo::cli {
namespace {

std::vector<std::string> names_of(const CLI::App& app) {
    std::vector<std::string> names;
    for (const VerbDefinition& verb : definitions_of(app)) names.push_back(verb.name);
    return names;
}

Result<ExitCode> help(Session& session, const CLI::App& app, const std::string& name) {
    const std::vector<const CLI::App*> verbs =
        app.get_subcommands([&](const CLI::App* verb) { return verb->get_name() == name; });
    if (!name.empty() && verbs.empty()) {
        const std::string meant = nearest_word(name, names_of(app));
        return session.usage_error("there is no verb " + name +
                                   (meant.empty() ? "" : "; did you mean " + meant + "?"));
    }
    session.text = verbs.empty()
                       ? app.get_formatter()->make_help(&app, app.get_name(), CLI::AppFormatMode::Normal)
                       : verbs.front()->help(app.get_name());
    session.result = {{"help", session.text}};
    return ExitCode::ok;
}

}  // namespace

void add_help(Program& program) {
    const auto name = std::make_shared<std::string>();
    Verb* verb =
        program.verb("help", "Setting up", "Print what --help prints, for all verbs or for one",
                     [&program, name](Session& session) { return help(session, program.app(), *name); });
    std::string words;
    for (const std::string& word : names_of(program.app())) words += (words.empty() ? "" : "|") + word;
    verb->add_option("VERB", *name, "The verb; all when it is left out")->type_name(words);
}

}  // namespace octavo::cli
