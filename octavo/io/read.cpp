// SPDX-License-Identifier: Apache-2.0
#include <limits>
#include <new>

#include <octavo/io/file_mesh.hpp>
#include <octavo/io/format.hpp>
#include <octavo/io/input.hpp>
#include <octavo/io/read.hpp>

namespace octavo::io {
namespace {

constexpr std::uint64_t most_indices = std::numeric_limits<std::uint32_t>::max();

/// What a reader found, and the name of its format.
struct Found {
    FileMesh file;
    std::string format;
};

Error unknown_format(const std::string& name) {
    const std::string known = "known are " + mesh_format_names() + " and what assimp reads";
    if (name.empty())
        return {ErrorCode::unsupported, "the format cannot be told from the content; " + known, {}};
    return {ErrorCode::unsupported, "the format \"" + name + "\" is not known; " + known, {}};
}

Result<Found> found_by(const Format& format, Bytes bytes, const ReadOptions& options,
                       const Context& context) {
    Result<FileMesh> file = format.read(bytes, options, context);
    if (!file) return std::move(file).error();
    return Found{std::move(*file), std::string(format.name)};
}

/// Reads with the stated format, or with the one that the content shows. Memory that runs out is the file's
/// fault here: counts are checked against its size, but a large file may still not fit.
Result<Found> find_mesh(Bytes bytes, const ReadOptions& options, const Context& context) try {
    if (bytes.empty()) return Error{ErrorCode::bad_input, "is empty", {}};
    const Format* const format =
        options.format.empty() ? sniff_mesh_format(bytes) : mesh_format_named(options.format);
    if (!format) return unknown_format(options.format);
    return found_by(*format, bytes, options, context);
} catch (const std::bad_alloc&) {
    return Error{ErrorCode::limit, "does not fit into memory", {}};
}

Result<Found> find_mesh(const std::string& path, const ReadOptions& options, const Context& context) {
    const Result<ByteBlock> block = read_bytes(path, context);
    if (!block) return block.error();
    ReadOptions named = options;
    if (named.format.empty() && path != "-" && mesh_format_named(extension_of(path)))
        named.format = extension_of(path);
    Result<Found> found = find_mesh(block->bytes(), named, context);
    if (found) return found;
    Error error = std::move(found).error();
    error.place.file = path;
    return error;
}

/// Splits a polygon into triangles that share its first corner.
void add_fan(std::span<const mesh::VertexIndex> corners, std::vector<mesh::Triangle>& triangles) {
    for (std::size_t i = 2; i < corners.size(); ++i)
        triangles.push_back({corners[0], corners[i - 1], corners[i]});
}

std::vector<std::string> remarks(const FileMesh& file) {
    std::vector<std::string> warnings = file.warnings;
    if (file.faces.too_small() > 0)
        warnings.push_back(std::to_string(file.faces.too_small()) +
                           " faces of fewer than three corners are left out");
    return warnings;
}

Error no_facets() { return {ErrorCode::bad_input, "has no facets", {}}; }
Error too_large() { return {ErrorCode::limit, "has more vertices or facets than 32 bits number", {}}; }

Result<ReadMesh> to_mesh(Found found) {
    FaceList& faces = found.file.faces;
    if (faces.size() == 0) return no_facets();
    ReadMesh result;
    result.format = std::move(found.format);
    result.warnings = remarks(found.file);
    result.unit = std::move(found.file.unit);
    result.millimetres_per_unit = found.file.millimetres_per_unit;
    result.polygons = faces.size();
    if (!faces.has_polygons()) {
        result.mesh.triangles = std::move(faces.triangles());
    } else {
        if (faces.size() > most_indices) return too_large();
        for (std::size_t face = 0; face < faces.size(); ++face) {
            const std::span<const mesh::VertexIndex> corners = faces.corners(face);
            result.triangulated += corners.size() > 3;
            add_fan(corners, result.mesh.triangles);
            result.polygon_of_triangle.resize(result.mesh.triangles.size(), static_cast<std::uint32_t>(face));
        }
    }
    if (result.mesh.triangles.size() > most_indices) return too_large();
    result.mesh.vertices = std::move(found.file.vertices);
    return result;
}

Result<ReadPolygons> to_polygons(Found found) {
    const FaceList& faces = found.file.faces;
    if (faces.size() == 0) return no_facets();
    ReadPolygons result;
    result.format = std::move(found.format);
    result.warnings = remarks(found.file);
    mesh::PolygonMesh& mesh = result.mesh;
    mesh.face_begin.reserve(faces.size() + 1);
    mesh.contour_begin.reserve(faces.size() + 1);
    for (std::size_t face = 0; face < faces.size(); ++face) {
        const std::span<const mesh::VertexIndex> corners = faces.corners(face);
        if (mesh.corners.size() + corners.size() > most_indices) return too_large();
        mesh.corners.insert(mesh.corners.end(), corners.begin(), corners.end());
        mesh.contour_begin.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
        mesh.face_begin.push_back(static_cast<std::uint32_t>(mesh.contour_begin.size() - 1));
    }
    mesh.vertices = std::move(found.file.vertices);
    return result;
}

}  // namespace

Result<ReadMesh> read_mesh(const std::string& path, const ReadOptions& options, const Context& context) {
    Result<Found> found = find_mesh(path, options, context);
    if (!found) return std::move(found).error();
    Result<ReadMesh> mesh = to_mesh(std::move(*found));
    if (mesh) return mesh;
    Error error = std::move(mesh).error();
    error.place.file = path;
    return error;
}

Result<ReadMesh> read_mesh(Bytes bytes, const ReadOptions& options, const Context& context) {
    Result<Found> found = find_mesh(bytes, options, context);
    if (!found) return std::move(found).error();
    return to_mesh(std::move(*found));
}

Result<ReadPolygons> read_polygons(const std::string& path, const ReadOptions& options,
                                   const Context& context) {
    Result<Found> found = find_mesh(path, options, context);
    if (!found) return std::move(found).error();
    Result<ReadPolygons> polygons = to_polygons(std::move(*found));
    if (polygons) return polygons;
    Error error = std::move(polygons).error();
    error.place.file = path;
    return error;
}

Result<ReadPolygons> read_polygons(Bytes bytes, const ReadOptions& options, const Context& context) {
    Result<Found> found = find_mesh(bytes, options, context);
    if (!found) return std::move(found).error();
    return to_polygons(std::move(*found));
}

}  // namespace octavo::io
