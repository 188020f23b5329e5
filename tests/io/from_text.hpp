// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octavo/io/read.hpp>
#include <octavo/io/write.hpp>

// Small files written into tests as text.

namespace octavo::io {

inline Result<ReadMesh> read_text(std::string_view text, const char* format) {
    ReadOptions options;
    options.format = format;
    return read_mesh(bytes_of(text), options);
}

/// The mesh of a file that must be fine.
inline ReadMesh must_read(std::string_view text, const char* format) {
    Result<ReadMesh> read = read_text(text, format);
    EXPECT_TRUE(read) << read.error().describe() << "\nin\n" << text;
    return read ? std::move(*read) : ReadMesh{};
}

/// Expects that reading fails at `line` with a sentence that holds `part`.
inline void expect_refused(std::string_view text, const char* format, std::uint64_t line, const char* part) {
    const Result<ReadMesh> read = read_text(text, format);
    ASSERT_FALSE(read) << text;
    EXPECT_THAT(read.error().sentence, testing::HasSubstr(part)) << text;
    EXPECT_EQ(read.error().place.line, line) << read.error().describe() << "\nin\n" << text;
}

inline std::string replaced(std::string text, std::string_view from, std::string_view to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
    return text;
}

/// A mesh of awkward coordinates: no two alike in digits, one negative zero, one that no float holds.
inline mesh::Mesh awkward_mesh() {
    mesh::Mesh mesh;
    mesh.vertices = {
        {0.1, 1.0 / 3, -0.0}, {1e-300, 2.5, 1e17}, {-123456.789, 4, 0.30000000000000004}, {7, 8, 9.5}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
    return mesh;
}

inline std::string write_text(const mesh::Mesh& mesh, const char* format,
                              Encoding encoding = Encoding::automatic) {
    WriteOptions options;
    options.format = format;
    options.encoding = encoding;
    Result<WrittenBytes> written = write_mesh(mesh, options);
    EXPECT_TRUE(written) << written.error().describe();
    return written ? std::string(text_of(written->bytes)) : std::string();
}

}  // namespace octavo::io
