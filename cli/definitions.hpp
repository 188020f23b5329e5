// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

// The command line's definitions as plain data, for whatever is generated from them: help, man page, shell completion.

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace octavo::cli {

/// The heading of the options that every verb has.
inline constexpr const char* common_heading = "Common options";

struct OptionDefinition {
    std::vector<std::string> names;    ///< with dashes, long ones first; empty for a positional
    std::string positional;            ///< its name, for a positional
    std::string value;                 ///< placeholder of its value; empty for a flag
    std::vector<std::string> choices;  ///< the values that it takes, where they are few words
    std::string description;           ///< with its default and the options that it excludes or needs
    bool required = false;
    bool repeats = false;  ///< takes several values
    bool common = false;   ///< every verb has it
};

struct VerbDefinition {
    std::string name, group, summary;
    std::vector<OptionDefinition> positionals, options;
};

OptionDefinition definition_of(const CLI::Option& option);

/// The options that stand before the verb or after it. Old names of options, which have no heading, are left out here
/// and below.
std::vector<OptionDefinition> common_definitions(const CLI::App& app);

/// Every verb, in the order in which it was added.
std::vector<VerbDefinition> definitions_of(const CLI::App& app);

}  // namespace octavo::cli
