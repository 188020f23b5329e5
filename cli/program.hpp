// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include <CLI/CLI.hpp>

#include "session.hpp"

// The command line as one tree of definitions: parsing, --help, the man page and shell completion are all made from
// it. Each verb is one file `verb_NAME.cpp` that adds itself with `Program::verb`.

namespace octavo::cli {

class Program {
  public:
    Program();

    using Run = std::function<Result<ExitCode>(Session&)>;

    /// Adds a verb; options go to the returned App. `run` is called once the command line is parsed.
    CLI::App* verb(const std::string& name, const std::string& group, const std::string& summary, Run run);

    const CLI::App& app() const { return app_; }

    /// Parses, runs the chosen verb and returns the exit code.
    int main(int argc, const char* const* argv);

  private:
    void add_common_options(CLI::App* verb);

    CLI::App app_;
    Session session_;
    Run chosen_;
};

void add_info(Program& program);
void add_check(Program& program);
void add_repair(Program& program);
void add_convert(Program& program);
void add_octree(Program& program);
void add_build(Program& program);
void add_bsp(Program& program);
void add_stats(Program& program);
void add_contains(Program& program);
void add_distance(Program& program);
void add_render(Program& program);
void add_shape(Program& program);
void add_boolean(Program& program);
void add_eval(Program& program);
void add_hexmesh(Program& program);
void add_mill(Program& program);
void add_completion(Program& program);
void add_man(Program& program);

}  // namespace octavo::cli
