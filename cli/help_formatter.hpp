// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <CLI/CLI.hpp>

// How --help looks: what must be given stands in the usage line, each option with its placeholder and its default.

namespace octavo::cli {

class HelpFormatter : public CLI::Formatter {
  public:
    HelpFormatter();

    std::string make_usage(const CLI::App* app, std::string name) const override;
    /// With one empty line between groups; CLI11 leaves two.
    std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
    std::string make_option_opts(const CLI::Option* option) const override;
    std::string make_option_desc(const CLI::Option* option) const override;
};

}  // namespace octavo::cli
