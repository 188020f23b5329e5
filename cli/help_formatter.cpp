// SPDX-License-Identifier: Apache-2.0
#include "help_formatter.hpp"

#include "definitions.hpp"

namespace octavo::cli {

HelpFormatter::HelpFormatter() {
    column_width(34);
    label("SUBCOMMAND", "VERB");
}

std::string HelpFormatter::make_usage(const CLI::App* app, std::string name) const {
    if (!app->get_parent()) return "Usage: " + name + " VERB [options]\n";
    std::string positionals, required;
    for (const CLI::Option* option : app->get_options()) {
        const OptionDefinition one = definition_of(*option);
        if (one.names.empty())
            positionals += (one.required ? " " : " [") + one.positional + (one.repeats ? " ..." : "") +
                           (one.required ? "" : "]");
        else if (one.required)
            required += " " + one.names.back() + " " + one.value;
    }
    return "Usage: " + name + positionals + required + " [options]\n";
}

std::string HelpFormatter::make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const {
    std::string text = CLI::Formatter::make_help(app, name, mode);
    for (std::size_t at; (at = text.find("\n\n\n")) != std::string::npos;) text.erase(at, 1);
    return text;
}

std::string HelpFormatter::make_option_opts(const CLI::Option* option) const {
    const OptionDefinition one = definition_of(*option);
    if (one.names.empty()) return one.repeats ? " ..." : "";
    return one.value.empty() ? "" : " " + one.value;
}

std::string HelpFormatter::make_option_desc(const CLI::Option* option) const {
    return definition_of(*option).description;
}

}  // namespace octavo::cli
