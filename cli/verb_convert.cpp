// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include <octavo/base/counted.hpp>
#include <octavo/bp_octree/to_mesh.hpp>
#include <octavo/io/format.hpp>
#include <octavo/io/three_mf_parts.hpp>

#include "model.hpp"
#include "program.hpp"

// `octavo convert IN OUT`: from one format to another, without changing the geometry. A CSG tree becomes the mesh that
// it evaluates to, an octree the boundary of its black cells, or another form of itself, a BP-octree its exact
// triangles or the envelopes of a level.
//
// --unit is the unit that the numbers of OUT mean. The numbers of a file that states its unit are scaled to it, so that
// the model keeps its size; those of others are taken to be in it.

namespace octavo::cli {
namespace {

struct ConvertOptions {
    std::string input, output, named_output, from, to, encoding = "auto", unit;
    std::optional<int> level;  ///< of a BP-octree; none is the exact triangles
    bool without_cell_faces = false;
};

io::Encoding encoding_of(const std::string& word) {
    if (word == "binary") return io::Encoding::binary;
    if (word == "ascii") return io::Encoding::ascii;
    return io::Encoding::automatic;
}

bool is_among(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

Result<ExitCode> convert_octree(Session& session, const Context& context, const ConvertOptions& options,
                                const std::string& format) {
    Result<octree::Octree> tree = read_octree(session, context, options.input, options.from);
    if (!tree) return std::move(tree).error();
    Result<io::WriteReport> report = write_octree(session, context, options.output, *tree, format);
    if (!report) return std::move(report).error();
    session.result = {{"leaves", tree->stats().leaves()}, {"format", format}, {"bytes", report->bytes}};
    session.text = fmt::format("{}: {} leaves, {} bytes of {}\n", options.output,
                               grouped(tree->stats().leaves()), grouped(report->bytes), format);
    return ExitCode::ok;
}

Error unit_is_useless(Session& session, const ConvertOptions& options, const std::string& format) {
    return session.usage_error(fmt::format("--unit {}: {} states no unit, and {} has none to convert from",
                                           options.unit, format, options.input));
}

/// What of the command line alone is wrong: options that the formats have no use for.
Status check_use(Session& session, const ConvertOptions& options, const std::string& format) {
    const ModelKind kind = kind_of(options.input, options.from);
    if (options.level && kind != ModelKind::bp_octree)
        return session.usage_error("--level is for BP-octrees (.bpo), and " + options.input + " is none");
    if (options.encoding != "auto" && format != "stl" && format != "ply")
        return session.usage_error(fmt::format("--encoding {}: only stl and ply have a choice, {} does not",
                                               options.encoding, format));
    if (options.unit.empty() || format == "3mf") return Done{};
    const std::string input_format =
        io::extension_of(options.from.empty() ? options.input : "." + options.from);
    const bool states_none =
        kind != ModelKind::mesh || (io::mesh_format_named(input_format) && input_format != "3mf");
    if (states_none) return unit_is_useless(session, options, format);
    return Done{};
}

/// What the numbers are multiplied by to be in `unit`; 1 where the file states none.
double scale_to(io::ReadMesh& read, const std::string& unit) {
    if (unit.empty() || read.unit.empty() || read.unit == unit) return 1;
    const double scale = read.millimetres_per_unit / io::millimetres_in(unit);
    for (Vec3& vertex : read.mesh.vertices) vertex = scale * vertex;
    read.unit = unit;
    return scale;
}

/// The envelopes of one level of a BP-octree, and how many bytes of its file they took.
struct Envelopes {
    io::ReadMesh read;
    std::uint64_t bytes_read = 0;
};
Result<Envelopes> read_envelopes(Session& session, const Context& context, const ConvertOptions& options) {
    bp_octree::ReadBpoOptions reading;
    reading.levels = *options.level;
    reading.partial = bp_octree::ReadBpoOptions::Partial::accept;
    Result<bp_octree::ReadBpo> file = read_bp_octree(session, context, options.input, reading);
    if (!file) return std::move(file).error();
    if (file->tree.deepest() < *options.level)
        session.warn(fmt::format("the deepest level is {}; that is what is written", file->tree.deepest()));
    const bp_octree::ToMeshOptions drawing{.level = *options.level,
                                           .cell_faces = !options.without_cell_faces};
    Envelopes envelopes;
    envelopes.bytes_read = file->bytes_read;
    envelopes.read.mesh =
        session.timed("to_mesh", [&] { return bp_octree::to_mesh(file->tree, drawing, context); });
    if (context.cancelled()) return Context::cancelled_error();
    return envelopes;
}

Result<ExitCode> write_surface(Session& session, const Context& context, const ConvertOptions& options,
                               const std::string& format, io::ReadMesh read) {
    if (!options.unit.empty() && format != "3mf" && read.unit.empty())
        return unit_is_useless(session, options, format);
    const std::string stated = read.unit;
    const double scale = scale_to(read, options.unit);
    io::WriteOptions writing{.format = format, .encoding = encoding_of(options.encoding)};
    if (!options.unit.empty()) {
        writing.unit = options.unit;
    } else if (!read.unit.empty()) {
        writing.unit = read.unit;
    }
    Result<io::WriteReport> report = write_mesh(session, context, options.output, read.mesh, writing);
    if (!report) return std::move(report).error();
    warn_of_losses(session, read, report->format);
    session.result = {{"vertices", read.mesh.vertices.size()},
                      {"triangles", read.mesh.triangles.size()},
                      {"format", report->format},
                      {"bytes", report->bytes},
                      {"largest_displacement", report->largest_displacement},
                      {"scale", scale}};
    session.text = fmt::format("{}: {}, {}, {} bytes of {}\n", options.output,
                               counted(read.mesh.vertices.size(), "vertex", "vertices"),
                               counted(read.mesh.triangles.size(), "triangle", "triangles"),
                               grouped(report->bytes), report->format);
    if (scale != 1)
        session.text +=
            fmt::format("scaled by {}: from {} to {}\n", number_text(scale), stated, options.unit);
    return ExitCode::ok;
}

Result<ExitCode> convert_surface(Session& session, const Context& context, const ConvertOptions& options,
                                 const std::string& format) {
    if (options.level) {
        Result<Envelopes> envelopes = read_envelopes(session, context, options);
        if (!envelopes) return std::move(envelopes).error();
        Result<ExitCode> written =
            write_surface(session, context, options, format, std::move(envelopes->read));
        if (written) session.result["bytes_read"] = envelopes->bytes_read;
        return written;
    }
    Result<io::ReadMesh> read = read_surface(session, context, options.input, options.from);
    if (!read) return std::move(read).error();
    return write_surface(session, context, options, format, std::move(*read));
}

/// Meshes, and what only octrees become.
OutputFormats all_outputs() {
    OutputFormats formats = mesh_outputs();
    formats.names.insert(formats.names.end(), octree_outputs().names.begin(), octree_outputs().names.end());
    return formats;
}

Result<ExitCode> convert(Session& session, ConvertOptions options) {
    const Context context = session.context();
    if (options.output.empty() == options.named_output.empty())
        return session.usage_error(options.output.empty()
                                       ? "the file to write is missing: octavo convert IN OUT"
                                       : "the file to write is named twice, by OUT and by -o");
    if (options.output.empty()) options.output = options.named_output;
    const bool is_octree = kind_of(options.input, options.from) == ModelKind::octree;
    const Result<std::string> format = settle_output(session, {options.input}, options.output, options.to,
                                                     is_octree ? all_outputs() : mesh_outputs());
    if (!format) return format.error();
    if (const Status useful = check_use(session, options, *format); !useful) return useful.error();
    return is_among(octree_outputs().names, *format) ? convert_octree(session, context, options, *format)
                                                     : convert_surface(session, context, options, *format);
}

}  // namespace

void add_convert(Program& program) {
    const auto options = std::make_shared<ConvertOptions>();
    Verb* verb = program.verb("convert", "Edit", "Write a model in another format",
                              [options](Session& session) { return convert(session, *options); });
    verb->add_option(
            "IN", options->input,
            "A mesh (- is stdin), a CSG tree (.csg), an octree (.oct): its black cells as a mesh, or a "
            "BP-octree (.bpo): its triangles")
        ->required()
        ->type_name("FILE");
    verb->add_option("OUT", options->output,
                     "The file to write: " + one_of(mesh_outputs().names) +
                         ", and of an octree also oct, vtu or htg; - is stdout")
        ->type_name("FILE");
    verb->add_option("-o,--output", options->named_output, "Another way to name OUT")->type_name("FILE");
    add_from_option(verb, options->from, "IN");
    add_to_option(verb, options->to, all_outputs());
    take_one_of(verb->add_option("--encoding", options->encoding, "For stl and ply; auto is binary"),
                {"auto", "binary", "ascii"});
    take_one_of(verb->add_option("--unit", options->unit,
                                 "Unit of the numbers in OUT; those of IN are scaled to it where IN states "
                                 "another, as 3mf does. By default that of IN, or millimeter"),
                {"micron", "millimeter", "centimeter", "inch", "foot", "meter"});
    Option* level =
        verb->add_option("--level", options->level,
                         "For .bpo: write the envelopes of this level instead of the exact triangles")
            ->check(whole_number(0, bp_octree::max_depth))
            ->type_name("L");
    verb->add_flag("--without-cell-faces", options->without_cell_faces,
                   "Leave out faces that lie in sides of cells; lighter, but open")
        ->needs(level);
}

}  // namespace octavo::cli
