// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include <octavo/base/check.hpp>
#include <octavo/io/read.hpp>
#include <octavo/io/write.hpp>

// What every fuzzer of a mesh format does: any bytes either fail with a sentence, or give a sound mesh that
// survives being written and read again.

namespace octavo::fuzz {

inline void check_sound(const io::ReadMesh& read) {
    OCTAVO_CHECK(!read.mesh.triangles.empty() || !read.warnings.empty(), "a mesh without facets is told of");
    for (const mesh::Triangle& triangle : read.mesh.triangles)
        for (const mesh::VertexIndex corner : triangle)
            OCTAVO_CHECK(corner < read.mesh.vertices.size(), "corners name vertices");
    for (const Vec3& vertex : read.mesh.vertices) OCTAVO_CHECK(is_finite(vertex), "coordinates are finite");
    OCTAVO_CHECK(
        read.polygon_of_triangle.empty() || read.polygon_of_triangle.size() == read.mesh.triangles.size(),
        "every triangle has a polygon, or none has");
    for (const std::uint32_t polygon : read.polygon_of_triangle)
        OCTAVO_CHECK(polygon < read.polygons, "triangles name polygons of the file");
}

/// Reads as triangles and as polygons; fails only with a sentence.
inline Result<io::ReadMesh> read_soundly(const std::uint8_t* data, std::size_t size,
                                         const io::ReadOptions& options) {
    const Bytes bytes = bytes_of({reinterpret_cast<const char*>(data), size});
    Result<io::ReadMesh> read = io::read_mesh(bytes, options);
    const Result<io::ReadPolygons> polygons = io::read_polygons(bytes, options);
    if (!read) {
        OCTAVO_CHECK(!read.error().sentence.empty(), "an error has a sentence");
        OCTAVO_CHECK(read.error().code != ErrorCode::internal, "bad bytes are not our defect");
        return read;
    }
    check_sound(*read);
    OCTAVO_CHECK(polygons.has_value(), "what makes triangles makes polygons");
    return read;
}

inline void read_write_read(const std::uint8_t* data, std::size_t size, const char* format,
                            io::Encoding encoding) {
    const io::ReadOptions options{.format = format, .max_triangles = 1'000'000};
    const Result<io::ReadMesh> first = read_soundly(data, size, options);
    if (!first) return;
    const Result<io::WrittenBytes> written =
        io::write_mesh(first->mesh, {.format = format, .encoding = encoding});
    OCTAVO_CHECK(written.has_value(), "what was read can be written");
    const Result<io::ReadMesh> second = io::read_mesh(written->bytes, options);
    OCTAVO_CHECK(second.has_value(), "what was written can be read");
    OCTAVO_CHECK(second->mesh.vertices == first->mesh.vertices, "vertices survive");
    OCTAVO_CHECK(second->mesh.triangles == first->mesh.triangles, "triangles survive");
}

}  // namespace octavo::fuzz
