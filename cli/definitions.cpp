// SPDX-License-Identifier: Apache-2.0
#include "definitions.hpp"

namespace octavo::cli {
namespace {

OptionDefinition definition_of(const CLI::Option& option) {
    OptionDefinition definition;
    for (const std::string& name : option.get_lnames()) definition.names.push_back("--" + name);
    for (const std::string& name : option.get_snames()) definition.names.push_back("-" + name);
    if (option.get_positional()) definition.positional = option.get_name(true, false);
    // A validator adds its own words after a colon; the placeholder ends there.
    if (option.get_items_expected_max() > 0)
        definition.value = option.get_type_name().substr(0, option.get_type_name().find(':'));
    definition.description = option.get_description();
    definition.required = option.get_required();
    return definition;
}

}  // namespace

std::vector<VerbDefinition> definitions_of(const CLI::App& app) {
    std::vector<VerbDefinition> verbs;
    for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; })) {
        VerbDefinition& definition = verbs.emplace_back();
        definition.name = verb->get_name();
        definition.group = verb->get_group();
        definition.summary = verb->get_description();
        for (const CLI::Option* option : verb->get_options()) {
            OptionDefinition one = definition_of(*option);
            (one.names.empty() ? definition.positionals : definition.options).push_back(std::move(one));
        }
    }
    return verbs;
}

}  // namespace octavo::cli
