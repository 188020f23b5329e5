// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <octavo/base/counted.hpp>
#include <octavo/classic/csg_build.hpp>
#include <octavo/classic/from_mesh.hpp>
#include <octavo/octree/oct_format.hpp>

#include "model.hpp"
#include "octree_facts.hpp"
#include "option_checks.hpp"
#include "program.hpp"

// `octavo octree FILE -o OUT.oct`: the exact octree of a solid. The output's extension decides the form: .oct is
// Octavo's own, .vtu and .htg are for ParaView.

namespace octavo::cli {
namespace {

struct OctreeOptions {
    std::string input, output, format, to, open = "reject", method = "top-down", max_nodes = "2G";
    int depth = 8;
    double precision = 0;
    bool faceted = false, skip_unsupported = false;
};

/// A tree and the figures of how it was built, from whatever it was built.
struct Grown {
    octree::Octree octree;
    std::uint64_t peak_nodes = 0, primitive_tests = 0;
    double largest_displacement = 0;  ///< how far rounding to the lattice moved a vertex of a mesh at most
};

/// The least depth whose cells are no larger than `precision`, in world units.
Result<int> depth_for(double precision, const exact::Lattice& lattice) {
    for (int depth = 0; depth <= octree::max_level; ++depth)
        if (std::ldexp(1.0, lattice.exponent() + exact::coordinate_bits - depth) <= precision) return depth;
    return Error{ErrorCode::limit,
                 fmt::format("--precision {} is finer than the octree's last level, {}", precision,
                             number_text(std::ldexp(
                                 1.0, lattice.exponent() + exact::coordinate_bits - octree::max_level))),
                 {}};
}

void warn_about(Session& session, const classic::BuildReport& report) {
    if (report.facets_without_area)
        session.warn(
            counted(report.facets_without_area, "facet without area was", "facets without area were") +
            " left out");
}

Result<Grown> grow_from_mesh(Session& session, const Context& context, const OctreeOptions& options) {
    Result<io::ReadMesh> read = read_mesh(session, context, options.input, options.format);
    if (!read) return std::move(read).error();
    Result<mesh::Snapped> snapped = snap(session, read->mesh);
    if (!snapped) return in_file(std::move(snapped).error(), options.input);
    classic::BuildOptions building;
    building.depth = options.depth;
    building.max_nodes = *parse_count(options.max_nodes);
    building.open = options.open == "winding" ? classic::OpenPolicy::winding : classic::OpenPolicy::reject;
    if (building.open == classic::OpenPolicy::winding) warn_of_closing(session, snapped->mesh);
    if (options.precision > 0) {
        Result<int> depth = depth_for(options.precision, snapped->mesh.lattice);
        if (!depth) return std::move(depth).error();
        building.depth = *depth;
    }
    Result<classic::Built> built =
        session.timed("build", [&] { return classic::build(snapped->mesh, building, context); });
    if (!built) return in_file(std::move(built).error(), options.input);
    warn_about(session, built->report);
    return Grown{std::move(built->octree), built->report.peak_nodes, built->report.primitive_tests,
                 snapped->report.largest_displacement};
}

Result<Grown> grow_from_csg(Session& session, const Context& context, const OctreeOptions& options) {
    Result<io::CsgFile> file =
        read_csg(session, context, options.input,
                 {.faceted = options.faceted, .skip_unsupported = options.skip_unsupported});
    if (!file) return std::move(file).error();
    classic::CsgBuildOptions building;
    building.depth = options.depth;
    building.precision = options.precision;
    building.max_nodes = *parse_count(options.max_nodes);
    building.method =
        options.method == "classic" ? classic::CsgMethod::classic : classic::CsgMethod::top_down;
    Result<classic::CsgOctree> built =
        session.timed("build", [&] { return classic::build(file->expression, building, context); });
    if (!built) return in_file(std::move(built).error(), options.input);
    return Grown{std::move(built->octree), built->stats.peak_nodes, built->stats.primitive_tests, 0};
}

/// Options that the model has no use for.
Status check_use(Session& session, const OctreeOptions& options) {
    const bool is_csg = kind_of(options.input, options.format) == ModelKind::csg;
    const auto useless = [&](const char* option, const char* models) {
        return session.usage_error(
            fmt::format("{} is for {}, and {} is none", option, models, options.input));
    };
    if (!is_csg && options.method != "top-down") return useless("--method", "CSG trees (.csg)");
    if (!is_csg && options.faceted) return useless("--faceted", "CSG trees (.csg)");
    if (!is_csg && options.skip_unsupported) return useless("--skip-unsupported", "CSG trees (.csg)");
    if (is_csg && options.open != "reject") return useless("--open", "meshes");
    return Done{};
}

Result<ExitCode> make_octree(Session& session, const OctreeOptions& options) {
    const Context context = session.context();
    const Result<std::string> format =
        settle_output(session, {options.input}, options.output, options.to, octree_outputs());
    if (!format) return format.error();
    if (const Status useful = check_use(session, options); !useful) return useful.error();
    Result<Grown> built = kind_of(options.input, options.format) == ModelKind::csg
                              ? grow_from_csg(session, context, options)
                              : grow_from_mesh(session, context, options);
    if (!built) return std::move(built).error();
    TreeFile file{"oct", 0};
    if (options.output.empty()) {
        file.bytes = octree::encode(built->octree).size();
    } else {
        Result<io::WriteReport> written =
            write_octree(session, context, options.output, built->octree, *format);
        if (!written) return std::move(written).error();
        file = {*format, written->bytes};
    }
    session.result = json_of(built->octree, file);
    session.result["peak_nodes"] = built->peak_nodes;
    session.result["primitive_tests"] = built->primitive_tests;
    session.result["largest_displacement"] = built->largest_displacement;
    session.text = text_of(built->octree, file);
    session.text += rounding_text(built->largest_displacement);
    return ExitCode::ok;
}

}  // namespace

void add_octree(Program& program) {
    const auto options = std::make_shared<OctreeOptions>();
    Verb* verb = program.verb("octree", "Trees", "Build the exact octree of a solid",
                              [options](Session& session) { return make_octree(session, *options); });
    verb->add_option("FILE", options->input, "A closed mesh, or a CSG tree (.csg of OpenSCAD); - is stdin")
        ->required()
        ->type_name("FILE");
    verb->add_option("-o,--output", options->output,
                     "The octree to write: oct, or vtu or htg for ParaView; - is stdout")
        ->type_name("FILE");
    Option* depth = verb->add_option("--depth", options->depth, "The deepest level, 0 to 21")
                        ->check(whole_number(0, octree::max_level))
                        ->type_name("N")
                        ->capture_default_str();
    verb->add_option("-p,--precision", options->precision, "Cells no larger than this, in the model's units")
        ->check(check_positive)
        ->type_name("LENGTH")
        ->excludes(depth);
    verb->add_option("--max-nodes", options->max_nodes,
                     "Give up beyond so many nodes: a count such as 500K, 20M or 2G, a quarter byte each")
        ->check(check_count)
        ->type_name("N")
        ->capture_default_str();
    take_one_of(verb->add_option("--open", options->open,
                                 "An open surface: reject it, or close it and go by winding"),
                {"reject", "winding"});
    take_one_of(verb->add_option("--method", options->method,
                                 "For .csg: top-down, or classic (an octree for each primitive)"),
                {"top-down", "classic"});
    verb->add_flag("--faceted", options->faceted,
                   "For .csg: round things are the polyhedra that OpenSCAD makes");
    verb->add_flag("--skip-unsupported", options->skip_unsupported,
                   "For .csg: leave out text and the like, with warnings");
    add_from_option(verb, options->format, "FILE");
    take_one_of(verb->add_option("--to", options->to, "Format of the output, instead of by its extension"),
                octree_outputs().names);
}

}  // namespace octavo::cli
