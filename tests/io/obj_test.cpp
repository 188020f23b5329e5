// SPDX-License-Identifier: Apache-2.0
#include "from_text.hpp"

namespace octavo::io {
namespace {

using Triangles = std::vector<mesh::Triangle>;

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(Obj, ReadsVerticesAndFacesInOrder) {
    const ReadMesh read = must_read(square + "f 1 2 3\nf 1 3 4\n", "obj");
    EXPECT_EQ(read.mesh.vertices, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
    EXPECT_EQ(read.mesh.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
    EXPECT_TRUE(read.polygon_of_triangle.empty());
    EXPECT_EQ(read.polygons, 2u);
}

TEST(Obj, CountsNegativeIndicesBackFromTheLastVertex) {
    EXPECT_EQ(must_read(square + "f -4 -3 -2\nv 9 9 9\nf -5 -3 -1", "obj").mesh.triangles,
              (Triangles{{0, 1, 2}, {0, 2, 4}}));
}

TEST(Obj, TakesTheVertexOfEveryFormOfACorner) {
    for (const char* face :
         {"f 1 2 3", "f 1/1 2/2 3/3", "f 1/1/1 2/2/2 3/3/3", "f 1//7 2//8 3//9", "f 1/ 2/ 3/",
          "f -4/-4 -3/-3 -2/-2", "f\t1  2\t 3 ", "  f 1 2 3", "f 1 2 3 # comment", "fo 1 2 3"})
        EXPECT_EQ(must_read(square + face + "\n", "obj").mesh.triangles, (Triangles{{0, 1, 2}})) << face;
}

TEST(Obj, IgnoresWeightsColoursAndEverythingElse) {
    const ReadMesh read = must_read(
        "# head\nmtllib some file.mtl\no object\ng group 1\ns off\nv 0 0 0 1.0\nv 1 0 0 0.5 0.25 1\nvt 0 "
        "1\nvn 0 0 1\n"
        "vp 1\nusemtl red\n\nv 1 1 0 1 1 1 1\np 1\nl 1 2\nf 1 2 3\n",
        "obj");
    EXPECT_EQ(read.mesh.vertices, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}));
    EXPECT_EQ(read.mesh.triangles, (Triangles{{0, 1, 2}}));
}

TEST(Obj, ContinuesLinesAfterABackslash) {
    for (const char* face :
         {"f 1 \\\n2 3", "f 1 2 \\\r\n 3", "f 1\\\n 2 3", "f 1/1\\\n 2 3", "f \\\n\\\n1 2 3"})
        EXPECT_EQ(must_read(square + face + "\n", "obj").mesh.triangles, (Triangles{{0, 1, 2}})) << face;
    EXPECT_EQ(must_read("v 0 \\\n0 0\nv 1 0\\\n 0\nv 1 1 0\nf 1 2 3\n", "obj").mesh.vertices.size(), 3u);
    // In a comment or an ignored line too: the continued line is not a face.
    EXPECT_EQ(must_read(square + "g a \\\nf 1 2 4\nf 1 2 3\n", "obj").mesh.triangles, (Triangles{{0, 1, 2}}));
}

TEST(Obj, IsTheSameWithOtherLineEnds) {
    const std::string text = square + "f 1 2 3\nf 1 3 4\n";
    for (const char* end : {"\r\n", "\r", "\n\n"})
        EXPECT_EQ(must_read(replaced(text, "\n", end), "obj").mesh.triangles,
                  (Triangles{{0, 1, 2}, {0, 2, 3}}));
}

TEST(Obj, SplitsPolygonsAndSaysWhichTheyWere) {
    const ReadMesh read = must_read(square + "v 2 2 0\nf 2 5 3\nf 1 2 3 4\nf 3 5 4\n", "obj");
    EXPECT_EQ(read.polygons, 3u);
    EXPECT_EQ(read.triangulated, 1u);
    EXPECT_EQ(read.mesh.triangles.size(), 4u);
    EXPECT_EQ(read.polygon_of_triangle, (std::vector<std::uint32_t>{0, 1, 1, 2}));
    EXPECT_EQ(read.mesh.triangles.front(), (mesh::Triangle{1, 4, 2}));
    EXPECT_EQ(read.mesh.triangles.back(), (mesh::Triangle{2, 4, 3}));
}

TEST(Obj, LetsFacesComeBeforeTheirVertices) {
    EXPECT_EQ(must_read("f 1 2 3\n" + square, "obj").mesh.triangles, (Triangles{{0, 1, 2}}));
}

TEST(Obj, LeavesOutFacesOfFewerThanThreeCorners) {
    const ReadMesh read = must_read(square + "f 1 2\nf\nf 1 2 3\n", "obj");
    EXPECT_EQ(read.mesh.triangles.size(), 1u);
    ASSERT_EQ(read.warnings.size(), 1u);
    EXPECT_THAT(read.warnings[0], testing::HasSubstr("2 faces"));
}

TEST(Obj, NamesTheLineOfWhatIsWrong) {
    expect_refused(square + "f 1 2 5\n", "obj", 5, "names vertex 5 of 4");
    expect_refused(square + "f 1 2 3\nf 1 9 5\nf 1 2 6\n", "obj", 6, "names vertex 9 of 4");
    expect_refused(square + "f 0 1 2\n", "obj", 5, "names vertex 0");
    expect_refused(square + "f 1 2 -5\n", "obj", 5, "names vertex -5 of 4");
    expect_refused(square + "f 1 2 4294967296\n", "obj", 5, "names vertex 4294967296");
    expect_refused(square + "f 1 2 99999999999999999999999999\n", "obj", 5, "of 4");
    expect_refused(square + "f 1 2 x\n", "obj", 5, "found \"x\"");
    expect_refused(square + "f 1 2 3.5\n", "obj", 5, "found \"3.5\"");
    expect_refused("v 0 0\n" + square, "obj", 1, "three numbers");
    expect_refused(square + "\r\nv 0 nan 1\nf 1 2 3", "obj", 6, "not a finite number");
    expect_refused(square + "v 0 1e400 1\nf 1 2 3", "obj", 5, "not a finite number");
    expect_refused(square, "obj", 0, "has no facets");
    expect_refused("f 1 2 3\n", "obj", 1, "names vertex 3 of 0");
}

TEST(Obj, WarnsOfFreeFormSurfaces) {
    EXPECT_EQ(must_read(square + "f 1 2 3\ncurv 0 1 1 2\nsurf 0 1 0 1 1\n", "obj").warnings.size(), 1u);
}

TEST(Obj, KeepsPolygonsWhenAskedForThem) {
    const std::string text = square + "v 2 2 0\nf 2 5 3\nf 1 2 3 4\n";
    const Result<ReadPolygons> read = read_polygons(bytes_of(text), {.format = "obj"});
    ASSERT_TRUE(read);
    EXPECT_EQ(read->mesh.face_begin, (std::vector<std::uint32_t>{0, 1, 2}));
    EXPECT_EQ(read->mesh.contour_begin, (std::vector<std::uint32_t>{0, 3, 7}));
    EXPECT_EQ(read->mesh.corners, (std::vector<mesh::VertexIndex>{1, 4, 2, 0, 1, 2, 3}));
}

TEST(ObjWriter, ReadsBackAsTheSameDoubles) {
    const mesh::Mesh mesh = awkward_mesh();
    const ReadMesh read = must_read(write_text(mesh, "obj"), "obj");
    EXPECT_EQ(read.mesh.vertices, mesh.vertices);
    EXPECT_EQ(read.mesh.triangles, mesh.triangles);
}

}  // namespace
}  // namespace octavo::io
