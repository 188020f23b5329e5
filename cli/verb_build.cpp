// SPDX-License-Identifier: Apache-2.0

#include <fmt/format.h>

#include <octavo/bp_octree/build.hpp>
#include <octavo/bp_octree/certify.hpp>

#include "bp_octree_facts.hpp"
#include "model.hpp"
#include "option_checks.hpp"
#include "program.hpp"

// `octavo build FILE -o OUT.bpo`: the BP-octree of a solid, nested convex envelopes from coarse to fine.

namespace octavo::cli {
namespace {

struct BuildOptions {
    std::string input, output, format, quality = "normal", planes = "greedy", coalesce = "count";
    int depth = 9, leaf_triangles = 50;
    double gain = 1e-3, part = 0.01, leaf_mean = 20;
    bool certify = false;
};

bp_octree::BuildOptions building(const BuildOptions& options) {
    bp_octree::BuildOptions building;
    building.depth = options.depth;
    using bp_octree::Coalescing;
    building.coalescing = options.coalesce == "sum"    ? Coalescing::sum
                          : options.coalesce == "mean" ? Coalescing::mean
                          : options.coalesce == "none" ? Coalescing::none
                                                       : Coalescing::count;
    building.least_mean = options.leaf_mean;
    building.leaf_triangles = static_cast<std::size_t>(options.leaf_triangles);
    building.quality = options.quality == "fast" ? bp_octree::Quality::fast : bp_octree::Quality::normal;
    building.planes =
        options.planes == "k-medoids" ? bp_octree::PlaneChoice::k_medoids : bp_octree::PlaneChoice::greedy;
    building.least_gain = options.gain;
    building.k_medoids.part = options.part;
    return building;
}

Result<ExitCode> build(Session& session, const BuildOptions& options) {
    const Context context = session.context();
    static const OutputFormats formats{"BP-octrees", {"bpo"}, "bpo"};
    const Result<std::string> format = settle_output(session, {options.input}, options.output, "", formats);
    if (!format) return format.error();
    const Result<OnLattice> surface = read_on_lattice(session, context, options.input, options.format);
    if (!surface) return surface.error();
    Result<bp_octree::BpOctree> tree =
        session.timed("build", [&] { return bp_octree::build(surface->mesh, building(options), context); });
    if (!tree) return in_file(std::move(tree).error(), options.input);
    if (!tree->is_solid)
        session.warn("the surface is open; it is enveloped as a surface, and nothing counts as inside");
    if (options.certify) {
        Status proved = session.timed("certify", [&] { return bp_octree::certify(*tree, context); });
        // What `build` makes is right by construction; anything else is a defect of Octavo.
        if (!proved)
            return Error{
                proved.error().code == ErrorCode::cancelled ? ErrorCode::cancelled : ErrorCode::internal,
                proved.error().sentence,
                {}};
    }
    const std::vector<std::uint8_t> bytes = session.timed("encode", [&] { return bp_octree::encode(*tree); });
    if (context.cancelled()) return Context::cancelled_error();
    if (!options.output.empty()) {
        session.stdout_taken = options.output == "-";
        Result<io::WriteReport> written =
            session.timed("write", [&] { return bp_octree::write_bpo(options.output, bytes, context); });
        if (!written) return std::move(written).error();
    }
    const BpOctreeFacts facts = facts_of(*tree, bytes);
    session.result = json_of(facts);
    session.result["largest_displacement"] = surface->largest_displacement;
    if (options.certify) session.result["certified"] = true;
    session.text = text_of(facts) + rounding_text(surface->largest_displacement);
    if (options.certify) session.text += "certified  every colour, winding number and plane\n";
    return ExitCode::ok;
}

}  // namespace

void add_build(Program& program) {
    const auto options = std::make_shared<BuildOptions>();
    Verb* verb = program.verb("build", "Trees", "Build the BP-octree of a solid: nested convex envelopes",
                              [options](Session& session) { return build(session, *options); });
    verb->add_option("FILE", options->input, "A mesh (- is stdin), or a CSG tree (.csg): its polyhedron")
        ->required()
        ->type_name("FILE");
    verb->add_option("-o,--output", options->output, "The BP-octree to write: bpo; - is stdout")
        ->type_name("FILE");
    verb->add_option("--depth", options->depth, "The deepest level, 0 to 18")
        ->check(whole_number(0, bp_octree::max_depth))
        ->type_name("N")
        ->capture_default_str();
    verb->add_option("--leaf-triangles", options->leaf_triangles,
                     "Cells with at most this many triangles are not split; for --coalesce sum, siblings")
        ->check(whole_number(1, 1000000))
        ->type_name("N")
        ->capture_default_str();
    take_one_of(
        verb->add_option("--coalesce", options->coalesce,
                         "What makes cells leaves above --depth: their number of triangles, the sum over "
                         "siblings or their mean, or nothing"),
        {"count", "sum", "mean", "none"});
    verb->add_option("--leaf-mean", options->leaf_mean,
                     "For --coalesce mean: siblings are joined until they have so many triangles on average")
        ->check(check_positive)
        ->type_name("N")
        ->capture_default_str();
    take_one_of(
        verb->add_option("--quality", options->quality, "fast tries fewer directions: looser envelopes"),
        {"normal", "fast"});
    verb->add_option("--gain", options->gain, "Planes must cut more than this part of their cell")
        ->check(check_part)
        ->type_name("PART")
        ->capture_default_str();
    take_one_of(
        verb->add_option(
            "--planes", options->planes,
            "greedy: by the volume they cut; k-medoids: by normals, as in the thesis, for comparison"),
        {"greedy", "k-medoids"});
    verb->add_option("--part", options->part, "For k-medoids: planes of level 0 as a part of the triangles")
        ->check(check_part)
        ->type_name("PART")
        ->capture_default_str();
    verb->add_flag("--certify", options->certify, "Prove the tree again from its triangles");
    add_from_option(verb, options->format, "FILE");
}

}  // namespace octavo::cli
