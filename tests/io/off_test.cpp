// SPDX-License-Identifier: Apache-2.0
#include "from_text.hpp"

namespace octavo::io {
namespace {

using Triangles = std::vector<mesh::Triangle>;

void expect_square(std::string_view text) {
    const ReadMesh read = must_read(text, "off");
    EXPECT_EQ(read.mesh.vertices, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}})) << text;
    EXPECT_EQ(read.mesh.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}})) << text;
}

const std::string square_body = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";

TEST(Off, TakesTheCountsWhereverTheyStand) {
    expect_square("OFF\n4 2 0\n" + square_body);
    expect_square("OFF 4 2 0\n" + square_body);  // as OpenSCAD 2021.01 writes it
    expect_square("OFF 4 2\n" + square_body);    // edges left out
    expect_square("OFF4 2 0\n" + square_body);   // as in the ModelNet collection
    expect_square("OFF\n\n# a comment\n4 2 5 # more\n" + square_body);
    expect_square("4 2 0\n" + square_body);  // the header word is optional
    expect_square("# first\nOFF # second\n4 2 0\n# third\n" + replaced(square_body, "\n", " # each\n\n"));
    expect_square(replaced("OFF\n4 2 0\n" + square_body, "\n", "\r\n"));
    expect_square(replaced("OFF\n4 2 0\n" + square_body, "\n", "\r"));
}

TEST(Off, LeavesOutWhatTheVariantsAdd) {
    expect_square(
        "COFF\n4 2 0\n0 0 0 255 0 0 255\n1 0 0 0.5 0.5 0.5 1\n1 1 0 1 1 1\n0 1 0\n3 0 1 2\n3 0 2 3\n");
    expect_square("NOFF\n4 2 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n1 1 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2\n3 0 2 3\n");
    expect_square("STOFF\n4 2 0\n0 0 0 0 0\n1 0 0 1 0\n1 1 0 1 1\n0 1 0 0 1\n3 0 1 2\n3 0 2 3\n");
    expect_square("STCNOFF 4 2 0\n0 0 0 0 0 1 1 1 1 1 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n");
    expect_square("4OFF\n4 2 0\n0 0 0 1\n1 0 0 1\n1 1 0 1.0\n0 1 0 1e0\n3 0 1 2\n3 0 2 3\n");
    expect_square("nOFF 3\n4 2 0\n" + square_body);
}

TEST(Off, LeavesOutColoursOfFaces) {
    expect_square("OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 7\n3 0 2 3 255 128 0\n");
    expect_square("OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 0.5 0.5 0.5\n3 0 2 3 1.0 0 0 0.25\n");
    expect_square("OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 3 3 3\n3 0\n2 3 # wrapped\n");
}

TEST(Off, SplitsPolygonsAndLeavesOutEdges) {
    const ReadMesh read =
        must_read("OFF\n4 3 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3 255 0 0\n2 0 1\n3 0 1 3", "off");
    EXPECT_EQ(read.mesh.triangles.size(), 3u);
    EXPECT_EQ(read.polygon_of_triangle, (std::vector<std::uint32_t>{0, 0, 1}));
    EXPECT_EQ(read.warnings.size(), 1u);
}

TEST(Off, WarnsOfWhatFollowsTheLastFace) {
    const std::string text = "OFF\n4 2 0\n" + square_body;
    EXPECT_TRUE(must_read(text + " \n# tail\n", "off").warnings.empty());
    EXPECT_EQ(must_read(text + "3 0 1 3\n", "off").warnings,
              std::vector<std::string>{"8 bytes after the last announced face are ignored"});
}

TEST(Off, RefusesOtherDimensions) {
    for (const char* text : {"nOFF 4\n1 1 0\n0 0 0 0\n3 0 0 0", "4nOFF 3\n1 1 0\n0 0 0 1\n3 0 0 0\n",
                             "4OFF\n1 1 0\n0 0 0 2\n3 0 0 0\n"}) {
        const Result<ReadMesh> read = read_text(text, "off");
        ASSERT_FALSE(read) << text;
        EXPECT_EQ(read.error().code, ErrorCode::unsupported) << text;
    }
}

