// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "model.hpp"
#include "program.hpp"
#include <octavo/bp_octree/to_mesh.hpp>

// `octavo convert IN OUT`: from one format to another, without changing the geometry; and a level of a BP-octree as
// triangles.

namespace octavo::cli {
namespace {

struct ConvertOptions {
    std::string input, output, from, to, encoding = "auto", unit;
    int level = no_level;
    bool without_cell_faces = false;
    static constexpr int no_level = -1;  ///< the exact triangles
};

io::Encoding encoding_of(const std::string& word) {
    if (word == "binary") return io::Encoding::binary;
    if (word == "ascii") return io::Encoding::ascii;
    return io::Encoding::automatic;
}

/// The triangles of a BP-octree, or the envelopes of one of its levels.
Result<io::ReadMesh> mesh_of_bp_octree(Session& session, const Context& context,
                                       const ConvertOptions& options) {
    bp_octree::ReadBpoOptions reading;
    const bool exact = options.level == ConvertOptions::no_level;
    if (!exact) {
        reading.levels = options.level;
        reading.partial = bp_octree::ReadBpoOptions::Partial::accept;
    }
    Result<bp_octree::ReadBpo> file = read_bp_octree(session, context, options.input, reading);
    if (!file) return std::move(file).error();
    io::ReadMesh mesh;
    if (exact) {
        mesh.mesh = bp_octree::exact_mesh(file->tree);
        return mesh;
    }
    if (file->tree.deepest() < options.level)
        session.warn(fmt::format("the deepest level is {}; that is what is written", file->tree.deepest()));
    bp_octree::ToMeshOptions drawing;
    drawing.level = options.level;
    drawing.cell_faces = !options.without_cell_faces;
    mesh.mesh = session.timed("to_mesh", [&] { return bp_octree::to_mesh(file->tree, drawing, context); });
    if (context.cancelled()) return Context::cancelled_error();
    return mesh;
}

Result<ExitCode> convert(Session& session, const ConvertOptions& options) {
    const Context context = session.context();
    if (same_file(options.input, options.output)) return would_overwrite(options.output);
    const bool is_bp_octree = kind_of(options.input, options.from) == ModelKind::bp_octree;
    if (!is_bp_octree && (options.level != ConvertOptions::no_level || options.without_cell_faces))
        return Error{ErrorCode::unsupported, "only BP-octrees (.bpo) have levels", {}};
    Result<io::ReadMesh> read = is_bp_octree ? mesh_of_bp_octree(session, context, options)
                                             : read_mesh(session, context, options.input, options.from);
    if (!read) return std::move(read).error();

    io::WriteOptions writing;
    writing.format = options.to;
    writing.encoding = encoding_of(options.encoding);
    if (!options.unit.empty()) {
        writing.unit = options.unit;
    } else if (!read->unit.empty()) {
        writing.unit = read->unit;
    }
    Result<io::WriteReport> report = write_mesh(session, context, options.output, read->mesh, writing);
    if (!report) return std::move(report).error();

    session.result = {{"vertices", read->mesh.vertices.size()},
                      {"triangles", read->mesh.triangles.size()},
                      {"format", report->format},
                      {"bytes", report->bytes},
                      {"largest_displacement", report->largest_displacement}};
    session.text = fmt::format("{}: {} vertices, {} triangles, {} bytes of {}\n", options.output,
                               grouped(read->mesh.vertices.size()), grouped(read->mesh.triangles.size()),
                               grouped(report->bytes), report->format);
    return ExitCode::ok;
}

}  // namespace

void add_convert(Program& program) {
    const auto options = std::make_shared<ConvertOptions>();
    CLI::App* verb =
        program.verb("convert", "Edit", "Write a mesh, or a level of a BP-octree, in another format",
                     [options](Session& session) { return convert(session, *options); });
    verb->add_option("IN", options->input, "The mesh (- is stdin) or BP-octree (.bpo) to read")
        ->required()
        ->type_name("FILE");
    verb->add_option("OUT", options->output, "The file to write; - is stdout")->required()->type_name("FILE");
    verb->add_option("--from", options->from, "Format of IN, instead of by its extension")
        ->type_name("FORMAT");
    verb->add_option("--to", options->to, "Format of OUT, instead of by its extension")->type_name("FORMAT");
    verb->add_option("--encoding", options->encoding, "auto, binary or ascii, where the format has both")
        ->check(CLI::IsMember({"auto", "binary", "ascii"}))
        ->type_name("KIND");
    verb->add_option("--unit", options->unit, "Unit of length to state in formats that can (3mf)")
        ->type_name("UNIT");
    CLI::Option* level =
        verb->add_option("--level", options->level,
                         "For .bpo: write the envelopes of this level instead of the exact triangles")
            ->check(CLI::Range(0, bp_octree::max_depth))
            ->type_name("L");
    verb->add_flag("--without-cell-faces", options->without_cell_faces,
                   "With --level: leave out faces that lie in sides of cells; lighter, but open")
        ->needs(level);
}

}  // namespace octavo::cli
