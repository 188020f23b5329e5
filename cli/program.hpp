// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <string>

#include "session.hpp"
#include "verb.hpp"

// The command line as one tree of definitions: parsing, --help, the man page and shell completion are all made from
// it. Each verb is one file `verb_NAME.cpp` that adds itself with `Program::verb`.

namespace octavo::cli {

class Program {
  public:
    Program();
    ~Program();

    using Run = std::function<Result<ExitCode>(Session&)>;

    /// Adds a verb; options go to what is returned. `run` is called once the command line is parsed.
    Verb* verb(const std::string& name, const std::string& group, const std::string& summary, Run run);

    const CLI::App& app() const { return *app_; }
    /// What is said below the help of all verbs: formats and exit codes.
    std::string notes() const;

    /// Parses, runs the chosen verb and returns the exit code.
    int main(int argc, const char* const* argv);

  private:
    /// To a verb, or to the program itself: they stand before the verb or after it.
    void add_common_options(Verb& verb);

    std::unique_ptr<CLI::App> app_;
    std::deque<Verb> verbs_;
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
void add_help(Program& program);
void add_completion(Program& program);
void add_man(Program& program);

}  // namespace octavo::cli