TEST(Off, NamesTheLineOfWhatIsWrong) {
    const std::string text = "OFF\n4 2 0\n" + square_body;
    expect_refused(replaced(text, "3 0 2 3", "3 0 2 4"), "off", 8, "names vertex 4 of 4");
    expect_refused(replaced(text, "3 0 2 3", "3 0 2 -1"), "off", 8, "found \"-1\"");
    expect_refused(replaced(text, "3 0 2 3", "3 0 2 1.5"), "off", 8, "found \"1.5\"");
    expect_refused(replaced(text, "3 0 2 3", "3 0 2"), "off", 9, "the end of the file");
    expect_refused(replaced(text, "3 0 2 3", "4000000000 0 2 3"), "off", 8, "runs past the end");
    expect_refused(replaced(text, "1 1 0", "1 inf 0"), "off", 5, "not a finite number");
    expect_refused(replaced(text, "1 1 0", "1 x 0"), "off", 5, "found \"x\"");
    expect_refused(replaced(text, "4 2 0", "4000000000 2 0"), "off", 3, "more than the file can hold");
    expect_refused(replaced(text, "4 2 0", "4 4000000000 0"), "off", 3, "more than the file can hold");
    expect_refused(replaced(text, "4 2 0", "4 3 0"), "off", 9, "the end of the file");
    expect_refused(replaced(text, "4 2 0", "-4 2 0"), "off", 2, "the number of vertices");
    expect_refused("OFX\n" + text, "off", 1, "found \"OFX\"");
    expect_refused("OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n", "off", 0, "has no facets");
}

/// 32-bit big-endian numbers.
struct BigEndian {
    std::string text;
    BigEndian& integers(std::initializer_list<std::uint32_t> values) {
        for (const std::uint32_t value : values)
            for (int shift = 24; shift >= 0; shift -= 8) text += static_cast<char>(value >> shift);
        return *this;
    }
    BigEndian& floats(std::initializer_list<float> values) {
        for (const float value : values) integers({std::bit_cast<std::uint32_t>(value)});
        return *this;
    }
};

TEST(OffBinary, ReadsAllVariants) {
    BigEndian body;
    body.integers({4, 2, 0}).floats({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
    body.integers({3, 0, 1, 2, 0}).integers({3, 0, 2, 3, 3}).floats({1, 0, 0});
    expect_square("OFF BINARY\n" + body.text);
    expect_square("OFF BINARY\r\n" + body.text);
    BigEndian coloured;
    coloured.integers({4, 2, 0});
    coloured.floats({0, 0, 0, 9, 9, 9, 9}).floats({1, 0, 0, 9, 9, 9, 9});
    coloured.floats({1, 1, 0, 9, 9, 9, 9}).floats({0, 1, 0, 9, 9, 9, 9});
    coloured.integers({3, 0, 1, 2, 0}).integers({3, 0, 2, 3, 0});
    expect_square("COFF BINARY\n" + coloured.text);
}

TEST(OffBinary, NeverTrustsCounts) {
    BigEndian body;
    body.integers({3, 1, 0}).floats({0, 0, 0, 1, 0, 0, 1, 1, 0}).integers({3, 0, 1, 2, 0});
    const std::string file = "OFF BINARY\n" + body.text;
    EXPECT_TRUE(read_text(file, "off"));
    for (std::size_t size = 11; size < file.size(); ++size) {
        const Result<ReadMesh> read = read_text(std::string_view(file).substr(0, size), "off");
        ASSERT_FALSE(read) << size;
        EXPECT_NE(read.error().place.byte, Place::no_byte);
    }
    for (std::size_t at = 11; at + 4 < file.size(); at += 4) {
        std::string lying = file;
        lying.replace(at, 4, "\x7f\xff\xff\xf0");
        const Result<ReadMesh> read = read_text(lying, "off");
        const bool is_edges = at == 19;  // their number means nothing
        EXPECT_EQ(read.has_value(), is_edges) << at;
    }
}

TEST(OffWriter, ReadsBackAsTheSameDoubles) {
    const mesh::Mesh mesh = awkward_mesh();
    const ReadMesh read = must_read(write_text(mesh, "off"), "off");
    EXPECT_EQ(read.mesh.vertices, mesh.vertices);
    EXPECT_EQ(read.mesh.triangles, mesh.triangles);
}

}  // namespace
}  // namespace octavo::io
