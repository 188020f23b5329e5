// SPDX-License-Identifier: Apache-2.0
#include "octree_facts.hpp"
#include "program.hpp"
#include <octavo/io/oct.hpp>
#include <octavo/octree/oct_format.hpp>

// `octavo stats FILE.oct`: what is inside a file that Octavo built.

namespace octavo::cli {
namespace {

Result<ExitCode> stats(Session& session, const std::string& input) {
    const Context context = session.context();
    session.inputs.push_back(input);
    Result<octree::Octree> tree = session.timed("read", [&] { return io::read_octree(input, context); });
    if (!tree) return std::move(tree).error();
    const std::size_t bytes = octree::encode(*tree).size();
    session.result = json_of(*tree, bytes);
    session.text = text_of(*tree, bytes);
    return ExitCode::ok;
}

}  // namespace

void add_stats(Program& program) {
    const auto input = std::make_shared<std::string>();
    CLI::App* verb = program.verb("stats", "Trees", "Tell what is inside an octree file",
                                  [input](Session& session) { return stats(session, *input); });
    verb->add_option("FILE", *input, "An octree (.oct); - is stdin")->required()->type_name("FILE");
}

}  // namespace octavo::cli
