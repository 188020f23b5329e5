// SPDX-License-Identifier: Apache-2.0
#include <new>

#include <octavo/io/format.hpp>
#include <octavo/io/input.hpp>
#include <octavo/io/npy.hpp>
#include <octavo/io/ply.hpp>
#include <octavo/io/point_text.hpp>
#include <octavo/io/points.hpp>

namespace octavo::io {
namespace {

/// "csv" (for all kinds of text), "npy", "ply", or empty.
std::string format_named(const std::string& name) {
    for (const char* text : {"csv", "txt", "tsv", "xyz", "asc", "pts"})
        if (name == text) return "csv";
    return name == "npy" || name == "ply" ? name : std::string();
}

std::string sniffed(Bytes bytes) {
    if (text_of(bytes).starts_with("\x93NUMPY")) return "npy";
    return sniff_mesh_format(bytes) == mesh_format_named("ply") ? "ply" : "csv";
}

Result<ReadPoints> named(Result<std::vector<Vec3>> points, const std::string& format) {
    if (!points) return std::move(points).error();
    return ReadPoints{std::move(*points), format, {}};
}

}  // namespace

Result<ReadPoints> read_points(Bytes bytes, const PointsOptions& options, const Context& context) try {
    if (bytes.empty()) return Error{ErrorCode::bad_input, "is empty", {}};
    const std::string format = options.format.empty() ? sniffed(bytes) : format_named(options.format);
    if (format == "csv") return named(read_point_text(bytes, context), format);
    if (format == "npy") return named(read_npy_points(bytes), format);
    if (format == "ply") {
        Result<FileMesh> file = read_ply(bytes, context, NonFinite::keep);
        if (!file) return std::move(file).error();
        return ReadPoints{std::move(file->vertices), format, std::move(file->warnings)};
    }
    return Error{
        ErrorCode::unsupported,
        "the format \"" + options.format + "\" is not known; points are read from csv, xyz, npy, ply",
        {}};
} catch (const std::bad_alloc&) {
    return Error{ErrorCode::limit, "does not fit into memory", {}};
}

Result<ReadPoints> read_points(const std::string& path, const PointsOptions& options,
                               const Context& context) {
    const Result<ByteBlock> block = read_bytes(path, context);
    if (!block) return block.error();
    PointsOptions chosen = options;
    if (chosen.format.empty() && path != "-") chosen.format = format_named(extension_of(path));
    Result<ReadPoints> points = read_points(block->bytes(), chosen, context);
    if (points) return points;
    Error error = std::move(points).error();
    error.place.file = path;
    return error;
}

}  // namespace octavo::io
