// SPDX-License-Identifier: Apache-2.0
#include "definitions.hpp"

#include <sstream>

#include <CLI/CLI.hpp>

namespace octavo::cli {
namespace {

/// A validator of CLI11 adds words of its own after a colon, such as ":INT in [0 - 9]"; the placeholder ends there.
std::string placeholder_in(const std::string& type_name) {
    const std::size_t colon = type_name.find(':');
    return type_name.find_first_of(" {", colon) == std::string::npos ? type_name : type_name.substr(0, colon);
}

/// "reject|winding" as two words; nothing when there is no choice. "..." stands for what is too much to tell.
std::vector<std::string> choices_in(const std::string& value) {
    std::vector<std::string> choices;
    if (value.find('|') == std::string::npos) return choices;
    std::istringstream words(value);
    for (std::string word; std::getline(words, word, '|');)
        if (word != "...") choices.push_back(word);
    return choices;
}

std::string names_of(const std::set<CLI::Option*>& options) {
    std::string names;
    for (const CLI::Option* option : options) names += (names.empty() ? "" : ", ") + option->get_name();
    return names;
}

}  // namespace

OptionDefinition definition_of(const CLI::Option& option) {
    OptionDefinition definition;
    for (const std::string& name : option.get_lnames()) definition.names.push_back("--" + name);
    for (const std::string& name : option.get_snames()) definition.names.push_back("-" + name);
    if (option.get_positional()) definition.positional = option.get_name(true, false);
    if (option.get_items_expected_max() > 0) definition.value = placeholder_in(option.get_type_name());
    definition.choices = choices_in(definition.value);
    definition.description = option.get_description();
    std::string remarks;
    const auto remark = [&](const std::string& text) { remarks += (remarks.empty() ? "" : "; ") + text; };
    if (!option.get_default_str().empty()) remark("default " + option.get_default_str());
    if (!option.get_excludes().empty()) remark("not with " + names_of(option.get_excludes()));
    if (!option.get_needs().empty()) remark("only with " + names_of(option.get_needs()));
    if (!remarks.empty()) definition.description += " (" + remarks + ")";
    definition.required = option.get_required();
    definition.repeats = option.get_expected_max() >= CLI::detail::expected_max_vector_size;
    definition.common = option.get_group() == common_heading;
    return definition;
}

std::vector<OptionDefinition> common_definitions(const CLI::App& app) {
    std::vector<OptionDefinition> definitions;
    for (const CLI::Option* option : app.get_options())
        if (OptionDefinition one = definition_of(*option); one.common) definitions.push_back(std::move(one));
    return definitions;
}

std::vector<VerbDefinition> definitions_of(const CLI::App& app) {
    std::vector<VerbDefinition> verbs;
    for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; })) {
        VerbDefinition& definition = verbs.emplace_back();
        definition.name = verb->get_name();
        definition.group = verb->get_group();
        definition.summary = verb->get_description();
        for (const CLI::Option* option : verb->get_options()) {
            if (option->get_group().empty()) continue;
            OptionDefinition one = definition_of(*option);
            (one.names.empty() ? definition.positionals : definition.options).push_back(std::move(one));
        }
    }
    return verbs;
}

}  // namespace octavo::cli
