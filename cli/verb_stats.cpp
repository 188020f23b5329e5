// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <octavo/base/counted.hpp>
#include <octavo/bp_octree/certify.hpp>
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
    bool certify = false;
};

/// What of a file is there, when it is not all.
void tell_of_arrived(Session& session, const bp_octree::BpoReader& reader) {
    const bp_octree::BpoArrived arrived = reader.arrived();
    session.result["arrived"] = {{"bytes", arrived.bytes},
                                 {"levels", arrived.levels},
                                 {"leaves", arrived.leaves},
                                 {"triangles", arrived.triangles}};
    if (!reader.is_partial()) return;
    session.warn(fmt::format("the file ends early; {} of {} levels and {} of {} triangles are there",
                             arrived.levels, reader.levels().size(), grouped(arrived.triangles),
                             grouped(reader.head().triangles)));
    session.text += fmt::format("there      {} bytes: {}, {}, {}\n", grouped(arrived.bytes),
                                counted(static_cast<std::uint64_t>(arrived.levels), "level", "levels"),
                                counted(arrived.leaves, "leaf", "leaves"),
                                counted(arrived.triangles, "triangle", "triangles"));
}

/// By head and index alone, unless the file shall be proved.
Result<ExitCode> bp_octree_stats(Session& session, const Context& context, const StatsOptions& options) {
    session.inputs.push_back(options.input);
    Result<bp_octree::BpoReader> reader =
        session.timed("read", [&] { return bp_octree::open_bpo(options.input, context); });
    if (!reader) return std::move(reader).error();
    session.result = json_of(facts_of(*reader));
    session.text = text_of(facts_of(*reader));
    tell_of_arrived(session, *reader);
    if (options.certify) {
        const Result<bp_octree::BpOctree> tree =
            session.timed("decode", [&] { return reader->read_all(context); });
        if (!tree) return in_file(tree.error(), options.input);
        const Status proved = session.timed("certify", [&] { return bp_octree::certify(*tree, context); });
        if (!proved) return in_file(proved.error(), options.input);
        session.result["certified"] = true;
        session.text += "certified  every colour, winding number and plane\n";
    }
    session.result["bytes_read"] = reader->bytes_read();
    if (!options.certify)
        session.text += fmt::format("read       {} bytes: head and index\n", grouped(reader->bytes_read()));
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
    if (kind == ModelKind::bp_octree) return bp_octree_stats(session, context, options);
    if (options.certify)
        return session.usage_error("--certify is for BP-octrees (.bpo), and " + options.input + " is none");
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
    verb->add_flag("--certify", options->certify,
                   "For .bpo: read all of it instead of head and index, and prove it from its triangles");
    add_from_option(verb, options->format, "FILE", {"oct", "bpo", "bso"});
}

}  // namespace octavo::cli
