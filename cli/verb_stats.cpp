// SPDX-License-Identifier: Apache-2.0
#include <octavo/bsp_octree/bso_file.hpp>
#include <octavo/bsp_octree/bso_format.hpp>
#include <octavo/octree/oct_format.hpp>

#include "bp_octree_facts.hpp"
#include "bsp_octree_facts.hpp"
#include "model.hpp"
#include "octree_facts.hpp"
#include "program.hpp"

// `octavo stats FILE`: what is inside a file that Octavo built (.oct, .bpo, .bso).

namespace octavo::cli {
namespace {

struct StatsOptions {
    std::string input, format;
};

Result<ExitCode> bp_octree_stats(Session& session, const Context& context, const std::string& input) {
    bp_octree::ReadBpoOptions reading;
    reading.partial = bp_octree::ReadBpoOptions::Partial::accept;
    Result<bp_octree::ReadBpo> file = read_bp_octree(session, context, input, reading);
    if (!file) return std::move(file).error();
    session.result = json_of(file->tree, file->bytes_to_level, file->bytes);
    session.text = text_of(file->tree, file->bytes_to_level, file->bytes);
    return ExitCode::ok;
}

Result<ExitCode> bsp_octree_stats(Session& session, const Context& context, const std::string& input) {
    session.inputs.push_back(input);
    Result<bsp_octree::BspOctree> tree =
        session.timed("read", [&] { return bsp_octree::read_bso(input, context); });
    if (!tree) return std::move(tree).error();
    tell(session, *tree, bsp_octree::encode(*tree).size());
    return ExitCode::ok;
}

Result<ExitCode> stats(Session& session, const StatsOptions& options) {
    const Context context = session.context();
    const ModelKind kind = kind_of(options.input, options.format);
    if (kind == ModelKind::bp_octree) return bp_octree_stats(session, context, options.input);
    if (kind == ModelKind::bsp_octree) return bsp_octree_stats(session, context, options.input);
    Result<octree::Octree> tree = read_octree(session, context, options.input, options.format);
    if (!tree) return std::move(tree).error();
    const TreeFile file{"oct", octree::encode(*tree).size()};
    session.result = json_of(*tree, file);
    session.text = text_of(*tree, file);
    return ExitCode::ok;
}

}  // namespace

void add_stats(Program& program) {
    const auto options = std::make_shared<StatsOptions>();
    Verb* verb = program.verb("stats", "Trees", "Tell what is inside an octree file",
                              [options](Session& session) { return stats(session, *options); });
    verb->add_option("FILE", options->input,
                     "An octree (.oct), a BP-octree (.bpo) or a BSP-octree (.bso); - is stdin")
        ->required()
        ->type_name("FILE");
    add_from_option(verb, options->format, "FILE", {"oct", "bpo", "bso"});
}

}  // namespace octavo::cli
