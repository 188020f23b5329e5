// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <limits>

#include <octavo/io/vertex_welder.hpp>

#include "from_text.hpp"

namespace octavo::io {
namespace {

const std::string two_facets =
    "solid part one\n"
    "facet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n  vertex 0 1 0\n endloop\nendfacet\n"
    "facet normal 0 0 1\n outer loop\n  vertex 1 0 0\n  vertex 1 1 0\n  vertex 0 1 0\n endloop\nendfacet\n"
    "endsolid part one\n";

/// A binary file with the header `header` and the count `count` before `facets` of 9 floats each.
std::string binary(std::string header, std::uint32_t count, const std::vector<std::array<float, 9>>& facets) {
    header.resize(80, '\0');
    std::string file = header;
    const auto append = [&](auto value) { file.append(reinterpret_cast<const char*>(&value), sizeof value); };
    append(count);
    for (const std::array<float, 9>& facet : facets) {
        for (int i = 0; i < 3; ++i) append(std::numeric_limits<float>::quiet_NaN());
        for (const float coordinate : facet) append(coordinate);
        append(std::uint16_t{0xbeef});
    }
    return file;
}
const std::vector<std::array<float, 9>> some_facets{{0, 0, 0, 1, 0, 0, 0, 1, 0}, {1, 0, 0, 1, 1, 0, 0, 1, 0}};

TEST(StlText, WeldsCornersInOrderOfAppearance) {
    const ReadMesh read = must_read(two_facets, "stl");
    EXPECT_EQ(read.mesh.vertices, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}));
    EXPECT_EQ(read.mesh.triangles, (std::vector<mesh::Triangle>{{0, 1, 2}, {1, 3, 2}}));
    EXPECT_TRUE(read.warnings.empty());
}

TEST(StlText, KeepsDoublesThatDifferInTheLastBitApart) {
    const ReadMesh read =
        must_read(replaced(two_facets, "vertex 1 1 0", "vertex 1.0000000000000002 0 0"), "stl");
    EXPECT_EQ(read.mesh.vertices.size(), 4u);
    EXPECT_EQ(read.mesh.vertices[3].x, 1.0000000000000002);
}

TEST(StlText, TakesNegativeZeroAsZero) {
    const ReadMesh read = must_read(
        replaced(two_facets, "vertex 1 0 0\n  vertex 1 1 0", "vertex 1 -0 -0.0\n vertex 1 1 0"), "stl");
    EXPECT_EQ(read.mesh.vertices.size(), 4u);
    EXPECT_FALSE(std::signbit(read.mesh.vertices[1].y));
}

TEST(StlText, IsTheSameWithOtherLineEndsCaseAndSpacing) {
    const ReadMesh plain = must_read(two_facets, "stl");
    std::string upper = two_facets;
    for (char& c : upper) c = static_cast<char>(std::toupper(c));
    for (const std::string& other :
         {replaced(two_facets, "\n", "\r\n"), replaced(two_facets, "\n", "\r"), upper,
          replaced(two_facets, "vertex", "\tvertex  \t"), "\n \n" + two_facets,
          replaced(two_facets, "normal 0 0 1", "normal nan -nan(ind) inf")}) {
        const ReadMesh read = must_read(other, "stl");
        EXPECT_EQ(read.mesh.vertices, plain.mesh.vertices) << other;
        EXPECT_EQ(read.mesh.triangles, plain.mesh.triangles) << other;
    }
}

TEST(StlText, JoinsSeveralSolidsIntoOneMesh) {
    const std::string second = replaced(replaced(two_facets, "vertex 0 0 0", "vertex 5 5 5"), "part one", "");
    const ReadMesh read = must_read(two_facets + second, "stl");
    EXPECT_EQ(read.mesh.triangles.size(), 4u);
    EXPECT_EQ(read.mesh.vertices.size(), 5u);
}

TEST(StlText, TakesAnyNameOfASolid) {
    for (const char* name : {"", " ", "a b c", "facet normal 1 2 3", "endsolid", "solid", "\xc3\xa4"})
        EXPECT_EQ(must_read(replaced(two_facets, "part one", name), "stl").mesh.triangles.size(), 2u) << name;
}

