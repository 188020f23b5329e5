// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

// The command line's definitions as plain data, for whatever is generated from them: man page, shell completion.

namespace octavo::cli {

struct OptionDefinition {
    std::vector<std::string> names;  ///< with dashes, long ones first; empty for a positional
    std::string positional;          ///< its name, for a positional
    std::string value;               ///< placeholder of its value; empty for a flag
    std::string description;
    bool required = false;
};

struct VerbDefinition {
    std::string name, group, summary;
    std::vector<OptionDefinition> positionals, options;
};

/// Every verb, in the order in which it was added.
std::vector<VerbDefinition> definitions_of(const CLI::App& app);

}  // namespace octavo::cli
