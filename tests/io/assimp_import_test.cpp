// SPDX-License-Identifier: Apache-2.0
#include <fstream>

#include <octavo/io/assimp_import.hpp>

#include "folder.hpp"
#include "from_text.hpp"

namespace octavo::io {
namespace {

/// A triangle and its mirror image beside it, as glTF with everything inside: positions 0 0 0, 1 0 0, 0 1 0 and
/// indices 0 1 2 as 16-bit numbers.
const std::string gltf = R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
"nodes": [{"mesh": 0}, {"mesh": 0, "scale": [-1, 1, 1], "translation": [0, 5, 0]}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
"buffers": [{"byteLength": 44, "uri":
"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAABAAIAAAA="}],
"bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 6}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
{"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}]})";

TEST(AssimpImport, PutsMeshesWhereTheSceneDoes) {
    const ReadMesh read = must_read(gltf, "gltf");
    ASSERT_EQ(read.mesh.triangles.size(), 2u);
    ASSERT_EQ(read.warnings.size(), 1u);
    EXPECT_THAT(read.warnings[0], testing::HasSubstr("floats"));
    const auto normal_z = [&](std::size_t t) {
        const mesh::Triangle& corners = read.mesh.triangles[t];
        const Vec3 a = read.mesh.vertices[corners[0]];
        return cross(read.mesh.vertices[corners[1]] - a, read.mesh.vertices[corners[2]] - a).z;
    };
    EXPECT_GT(normal_z(0), 0);
    EXPECT_GT(normal_z(1), 0) << "a mirrored facet must be turned";
    EXPECT_EQ(read.mesh.bounds().low, (Vec3{-1, 0, 0}));
    EXPECT_EQ(read.mesh.bounds().high, (Vec3{1, 6, 0}));
}

TEST(AssimpImport, WeldsBitEqualPoints) {
    const std::string same =
        replaced(gltf, "\"scale\": [-1, 1, 1], \"translation\": [0, 5, 0]", "\"name\": \"n\"");
    EXPECT_EQ(must_read(same, "gltf").mesh.vertices.size(), 3u);
}

TEST(AssimpImport, StopsAtTheLimitOfTriangles) {
    const Result<ReadMesh> read = read_mesh(bytes_of(gltf), {.format = "gltf", .max_triangles = 1});
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().code, ErrorCode::limit);
}

TEST(AssimpImport, HandsOnWhatAssimpSays) {
    const Result<ReadMesh> read = read_text("{\"asset\": 3", "gltf");
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().code, ErrorCode::bad_input);
    EXPECT_THAT(read.error().sentence, testing::StartsWith("assimp: "));
    EXPECT_EQ(read_text("x", "no-such-format").error().code, ErrorCode::unsupported);
}

TEST(AssimpImport, ReachesNoImporterThatIsNotListed) {
    // Zeros in these crashed the program, and text in .smd kept it busy for ever.
    const Folder folder;
    for (const char* name :
         {"a.lws", "a.mot", "a.smd", "a.blend", "a.q3s", "a.md5mesh", "a.no-such-format"}) {
        std::ofstream(folder / name) << std::string(400, '\0');
        const Result<ReadMesh> read = read_mesh(folder / name);
        ASSERT_FALSE(read) << name;
        EXPECT_EQ(read.error().code, ErrorCode::unsupported) << name;
        EXPECT_THAT(read.error().sentence, testing::HasSubstr("is not known; known are stl, ")) << name;
        EXPECT_THAT(read.error().sentence, testing::HasSubstr("glb")) << name;
    }
    std::ofstream(folder / "b.smd") << "version 1\nnodes\n";
    EXPECT_FALSE(read_mesh(folder / "b.smd"));
}

TEST(AssimpImport, WhatIsListedSurvivesBytesThatAreNone) {
    const Folder folder;
    std::uint32_t random = 1;
    for (const std::string_view format : assimp_formats())
        for (int round = 0; round < 8; ++round) {
            std::string bytes(400, '\0');
            for (char& byte : bytes) {
                random = random * 1664525U + 1013904223U;
                if (round > 0) byte = static_cast<char>(round % 2 ? random >> 24 : 32 + (random >> 24) % 95);
            }
            const std::string path = folder / ("a." + std::string(format)).c_str();
            std::ofstream(path) << bytes;
            // Some are pleased with nothing; then it is an empty solid.
            const Result<ReadMesh> read = read_mesh(path);
            EXPECT_TRUE(!read || read->mesh.triangles.empty()) << format << " " << round;
        }
}

}  // namespace
}  // namespace octavo::io
