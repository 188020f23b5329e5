// SPDX-License-Identifier: Apache-2.0
#include <octavo/io/format.hpp>
#include <octavo/io/output.hpp>
#include <octavo/io/write.hpp>

namespace octavo::io {
namespace {

Error unknown_format(const std::string& name) {
    const std::string known = "Octavo writes meshes as " + mesh_format_names();
    if (name.empty())
        return {ErrorCode::unsupported, "no format is named and there is no extension; " + known, {}};
    return {ErrorCode::unsupported, "cannot write the format \"" + name + "\"; " + known, {}};
}

Result<WriteReport> write_to(Output& output, const Format& format, const mesh::Mesh& mesh,
                             const WriteOptions& options) {
    for (const Vec3& vertex : mesh.vertices)
        if (!is_finite(vertex))
            return Error{ErrorCode::limit, "a coordinate of the mesh is not a finite number", {}};
    Result<WriteReport> report = format.write(output, mesh, options);
    if (!report) return report;
    report->format = format.name;
    report->bytes = output.size();
    return report;
}

Error in_file(Error error, const std::string& path) {
    error.place.file = path;
    return error;
}

}  // namespace

Result<WriteReport> write_mesh(const std::string& path, const mesh::Mesh& mesh, const WriteOptions& options,
                               const Context& context) {
    const std::string name = !options.format.empty() || path == "-" ? options.format : extension_of(path);
    const Format* const format = mesh_format_named(name);
    if (!format) return in_file(unknown_format(name), path);
    Result<Output> output = Output::to_file(path, context);
    if (!output) return output.error();
    Result<WriteReport> report = write_to(*output, *format, mesh, options);
    if (!report) return in_file(std::move(report).error(), path);
    if (context.cancelled()) return Context::cancelled_error();
    if (Status status = output->commit(); !status) return std::move(status).error();
    return report;
}

Result<WrittenBytes> write_mesh(const mesh::Mesh& mesh, const WriteOptions& options, const Context& context) {
    const Format* const format = mesh_format_named(options.format);
    if (!format) return unknown_format(options.format);
    Output output = Output::to_memory();
    Result<WriteReport> report = write_to(output, *format, mesh, options);
    if (!report) return std::move(report).error();
    if (context.cancelled()) return Context::cancelled_error();
    return WrittenBytes{std::move(output).take_memory(), std::move(*report)};
}

}  // namespace octavo::io