TEST(StlText, MayStandOnOneLine) {
    const ReadMesh plain = must_read(two_facets, "stl");
    const std::string second = replaced(two_facets, "vertex 0 0 0", "vertex 5 5 5");
    for (const char* name : {"part one", "", "Facet", "a facet normal 1 2 3 of it", "endsolid"}) {
        const std::string text = replaced(replaced(two_facets, "part one", name), "\n", " ");
        const ReadMesh read = must_read(text, "stl");
        EXPECT_EQ(read.mesh.vertices, plain.mesh.vertices) << text;
        EXPECT_EQ(read.mesh.triangles, plain.mesh.triangles) << text;
        EXPECT_TRUE(read.warnings.empty()) << text;
    }
    EXPECT_EQ(must_read(replaced(two_facets + second, "\n", " "), "stl").mesh.triangles.size(), 4u);
    expect_refused(replaced(replaced(two_facets, "\n", " "), "vertex 1 1 0", "vertex 1 1"), "stl", 1,
                   "a coordinate, found \"vertex\"");
}

TEST(StlText, WarnsWhenTheEndIsMissing) {
    const ReadMesh read = must_read(two_facets.substr(0, two_facets.find("endsolid")), "stl");
    EXPECT_EQ(read.mesh.triangles.size(), 2u);
    EXPECT_EQ(read.warnings.size(), 1u);
}

TEST(StlText, NamesTheLineOfWhatIsWrong) {
    expect_refused(replaced(two_facets, "vertex 1 1 0", "vertex 1 nan 0"), "stl", 12, "not a finite number");
    expect_refused(replaced(two_facets, "vertex 1 1 0", "vertex 1 1 inf"), "stl", 12, "not a finite number");
    expect_refused(replaced(two_facets, "vertex 1 1 0", "vertex 1 1e999 0"), "stl", 12,
                   "not a finite number");
    expect_refused(replaced(two_facets, "vertex 1 1 0", "vertex 1 1"), "stl", 13,
                   "a coordinate, found \"vertex\"");
    expect_refused(replaced(two_facets, "vertex 1 1 0", "vertex 1 1,5 0"), "stl", 12, "found \"1,5\"");
    expect_refused(replaced(two_facets, "vertex 1 1 0", "vertex 1 1 0\nvertex 2 2 2"), "stl", 14, "endloop");
    expect_refused(replaced(two_facets, "endloop", ""), "stl", 8, "endloop");
    expect_refused(two_facets.substr(0, two_facets.size() / 2), "stl", 9, "found ");
    expect_refused(two_facets + "rubbish", "stl", 17, "found \"rubbish\"");
    expect_refused("solid cut off\n", "stl", 2, "facet");
}

TEST(StlBinary, ReadsFacetsAndIgnoresNormalsAndAttributes) {
    const ReadMesh read = must_read(binary("any header", 2, some_facets), "stl");
    const ReadMesh text = must_read(two_facets, "stl");
    EXPECT_EQ(read.mesh.vertices, text.mesh.vertices);
    EXPECT_EQ(read.mesh.triangles, text.mesh.triangles);
}

TEST(StlBinary, IsKnownBySizeWhenTheHeaderSaysSolid) {
    EXPECT_EQ(must_read(binary("solid a name\n facet normal", 2, some_facets), "stl").mesh.triangles.size(),
              2u);
    std::string spaces = "solid";
    spaces.resize(80, ' ');
    EXPECT_EQ(must_read(binary(spaces, 2, some_facets), "stl").mesh.triangles.size(), 2u);
    // Even when the size is wrong: text has no zero bytes.
    EXPECT_EQ(must_read(binary("solid a name", 2, some_facets) + "tail", "stl").mesh.triangles.size(), 2u);
}

TEST(StlBinary, WarnsOfBytesAfterTheLastFacet) {
    const ReadMesh read = must_read(binary("header", 1, some_facets), "stl");
    EXPECT_EQ(read.mesh.triangles.size(), 1u);
    ASSERT_EQ(read.warnings.size(), 1u);
    EXPECT_THAT(read.warnings[0], testing::HasSubstr("50 bytes"));
}

