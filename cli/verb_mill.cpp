// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include <octavo/base/counted.hpp>
#include <octavo/bsp_octree/bso_file.hpp>
#include <octavo/bsp_octree/mill.hpp>
#include <octavo/bsp_octree/to_mesh.hpp>
#include <octavo/io/poses.hpp>

#include "bsp_octree_output.hpp"
#include "model.hpp"
#include "program.hpp"

// `octavo mill WORK --tool T --path poses.csv -o OUT`: thousands of exact subtractions of a tool, one after the other,
// each at the cost of what it touches.

namespace octavo::cli {
namespace {

struct MillArguments {
    std::string work, tool, path, output, format;
};

double quantile(std::vector<double> values, double part) {
    if (values.empty()) return 0;
    const auto at =
        std::min(values.size() - 1, static_cast<std::size_t>(part * static_cast<double>(values.size())));
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(at), values.end());
    return values[at];
}

void tell(Session& session, const bsp_octree::Milled& milled, const WrittenBspOctree& written,
          const mesh::Moments& measures, const std::string& output) {
    const bsp_octree::MillReport& report = milled.report;
    const double median = quantile(report.step_seconds, 0.5);
    session.result = {{"steps", report.steps},
                      {"volume", measures.volume},
                      {"seconds_per_step", median},
                      {"area", measures.area},
                      {"cutting_steps", report.cutting_steps},
                      {"slowest_step", quantile(report.step_seconds, 1)},
                      {"build_seconds", report.build_seconds},
                      {"collections", report.collections},
                      {"largest_displacement", report.largest_displacement},
                      {"bytes", milled.solid.store().bytes()}};
    std::string what = grouped(written.report.bytes) + " bytes";
    if (written.made) {
        session.result["triangles"] = written.made->mesh.triangles.size();
        session.result["largest_rounding"] = written.made->report.largest_rounding;
        session.result["inverted_facets"] = written.made->report.inverted_facets;
        what = counted(written.made->mesh.triangles.size(), "triangle", "triangles");
    }
    session.text = fmt::format("{}: {}, volume {:.10g}, after {}, {:.2f} ms each (median)\n", output, what,
                               measures.volume, counted(report.steps, "step", "steps"), 1e3 * median);
    session.warn(report.warnings);
    if (milled.solid.is_empty()) session.warn("nothing is left of the workpiece");
    if (report.cutting_steps == 0) session.warn("the tool takes nothing away from the workpiece");
}

/// What comes in a .bso file is milled as it is; anything else is rounded to a lattice first.
struct Workpiece {
    std::optional<bsp_octree::BspOctree> octree;
    mesh::Mesh mesh;
};

Result<Workpiece> read_workpiece(Session& session, const Context& context, const std::string& path) {
    if (kind_of(path, "") != ModelKind::bsp_octree) {
        Result<io::ReadMesh> read = read_operand(session, context, path);
        if (!read) return std::move(read).error();
        return Workpiece{std::nullopt, std::move(read->mesh)};
    }
    session.inputs.push_back(path);
    Result<bsp_octree::BspOctree> octree =
        session.timed("read", [&] { return bsp_octree::read_bso(path, context); });
    if (!octree) return std::move(octree).error();
    return Workpiece{std::move(*octree), {}};
}

Result<bsp_octree::Milled> mill_workpiece(Session& session, const Context& context, Workpiece work,
                                          const mesh::Mesh& tool, std::span<const Affine> poses) {
    if (work.octree && bsp_octree::has_room(*work.octree, tool, poses))
        return session.timed("mill",
                             [&] { return bsp_octree::mill(*work.octree, tool, poses, {}, context); });
    if (work.octree) {
        Result<bsp_octree::ToMesh> made =
            session.timed("mesh", [&] { return bsp_octree::to_mesh(*work.octree, context); });
        if (!made) {
            Error error = std::move(made).error();
            error.place.operand = 0;
            return error;
        }
        session.warn(
            "the tool reaches beyond the lattice of the workpiece, which was rounded to a larger one");
        work.mesh = std::move(made->mesh);
    }
    return session.timed("mill", [&] { return bsp_octree::mill(work.mesh, tool, poses, {}, context); });
}

Result<ExitCode> mill(Session& session, const MillArguments& arguments) {
    const Context context = session.context();
    const Result<std::string> format =
        settle_output(session, {arguments.work, arguments.tool, arguments.path}, arguments.output,
                      arguments.format, bsp_octree_outputs());
    if (!format) return format.error();
    Result<Workpiece> work = read_workpiece(session, context, arguments.work);
    if (!work) return std::move(work).error();
    Result<io::ReadMesh> tool = read_operand(session, context, arguments.tool);
    if (!tool) return std::move(tool).error();
    session.inputs.push_back(arguments.path);
    Result<std::vector<Affine>> poses =
        session.timed("read", [&] { return io::read_poses(arguments.path, context); });
    if (!poses) return std::move(poses).error();

    const Result<bsp_octree::Milled> milled =
        mill_workpiece(session, context, std::move(*work), tool->mesh, *poses);
    if (!milled) return in_its_file(milled.error(), {arguments.work, arguments.tool});
    const mesh::Moments measures =
        session.timed("measure", [&] { return bsp_octree::measure(milled->solid, context); });
    if (context.cancelled()) return Context::cancelled_error();
    const Result<WrittenBspOctree> written =
        write_bsp_octree(session, context, arguments.output, milled->solid, *format);
    if (!written) return written.error();
    tell(session, *milled, *written, measures, arguments.output);
    return ExitCode::ok;
}

}  // namespace

void add_mill(Program& program) {
    const auto arguments = std::make_shared<MillArguments>();
    Verb* verb = program.verb("mill", "Edit", "Subtract a tool at thousands of poses, exactly",
                              [arguments](Session& session) { return mill(session, *arguments); });
    verb->add_option("WORK", arguments->work,
                     "The workpiece: a closed mesh, a .csg tree, a .bso or .bpo octree")
        ->required()
        ->type_name("FILE");
    verb->add_option("--tool", arguments->tool, "The tool, likewise, about its own origin")
        ->required()
        ->type_name("FILE");
    verb->add_option(
            "--path", arguments->path,
            "Poses of the tool, one a line: x,y,z, or 12 numbers (3 rows of 4, row-major); - is stdin")
        ->required()
        ->type_name("FILE");
    verb->add_option(
            "-o,--output", arguments->output,
            "What to write, a BSP-octree or a mesh: " + one_of(bsp_octree_outputs().names) + "; - is stdout")
        ->required()
        ->type_name("FILE");
    add_to_option(verb, arguments->format, bsp_octree_outputs());
}

}  // namespace octavo::cli
