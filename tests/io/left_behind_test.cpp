// SPDX-License-Identifier: Apache-2.0
#include "from_text.hpp"

// What a file holds and a mesh does not is named, so that who converts it knows what is lost.

namespace octavo::io {
namespace {

using Kinds = std::vector<std::string>;

Kinds left_behind_in(const std::string& text, const char* format) {
    return must_read(text, format).left_behind;
}

const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

TEST(LeftBehind, IsNothingInWhatWeWrite) {
    for (const char* format : {"stl", "obj", "ply", "off", "3mf"})
        EXPECT_EQ(left_behind_in(write_text(awkward_mesh(), format), format), Kinds{}) << format;
    for (const char* format : {"stl", "ply"})
        EXPECT_EQ(left_behind_in(write_text(awkward_mesh(), format, Encoding::ascii), format), Kinds{})
            << format;
}

TEST(LeftBehind, OfObjIsNamedOnce) {
    EXPECT_EQ(left_behind_in(triangle, "obj"), Kinds{});
    EXPECT_EQ(left_behind_in("mtllib a.mtl\no one\nvt 0 0\nvt 0 1\nvn 0 0 1\ng left\nusemtl red\ns 1\n" +
                                 triangle + "l 1 2\np 1\n# made by hand\nusemtl blue\n",
                             "obj"),
              (Kinds{"materials", "objects", "texture coordinates", "normals", "groups", "smoothing groups",
                     "lines", "points", "comments"}));
    EXPECT_EQ(left_behind_in(replaced(triangle, "v 1 0 0", "v 1 0 0 255 0 0"), "obj"), Kinds{"colours"});
    EXPECT_EQ(left_behind_in(replaced(triangle, "v 1 0 0", "v 1 0 0 0.5"), "obj"), Kinds{"weights"});
    EXPECT_EQ(left_behind_in("s off\ns 0\n" + triangle, "obj"), Kinds{});
    EXPECT_EQ(left_behind_in(triangle + "unknown 1\n", "obj"), Kinds{"other statements"});
}

TEST(LeftBehind, OfPlyIsNamedByItsHeader) {
    const std::string text =
        "ply\nformat ascii 1.0\ncomment TextureFile a.png\nelement vertex 3\nproperty float x\nproperty "
        "float y\n"
        "property float z\nproperty float nx\nproperty uchar red\nproperty float confidence\nelement face 1\n"
        "property list uchar int vertex_indices\nproperty uchar red\nproperty list uchar float texcoord\n"
        "property int region\nelement edge 1\nproperty int a\nelement camera 0\nproperty int a\nend_header\n"
        "0 0 0 1 255 1\n1 0 0 1 255 1\n0 1 0 1 255 1\n3 0 1 2 255 1 0.5 7\n1\n";
    EXPECT_EQ(left_behind_in(text, "ply"),
              (Kinds{"normals", "colours", "other properties of vertices", "texture coordinates",
                     "other properties of faces", "other elements", "comments"}));
}

TEST(LeftBehind, OfOffIsNamedByItsHeaderOrItsLines) {
    const std::string faces = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2";
    EXPECT_EQ(left_behind_in("OFF\n3 1 0\n" + faces + " # plain\n", "off"), Kinds{});
    EXPECT_EQ(left_behind_in("OFF\n3 1 0\n" + faces + " 255 0 0\n", "off"), Kinds{"colours"});
    EXPECT_EQ(left_behind_in("STCNOFF\n3 1 0\n" + faces, "off"),
              (Kinds{"normals", "colours", "texture coordinates"}));
    EXPECT_EQ(left_behind_in("OFF\n3 1 0\n" + replaced(faces, "1 0 0\n", "1 0 0 9 9\n"), "off"),
              Kinds{"numbers behind coordinates"});
}

TEST(LeftBehind, OfStlIsNamesSolidsAndAttributes) {
    const std::string facet =
        "facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet\n";
    EXPECT_EQ(left_behind_in("solid\n" + facet + "endsolid\n", "stl"), Kinds{});
    EXPECT_EQ(left_behind_in("solid wheel\n" + facet + "endsolid wheel\n", "stl"), Kinds{"names of solids"});
    EXPECT_EQ(left_behind_in("solid\n" + facet + "endsolid\nsolid\n" + facet + "endsolid\n", "stl"),
              Kinds{"solids"});
    std::string binary = write_text(awkward_mesh(), "stl");
    binary[84 + 50 + 48] = 1;
    EXPECT_EQ(left_behind_in(binary, "stl"), Kinds{"attribute bytes"});
}

}  // namespace
}  // namespace octavo::io