TEST(StlBinary, NeverTrustsTheCount) {
    for (const std::uint32_t count : {3u, 1000u, 0xffffffffu}) {
        const Result<ReadMesh> read = read_text(binary("header", count, some_facets), "stl");
        ASSERT_FALSE(read);
        EXPECT_EQ(read.error().code, ErrorCode::bad_input);
        EXPECT_THAT(read.error().sentence, testing::HasSubstr("the file ends after 2"));
        EXPECT_EQ(read.error().place.byte, 184u);
    }
    EXPECT_THAT(read_text(binary("header", 0, some_facets), "stl").error().sentence,
                testing::HasSubstr("announces no facets"));
    EXPECT_THAT(read_text("short", "stl").error().sentence, testing::HasSubstr("ends within"));
}

TEST(StlBinary, NamesTheByteOfANumberThatIsNotFinite) {
    for (const float bad :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        auto facets = some_facets;
        facets[1][4] = bad;
        const Result<ReadMesh> read = read_text(binary("header", 2, facets), "stl");
        ASSERT_FALSE(read);
        EXPECT_EQ(read.error().place.byte, 84u + 50 + 12 + 12);
    }
}

TEST(StlWriter, TextReadsBackAsTheSameDoubles) {
    const mesh::Mesh mesh = awkward_mesh();
    const ReadMesh read = must_read(write_text(mesh, "stl", Encoding::ascii), "stl");
    EXPECT_EQ(read.mesh.vertices, mesh.vertices);
    EXPECT_EQ(read.mesh.triangles, mesh.triangles);
}

TEST(StlWriter, BinaryRoundsToFloatsAndSaysByHowMuch) {
    WriteOptions options;
    options.format = "stl";
    const mesh::Mesh mesh = awkward_mesh();
    const Result<WrittenBytes> written = write_mesh(mesh, options);
    ASSERT_TRUE(written);
    EXPECT_EQ(written->bytes.size(), 84u + 4 * 50);
    EXPECT_EQ(written->report.largest_displacement, std::abs(double{static_cast<float>(1e17)} - 1e17));
    EXPECT_EQ(written->report.warnings.size(), 1u);
    const ReadMesh read = must_read(text_of(written->bytes), "stl");
    EXPECT_EQ(read.mesh.vertices[2].x, double{static_cast<float>(-123456.789)});
    EXPECT_FALSE(text_of(written->bytes).starts_with("solid"));
}

TEST(StlWriter, CountsFacetsThatRoundingCollapses) {
    mesh::Mesh mesh;
    mesh.vertices = {{1, 0, 0}, {1 + 1e-12, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 0, 1}};
    WriteOptions options;
    options.format = "stl";
    const Result<WrittenBytes> written = write_mesh(mesh, options);
    ASSERT_TRUE(written);
    ASSERT_EQ(written->report.warnings.size(), 2u);
    EXPECT_THAT(written->report.warnings[1], testing::HasSubstr("1 facets"));
}

TEST(StlWriter, RefusesWhatNoFloatHolds) {
    mesh::Mesh mesh = awkward_mesh();
    mesh.vertices[0].x = 1e39;
    WriteOptions options;
    options.format = "stl";
    EXPECT_EQ(write_mesh(mesh, options).error().code, ErrorCode::limit);
}

TEST(VertexWelder, AgreesWithBruteForceOnPointsThatRepeat) {
    std::vector<std::array<float, 3>> points;
    std::uint32_t state = 1;
    const auto next = [&] { return static_cast<float>((state = state * 1664525 + 1013904223) >> 28) - 8; };
    for (int i = 0; i < 3000; ++i) points.push_back({next() / 3, -next(), next() * 0});
    VertexWelder<float> welder(3);
    std::vector<std::array<float, 3>> seen;
    for (const auto& point : points) {
        const auto found = std::find(seen.begin(), seen.end(), point);
        const auto expected = static_cast<mesh::VertexIndex>(found - seen.begin());
        if (found == seen.end()) seen.push_back(point);
        ASSERT_EQ(welder.add(welder.prepare(point[0], point[1], point[2])), expected);
    }
    EXPECT_EQ(welder.vertices().size(), seen.size());
}

}  // namespace
}  // namespace octavo::io
