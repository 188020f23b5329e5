// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "model.hpp"
#include "octree_facts.hpp"
#include "option_checks.hpp"
#include "program.hpp"
#include <octavo/classic/csg_build.hpp>
#include <octavo/classic/from_mesh.hpp>
#include <octavo/io/hyper_tree_grid.hpp>
#include <octavo/io/oct.hpp>
#include <octavo/io/openscad_csg.hpp>
#include <octavo/io/vtu.hpp>
#include <octavo/octree/oct_format.hpp>

// `octavo octree FILE -o OUT.oct`: the exact octree of a solid. The output's extension decides the form: .oct is
// Octavo's own, .vtu and .htg are for ParaView.

namespace octavo::cli {
namespace {

struct OctreeOptions {
    std::string input, output, format, open = "reject", method = "top-down";
    int depth = 8;
    double precision = 0;
    bool faceted = false, skip_unsupported = false;
};

/// A tree and the figures of how it was built, from whatever it was built.
struct Grown {
    octree::Octree octree;
    std::uint64_t peak_nodes = 0, primitive_tests = 0;
    double snap_displacement = 0;  ///< how far rounding to the lattice moved a vertex of a mesh at most
};

/// The least depth whose cells are no larger than `precision`, in world units.
Result<int> depth_for(double precision, const exact::Lattice& lattice) {
    for (int depth = 0; depth <= octree::max_level; ++depth)
        if (std::ldexp(1.0, lattice.exponent() + exact::coordinate_bits - depth) <= precision) return depth;
    return Error{
        ErrorCode::limit,
        fmt::format("a precision of {:.6g} is finer than the octree's last level, {:.6g}", precision,
                    std::ldexp(1.0, lattice.exponent() + exact::coordinate_bits - octree::max_level)),
        {}};
}

void warn_about(Session& session, const classic::BuildReport& report) {
    if (report.facets_without_area)
        session.warn(fmt::format("{} facets without area were left out", report.facets_without_area));
    if (report.closing_facets)
        session.warn(
            fmt::format("the surface is open; {} facets were added to close it", report.closing_facets));
}

Result<Grown> grow_from_mesh(Session& session, const Context& context, const OctreeOptions& options) {
    Result<io::ReadMesh> read = read_mesh(session, context, options.input, options.format);
    if (!read) return std::move(read).error();
    Result<mesh::Snapped> snapped = snap(session, read->mesh);
    if (!snapped) return in_file(std::move(snapped).error(), options.input);
    classic::BuildOptions building;
    building.depth = options.depth;
    building.open = options.open == "winding" ? classic::OpenPolicy::winding : classic::OpenPolicy::reject;
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
    session.inputs.push_back(options.input);
    const io::CsgReadOptions reading{.faceted = options.faceted,
                                     .skip_unsupported = options.skip_unsupported};
    Result<io::CsgFile> file =
        session.timed("read", [&] { return io::read_csg(options.input, reading, context); });
    if (!file) return std::move(file).error();
    session.warn(file->warnings);
    classic::CsgBuildOptions building;
    building.depth = options.depth;
    building.precision = options.precision;
    building.method =
        options.method == "classic" ? classic::CsgMethod::classic : classic::CsgMethod::top_down;
    Result<classic::CsgOctree> built =
        session.timed("build", [&] { return classic::build(file->expression, building, context); });
    if (!built) return in_file(std::move(built).error(), options.input);
    return Grown{std::move(built->octree), built->stats.peak_nodes, built->stats.primitive_tests, 0};
}

/// Writes the tree in the form that the extension of `path` asks for.
Result<io::WriteReport> write_tree(const octree::Octree& tree, const std::string& path,
                                   const Context& context) {
    const std::string extension = std::filesystem::path(path).extension().string();
    if (extension == ".htg") return io::write_hyper_tree_grid(path, tree, {}, context);
    if (extension == ".vtu") return io::write_vtu(path, tree, {}, context);
    if (extension == ".oct" || path == "-") return io::write_octree(path, tree, context);
    return Error{
        ErrorCode::unsupported, "octrees are written as .oct, .vtu or .htg, and the output is " + path, {}};
}

Result<ExitCode> make_octree(Session& session, const OctreeOptions& options) {
    const Context context = session.context();
    if (same_file(options.input, options.output)) return would_overwrite(options.output);
    Result<Grown> built = kind_of(options.input, options.format) == ModelKind::csg
                              ? grow_from_csg(session, context, options)
                              : grow_from_mesh(session, context, options);
    if (!built) return std::move(built).error();
    if (!options.output.empty()) {
        session.stdout_taken = options.output == "-";
        Result<io::WriteReport> written =
            session.timed("write", [&] { return write_tree(built->octree, options.output, context); });
        if (!written) return std::move(written).error();
        session.warn(written->warnings);
    }
    const std::size_t bytes = octree::encode(built->octree).size();
    session.result = json_of(built->octree, bytes);
    session.result["peak_nodes"] = built->peak_nodes;
    session.result["primitive_tests"] = built->primitive_tests;
    session.result["snap_displacement"] = built->snap_displacement;
    session.text = text_of(built->octree, bytes);
    if (built->snap_displacement > 0)
        session.text += fmt::format("rounding   moved vertices to the lattice by at most {:.3g}\n",
                                    built->snap_displacement);
    return ExitCode::ok;
}

}  // namespace

void add_octree(Program& program) {
    const auto options = std::make_shared<OctreeOptions>();
    CLI::App* verb = program.verb("octree", "Trees", "Build the exact octree of a solid",
                                  [options](Session& session) { return make_octree(session, *options); });
    verb->add_option("FILE", options->input, "A closed mesh, or an OpenSCAD tree (.csg); - is stdin")
        ->required()
        ->type_name("FILE");
    verb->add_option("-o,--output", options->output,
                     "The octree to write: .oct, or .vtu or .htg for ParaView")
        ->type_name("FILE");
    CLI::Option* depth =
        verb->add_option("--depth", options->depth, "The deepest level, 0 to 21; 8 by default")
            ->check(CLI::Range(0, octree::max_level))
            ->type_name("N");
    verb->add_option("--precision", options->precision, "Cells no larger than this, in the model's units")
        ->check(check_positive)
        ->type_name("LENGTH")
        ->excludes(depth);
    verb->add_option("--open", options->open, "An open surface: reject it, or close it and go by winding")
        ->check(CLI::IsMember({"reject", "winding"}))
        ->type_name("POLICY");
    verb->add_option("--method", options->method,
                     "For .csg: top-down, or classic (an octree for each primitive)")
        ->check(CLI::IsMember({"top-down", "classic"}))
        ->type_name("METHOD");
    verb->add_flag("--faceted", options->faceted,
                   "For .csg: round things are the polyhedra that OpenSCAD makes");
    verb->add_flag("--skip-unsupported", options->skip_unsupported,
                   "For .csg: leave out text and the like, with warnings");
    verb->add_option("--format", options->format, "Format of FILE, instead of by its extension")
        ->type_name("FORMAT");
}

}  // namespace octavo::cli
