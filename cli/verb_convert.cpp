// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "model.hpp"
#include "program.hpp"

// `octavo convert IN OUT`: from one format to another, without changing the geometry.

namespace octavo::cli {
namespace {

struct ConvertOptions {
    std::string input, output, from, to, encoding = "auto", unit;
};

io::Encoding encoding_of(const std::string& word) {
    if (word == "binary") return io::Encoding::binary;
    if (word == "ascii") return io::Encoding::ascii;
    return io::Encoding::automatic;
}

Result<ExitCode> convert(Session& session, const ConvertOptions& options) {
    const Context context = session.context();
    if (same_file(options.input, options.output)) return would_overwrite(options.output);
    Result<io::ReadMesh> read = read_mesh(session, context, options.input, options.from);
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
    CLI::App* verb = program.verb("convert", "Edit", "Write a mesh in another format",
                                  [options](Session& session) { return convert(session, *options); });
    verb->add_option("IN", options->input, "The mesh to read; - is stdin")->required()->type_name("FILE");
    verb->add_option("OUT", options->output, "The file to write; - is stdout")->required()->type_name("FILE");
    verb->add_option("--from", options->from, "Format of IN, instead of by its extension")
        ->type_name("FORMAT");
    verb->add_option("--to", options->to, "Format of OUT, instead of by its extension")->type_name("FORMAT");
    verb->add_option("--encoding", options->encoding, "auto, binary or ascii, where the format has both")
        ->check(CLI::IsMember({"auto", "binary", "ascii"}))
        ->type_name("KIND");
    verb->add_option("--unit", options->unit, "Unit of length to state in formats that can (3mf)")
        ->type_name("UNIT");
}

}  // namespace octavo::cli
