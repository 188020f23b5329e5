// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include <octavo/hexmesh/build.hpp>
#include <octavo/hexmesh/conforming.hpp>
#include <octavo/hexmesh/fit.hpp>
#include <octavo/mesh/material_names.hpp>
#include <octavo/render/hex_mesh_picture.hpp>
#include <octavo/render/png.hpp>

#include "cell_values.hpp"
#include "hexmesh_body.hpp"
#include "hexmesh_facts.hpp"
#include "hexmesh_files.hpp"
#include "hexmesh_sizes.hpp"
#include "hexmesh_solids.hpp"
#include "model.hpp"
#include "option_checks.hpp"
#include "program.hpp"

// `octavo hexmesh FILE… -o OUT`: solids → a balanced mesh of hexahedra in the files of solvers and viewers.

namespace octavo::cli {
namespace {

struct HexmeshOptions {
    std::vector<std::string> inputs, sizes, boxes;
    std::string output, to, balance = "edge", open = "reject", overlaps = "unite", curvature, keep, picture,
                            values, max_cells = "100M";
    int level = 7, layers = -1;
    double precision = 0, largest = 0, proximity = 0;
    bool conforming = false, fit = false, no_fractions = false, skip_unsupported = false;
};

/// Meshes the solids. One that overlaps itself is united with nothing first when that is asked for, which changes
/// `solids`; overlaps that it still has, where rounding to the lattice made some, go by winding. `united` says which.
Result<hexmesh::Built> mesh_solids(Session& session, const Context& context, const HexmeshOptions& options,
                                   hexmesh::Options meshing, std::vector<mesh::Mesh>& solids,
                                   std::vector<bool>& united) {
    for (;;) {
        Result<hexmesh::Built> built = session.timed("mesh", [&] {
            return options.conforming ? hexmesh::build_conforming(solids, meshing, context)
                                      : hexmesh::build(solids, meshing, context);
        });
        if (built || built.error().code != ErrorCode::not_a_solid || options.overlaps != "unite" ||
            meshing.overlaps == hexmesh::OverlapPolicy::winding)
            return built;
        const std::size_t solid = built.error().place.operand.value_or(0);
        if (united[solid]) {
            meshing.overlaps = hexmesh::OverlapPolicy::winding;
            continue;
        }
        boolean::Options uniting;
        if (options.open == "winding") uniting.open = boolean::OpenOperands::winding;
        const Result<bool> changed = unite_with_nothing(session, context, options.inputs[solid],
                                                        built.error(), uniting, solids[solid]);
        if (!changed) return changed.error();
        if (!*changed) return built;
        united[solid] = true;
    }
}

Result<hexmesh::Options> meshing_options(const HexmeshOptions& options) {
    hexmesh::Options meshing;
    meshing.precision = options.precision;
    meshing.level = options.level;
    meshing.layers = options.layers >= 0 ? options.layers : options.fit ? 1 : 0;
    meshing.largest = options.largest;
    meshing.proximity.smallest = options.proximity;
    if (!options.curvature.empty()) meshing.curvature = *parse_curvature(options.curvature);
    for (const std::string& text : options.boxes) meshing.boxes.push_back(*parse_box(text));
    for (const std::string& text : options.sizes) {
        const FileSizes sizes = *parse_sizes(text);
        bool found = false;
        for (std::size_t i = 0; i < options.inputs.size(); ++i) {
            if (options.inputs[i] != sizes.file) continue;
            meshing.solids.push_back({static_cast<mesh::SolidIndex>(i), sizes.surface, sizes.interior});
            found = true;
        }
        if (!found)
            return Error{ErrorCode::bad_input, "--size names " + sizes.file + ", which is no input", {}};
    }
    meshing.balance = options.balance == "face"   ? octree::Contact::face
                      : options.balance == "edge" ? octree::Contact::edge
                                                  : octree::Contact::corner;
    const std::string keep = !options.keep.empty() ? options.keep : options.fit ? "manifold" : "touched";
    meshing.keep = keep == "all"        ? hexmesh::Keep::all
                   : keep == "half"     ? hexmesh::Keep::half
                   : keep == "manifold" ? hexmesh::Keep::manifold
                                        : hexmesh::Keep::touched;
    if (options.no_fractions && (keep == "half" || keep == "manifold"))
        return Error{
            ErrorCode::bad_input,
            "--fit and --keep " + keep + " need the parts that are filled, and --no-fractions forbids them",
            {}};
    if (options.fit && options.balance == "face")
        return Error{
            ErrorCode::bad_input,
            "--fit wants --balance edge or corner: balanced at faces alone, nodes hang on nodes that "
            "hang themselves",
            {}};
    meshing.max_cells = *parse_count(options.max_cells);
    meshing.fractions = options.no_fractions ? hexmesh::Fractions::skip : hexmesh::Fractions::compute;
    meshing.open = options.open == "winding" ? classic::OpenPolicy::winding : classic::OpenPolicy::reject;
    meshing.overlaps =
        options.overlaps == "winding" ? hexmesh::OverlapPolicy::winding : hexmesh::OverlapPolicy::reject;
    return meshing;
}

/// The names of the solids: their files', without folder and extension, and a number where two are equal.
std::vector<std::string> names_of(const std::vector<std::string>& inputs) {
    std::vector<std::string> names;
    for (const std::string& path : inputs)
        names.push_back(path == "-" ? "stdin" : std::filesystem::path(path).stem().string());
    return mesh::distinct_names(names);
}

/// What is known of the cells besides the mesh: numbers that the user brings, and their quality where cells are no
/// cubes.
struct CellNumbers {
    std::vector<double> values, quality;
};

Result<CellNumbers> cell_numbers(Session& session, const Context& context, const HexmeshOptions& options,
                                 const mesh::HexMesh& mesh) {
    CellNumbers numbers;
    if (options.conforming || options.fit) numbers.quality = hexmesh::scaled_jacobians(mesh);
    if (options.values.empty()) return numbers;
    session.inputs.push_back(options.values);
    Result<std::vector<double>> values = read_cell_values(options.values, mesh.cell_count(), context);
    if (!values) return std::move(values).error();
    numbers.values = std::move(*values);
    return numbers;
}

Result<io::WriteReport> write(Session& session, const Context& context, HexmeshFormat format,
                              const HexmeshOptions& options, const mesh::HexMesh& mesh,
                              const std::vector<std::string>& names, const CellNumbers& numbers) {
    if (options.output == "-") session.stdout_taken = true;
    std::vector<io::CellData> more;
    if (!numbers.quality.empty()) more.push_back({"scaled_jacobian", numbers.quality});
    if (!numbers.values.empty()) more.push_back({"value", numbers.values});
    Result<io::WriteReport> written = session.timed(
        "write", [&] { return write_hexmesh(format, options.output, mesh, names, context, more); });
    if (written) session.warn(written->warnings);
    return written;
}

Status draw(Session& session, const Context& context, const HexmeshOptions& options,
            const mesh::HexMesh& mesh, const CellNumbers& numbers) {
    const Result<render::Image> image =
        session.timed("draw", [&] { return render::picture_of(mesh, {.values = numbers.values}, context); });
    if (!image) return image.error();
    return render::write_png(options.picture, *image, context);
}

Result<ExitCode> make_hexmesh(Session& session, const HexmeshOptions& options) {
    const Context context = session.context();
    std::vector<std::string> read = options.inputs;
    if (!options.values.empty()) read.push_back(options.values);
    const Result<HexmeshFormat> format = settle_hexmesh_output(session, read, options.output, options.to);
    if (!format) return format.error();
    if (!options.picture.empty())
        if (const Status apart = settle_further_output(session, read, options.picture); !apart)
            return apart.error();
    if (options.fit && !options.output.empty() && needs_octants(*format))
        return session.usage_error(
            "--fit moves nodes, and this format has none: it is for octrees; write .vtu, .inp, .msh, "
            ".mesh or a folder, or leave out --fit");
    const Result<hexmesh::Options> meshing = meshing_options(options);
    if (!meshing) return session.usage_error(meshing.error().sentence);
    Result<std::vector<mesh::Mesh>> solids = read_solids(
        session, context, options.inputs, {.faceted = true, .skip_unsupported = options.skip_unsupported});
    if (!solids) return std::move(solids).error();
    std::vector<bool> united(solids->size(), false);
    Result<hexmesh::Built> built = mesh_solids(session, context, options, *meshing, *solids, united);
    if (!built) {
        if (options.inputs.size() == 1) return in_file(std::move(built).error(), options.inputs[0]);
        return in_its_file(std::move(built).error(), options.inputs);
    }
    const std::vector<std::string> names = names_of(options.inputs);
    warn_about(session, *built, names, options.inputs);
    session.result = json_of(*built, names);
    for (std::size_t i = 0; i < united.size(); ++i) session.result["solids"][i]["united"] = bool{united[i]};
    session.text = text_of(*built, names);
    if (options.fit) {
        Result<hexmesh::FitReport> fitted =
            session.timed("fit", [&] { return hexmesh::fit(built->mesh, *solids, {}, context); });
        if (!fitted) return std::move(fitted).error();
        add_fit(session, *fitted, built->mesh);
    }
    std::optional<hexmesh::Quality> quality;
    if (options.conforming || options.fit) quality = hexmesh::measure_quality(built->mesh);
    add_body(session, *built, *solids, quality,
             {.for_solver = !options.output.empty() && is_for_solvers(*format), .is_fitted = options.fit});
    if (quality) add_quality(session, *quality);
    const Result<CellNumbers> numbers = cell_numbers(session, context, options, built->mesh);
    if (!numbers) return numbers.error();
    if (!options.output.empty()) {
        Result<io::WriteReport> written =
            write(session, context, *format, options, built->mesh, names, *numbers);
        if (!written) return std::move(written).error();
    }
    if (!options.picture.empty())
        if (const Status drawn = draw(session, context, options, built->mesh, *numbers); !drawn)
            return drawn.error();
    return ExitCode::ok;
}

std::string check_picture(const std::string& path) {
    return std::filesystem::path(path).extension() == ".png" ? "" : "pictures are written as .png";
}

template <class Parse>
OptionCheck checked_by(const Parse& parse, const std::string& wanted) {
    return [parse, wanted](const std::string& text) { return parse(text) ? std::string() : wanted; };
}

void add_size_options(Verb* verb, HexmeshOptions& options) {
    Option* level = verb->add_option("--level", options.level,
                                     "Cells on surfaces are about 1/2^N of the longest side; 7 by default")
                        ->check(whole_number(0, octree::max_level))
                        ->type_name("N");
    verb->add_option("-p,--precision", options.precision,
                     "Cells on a surface are no larger than this, in the model's units")
        ->check(check_positive)
        ->type_name("LENGTH")
        ->excludes(level);
    verb->add_option("--largest", options.largest, "No cell is larger than this")
        ->check(check_positive)
        ->type_name("LENGTH");
    verb->add_option("--layers", options.layers,
                     "Layers of cells as small as those on the surface, beside it; 0, with --fit 1")
        ->check(whole_number(0, 100))
        ->type_name("N");
    verb->add_option("--size", options.sizes,
                     "Cells on the surface of one FILE, and inside it, are no larger than this")
        ->check(checked_by(parse_sizes, "wants FILE:SURFACE or FILE:SURFACE:INTERIOR, two lengths"))
        ->type_name("FILE:LENGTH[:LENGTH]");
    verb->add_option("--box", options.boxes, "Cells in the box are no larger than this")
        ->check(checked_by(parse_box, "wants x0,y0,z0,x1,y1,z1:LENGTH"))
        ->type_name("X0,Y0,Z0,X1,Y1,Z1:LENGTH");
    verb->add_option("--max-cells", options.max_cells,
                     "Give up beyond so many cells of the octree: a count such as 20M, some 65 bytes each")
        ->check(check_count)
        ->type_name("N")
        ->capture_default_str();
    verb->add_option("--curvature", options.curvature,
                     "Down to this length, split cells in which the surface turns by more than DEGREES (30)")
        ->check(checked_by(parse_curvature, "wants LENGTH or LENGTH:DEGREES"))
        ->type_name("LENGTH[:DEGREES]");
    verb->add_option("--proximity", options.proximity,
                     "Down to this length, split cells that hold both sides of a wall")
        ->check(check_positive)
        ->type_name("LENGTH");
}

}  // namespace

void add_hexmesh(Program& program) {
    const auto options = std::make_shared<HexmeshOptions>();
    Verb* verb = program.verb("hexmesh", "Simulation", "Mesh solids with hexahedra for a solver",
                              [options](Session& session) { return make_hexmesh(session, *options); });
    verb->add_option("FILES", options->inputs,
                     "Closed meshes, OpenSCAD trees (.csg) or octrees: one solid each")
        ->required()
        ->type_name("FILE");
    verb->add_option("-o,--output", options->output, hexmesh_outputs_help)->type_name("FILE");
    add_size_options(verb, *options);
    Option* balance =
        take_one_of(verb->add_option("--balance", options->balance,
                                     "Cells that differ by one level at most: at a face, edge or corner"),
                    {"face", "edge", "corner"});
    Option* keep = take_one_of(verb->add_option("--keep", options->keep,
                                                "Cells that belong to the mesh: touched by a solid, at least "
                                                "half filled by solids (overlaps count once), "
                                                "these with a "
                                                "boundary that is a manifold (with --fit), or all"),
                               {"touched", "half", "manifold", "all"});
    Option* conforming = verb->add_flag("--conforming", options->conforming,
                                        "No hanging nodes: all hexahedra fit, by templates");
    verb->add_flag("--fit", options->fit, "Draw the boundary onto the surface; every cell stays valid");
    balance->excludes(conforming);
    keep->excludes(conforming);
    verb->add_flag("--no-fractions", options->no_fractions,
                   "Do not compute how much of each boundary cell is filled");
    take_one_of(verb->add_option("--open", options->open,
                                 "An open surface: reject it, or close it and go by winding"),
                {"reject", "winding"});
    take_one_of(
        verb->add_option("--overlaps", options->overlaps,
                         "A solid that overlaps itself: mesh its exact union and warn, go by winding, "
                         "or reject it"),
        {"unite", "winding", "reject"});
    verb->add_flag("--skip-unsupported", options->skip_unsupported,
                   "For .csg: leave out text and the like, with warnings");
    verb->add_option("--picture", options->picture, "A picture of the mesh to draw: .png")
        ->check(check_picture)
        ->type_name("FILE");
    verb->add_option("--values", options->values,
                     "Numbers for the cells, one line each: they colour the picture and go to a .vtu")
        ->type_name("FILE");
    take_one_of(verb->add_option("--to", options->to, "Format of the output, instead of by its extension"),
                hexmesh_format_names());
}

}  // namespace octavo::cli
