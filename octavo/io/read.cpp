// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <limits>
#include <new>

#include <octavo/base/counted.hpp>
#include <octavo/io/assimp_import.hpp>
#include <octavo/io/file_mesh.hpp>
#include <octavo/io/format.hpp>
#include <octavo/io/input.hpp>
#include <octavo/io/read.hpp>
#include <octavo/mesh/triangulate.hpp>

namespace octavo::io {
namespace {

constexpr std::uint64_t most_indices = std::numeric_limits<std::uint32_t>::max();

/// What a reader found, and the name of its format.
struct Found {
    FileMesh file;
    std::string format;
};

Error unknown_format(const std::string& name) {
    std::string known = "known are " + mesh_format_names();
    for (const std::string_view format : assimp_formats()) known.append(", ").append(format);
    if (name.empty())
        return {ErrorCode::unsupported, "the format cannot be told from the content; " + known, {}};
    return {ErrorCode::unsupported, "the format \"" + name + "\" is not known; " + known, {}};
}

Result<Found> named(Result<FileMesh> file, std::string_view format) {
    if (!file) return std::move(file).error();
    return Found{std::move(*file), std::string(format)};
}

/// The name of the format to read with: the stated one, else what the content shows; empty when it shows none.
std::string format_of(Bytes bytes, const ReadOptions& options) {
    if (!options.format.empty()) return extension_of("." + options.format);
    if (const Format* const ours = sniff_mesh_format(bytes)) return std::string(ours->name);
    return text_of(bytes).starts_with("glTF") ? "glb" : "";
}

/// Memory that runs out is the file's fault here: counts are checked against its size, but a large file may
/// still not fit.
Result<Found> find_mesh(Bytes bytes, const ReadOptions& options, const Context& context) try {
    // Some editors mark UTF-8 at the start of text.
    if (text_of(bytes).starts_with("\xef\xbb\xbf")) bytes = bytes.subspan(3);
    if (bytes.empty()) return Error{ErrorCode::bad_input, "is empty", {}};
    const std::string name = format_of(bytes, options);
    if (const Format* const ours = mesh_format_named(name))
        return named(ours->read(bytes, options, context), name);
    if (assimp_reads(name)) return named(read_by_assimp(bytes, name, options, context), name);
    return unknown_format(name.empty() ? extension_of(options.path) : name);
} catch (const std::bad_alloc&) {
    return Error{ErrorCode::limit, "does not fit into memory", {}};
}

Error in_file(Error error, const std::string& path) {
    if (error.place.file.empty()) error.place.file = path;
    return error;
}

Result<Found> find_mesh(const std::string& path, const ReadOptions& options, const Context& context) {
    const Result<ByteBlock> block = read_bytes(path, context);
    if (!block) return block.error();
    ReadOptions chosen = options;
    const std::string extension = path == "-" ? "" : extension_of(path);
    if (chosen.format.empty() && (mesh_format_named(extension) || assimp_reads(extension)))
        chosen.format = extension;
    if (path != "-") chosen.path = path;
    // These formats spread over several files, which assimp finds from the path.
    const bool by_path = path != "-" && !chosen.format.empty() && !mesh_format_named(chosen.format) &&
                         chosen.format == extension;
    Result<Found> found = by_path ? named(read_by_assimp(path, chosen, context), extension)
                                  : find_mesh(block->bytes(), chosen, context);
    if (!found) return in_file(std::move(found).error(), path);
    return found;
}

std::vector<std::string> remarks(const FileMesh& file) {
    std::vector<std::string> warnings = file.warnings;
    if (file.faces.too_small() > 0)
        warnings.push_back(counted(file.faces.too_small(), "face of fewer than three corners is",
                                   "faces of fewer than three corners are") +
                           " left out");
    if (file.faces.size() == 0) warnings.push_back("the file has no facets: the solid is empty");
    return warnings;
}

/// A file without anything is an empty solid, which programs write when nothing is left of one. Vertices alone are
/// points, or a file that was cut off.
Error no_facets(std::size_t vertices) {
    return {ErrorCode::bad_input, "has no facets, only " + counted(vertices, "vertex", "vertices"), {}};
}
Error too_large() { return {ErrorCode::limit, "has more vertices or facets than 32 bits number", {}}; }

/// Splits the faces into triangles and counts those that are no simple polygons.
Status triangulate(const FileMesh& file, ReadMesh& result, const Context& context) {
    mesh::Triangulator triangulator(context);
    std::size_t crossing = 0;
    std::vector<std::uint32_t> contour_begin;
    for (std::size_t face = 0; face < file.faces.size(); ++face) {
        if (context.cancelled()) return Context::cancelled_error();
        const std::span<const mesh::VertexIndex> corners = file.faces.corners(face);
        result.triangulated += corners.size() > 3;
        contour_begin.clear();
        for (std::size_t c = 0; c <= file.faces.contours(face); ++c)
            contour_begin.push_back(static_cast<std::uint32_t>(file.faces.corners_before(face, c)));
        const mesh::Triangulation split = triangulator(file.vertices, corners, contour_begin);
        crossing += split.shape == mesh::PolygonShape::crossing;
        result.mesh.triangles.insert(result.mesh.triangles.end(), split.triangles.begin(),
                                     split.triangles.end());
        const auto number =
            file.number_of_face.empty() ? static_cast<std::uint32_t>(face) : file.number_of_face[face];
        result.polygon_of_triangle.resize(result.mesh.triangles.size(), number);
    }
    if (crossing > 0)
        result.warnings.push_back(
            counted(crossing, "polygon crosses itself; its", "polygons cross themselves; their") +
            " triangles overlap");
    if (context.cancelled()) return Context::cancelled_error();
    return Done{};
}

Result<ReadMesh> to_mesh(Found found, const Context& context) {
    FaceList& faces = found.file.faces;
    const std::size_t vertices = found.file.vertices.size();
    if (faces.size() == 0 && vertices > 0) return no_facets(vertices);
    ReadMesh result;
    result.format = std::move(found.format);
    result.warnings = remarks(found.file);
    result.beside = std::move(found.file.beside);
    result.left_behind = std::move(found.file.left_behind);
    result.unit = std::move(found.file.unit);
    result.millimetres_per_unit = found.file.millimetres_per_unit;
    const std::vector<std::uint32_t>& numbers = found.file.number_of_face;
    result.polygons = numbers.empty() ? faces.size() : *std::max_element(numbers.begin(), numbers.end()) + 1;
    if (!faces.has_polygons() && numbers.empty()) {
        result.mesh.triangles = std::move(faces.triangles());
    } else {
        if (faces.size() > most_indices) return too_large();
        if (const Status cut = triangulate(found.file, result, context); !cut) return cut.error();
    }
    // Polygons without area leave vertices alone too.
    if (result.mesh.triangles.empty() && vertices > 0) return no_facets(vertices);
    if (result.mesh.triangles.size() > most_indices) return too_large();
    result.mesh.vertices = std::move(found.file.vertices);
    return result;
}

Result<ReadPolygons> to_polygons(Found found) {
    const FaceList& faces = found.file.faces;
    if (faces.size() == 0 && !found.file.vertices.empty()) return no_facets(found.file.vertices.size());
    ReadPolygons result;
    result.format = std::move(found.format);
    result.warnings = remarks(found.file);
    mesh::PolygonMesh& mesh = result.mesh;
    mesh.face_begin.reserve(faces.size() + 1);
    mesh.contour_begin.reserve(faces.size() + 1);
    for (std::size_t face = 0; face < faces.size(); ++face) {
        const std::span<const mesh::VertexIndex> corners = faces.corners(face);
        if (mesh.corners.size() + corners.size() > most_indices) return too_large();
        for (std::size_t c = 1; c <= faces.contours(face); ++c)
            mesh.contour_begin.push_back(
                static_cast<std::uint32_t>(mesh.corners.size() + faces.corners_before(face, c)));
        mesh.corners.insert(mesh.corners.end(), corners.begin(), corners.end());
        mesh.face_begin.push_back(static_cast<std::uint32_t>(mesh.contour_begin.size() - 1));
    }
    mesh.vertices = std::move(found.file.vertices);
    return result;
}

}  // namespace

Result<ReadMesh> read_mesh(const std::string& path, const ReadOptions& options, const Context& context) {
    Result<Found> found = find_mesh(path, options, context);
    if (!found) return std::move(found).error();
    Result<ReadMesh> mesh = to_mesh(std::move(*found), context);
    if (!mesh) return in_file(std::move(mesh).error(), path);
    return mesh;
}

Result<ReadMesh> read_mesh(Bytes bytes, const ReadOptions& options, const Context& context) {
    Result<Found> found = find_mesh(bytes, options, context);
    if (!found) return std::move(found).error();
    return to_mesh(std::move(*found), context);
}

Result<ReadPolygons> read_polygons(const std::string& path, const ReadOptions& options,
                                   const Context& context) {
    Result<Found> found = find_mesh(path, options, context);
    if (!found) return std::move(found).error();
    Result<ReadPolygons> polygons = to_polygons(std::move(*found));
    if (!polygons) return in_file(std::move(polygons).error(), path);
    return polygons;
}

Result<ReadPolygons> read_polygons(Bytes bytes, const ReadOptions& options, const Context& context) {
    Result<Found> found = find_mesh(bytes, options, context);
    if (!found) return std::move(found).error();
    return to_polygons(std::move(*found));
}

}  // namespace octavo::io
