// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <limits>
#include <random>

#include <octavo/io/ply.hpp>
#include <octavo/io/points.hpp>

#include "from_text.hpp"

namespace octavo::io {
namespace {

using Triangles = std::vector<mesh::Triangle>;
const std::vector<Vec3> square_vertices{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

const std::string header_of_square =
    "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 4\nproperty float x\nproperty float y\n"
    "property float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n";
const std::string square = header_of_square + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";

void expect_square(std::string_view text) {
    const ReadMesh read = must_read(text, "ply");
    EXPECT_EQ(read.mesh.vertices, square_vertices);
    EXPECT_EQ(read.mesh.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
}

TEST(PlyHeader, RefusesNamesThatAreAnnouncedTwice) {
    expect_refused(replaced(square, "property float z\n", "property float z\nproperty float x\n"), "ply", 8,
                   "the property x of the element vertex is announced twice");
    expect_refused(replaced(square, "end_header", "element vertex 1\nend_header"), "ply", 10,
                   "the element vertex is announced twice");
    // The same name in another element is another property.
    must_read(replaced(square, "end_header", "element more 0\nproperty float x\nend_header"), "ply");
}

TEST(PlyHeader, TakesTimeInProportionToItsLength) {
    // When each was compared with all before it, this took minutes.
    std::string many;
    for (int i = 0; i < 200'000; ++i) many += "element e" + std::to_string(i) + " 0\nproperty float p\n";
    must_read(replaced(square, "element vertex", many + "element vertex"), "ply");
    many.clear();
    for (int i = 0; i < 200'000; ++i) many += "property float p" + std::to_string(i) + "\n";
    must_read(replaced(square, "end_header", "element more 0\n" + many + "end_header"), "ply");
}

TEST(PlyText, ReadsAnyLayout) {
    expect_square(square);
    expect_square(replaced(square, "\n", "\r\n"));
    expect_square(replaced(square, "\n", "\r"));
    expect_square(replaced(square, "vertex_indices", "vertex_index"));
    expect_square(replaced(square, "float", "double"));
    expect_square(replaced(square, "float", "int16"));
    expect_square(replaced(square, "\nend_header", "\nobj_info x\nend_header"));
    expect_square(replaced(header_of_square, "property float z",
                           "property float z\nproperty uchar red\n"
                           "property list int float weights") +
                  "0 0 0 255 0\n1 0 0 255 2 0.5 nan\n1 1 0 0 1 7\n0 1 0 0 0\n3 0 1 2\n3 0 2 3\n");
    expect_square(
        replaced(replaced(header_of_square, "property float x", "property float nx\nproperty float z"),
                 "property float z\nelement", "property float x\nelement") +
        "9 0 0 0\n9 0 0 1\n9 0 1 1\n9 0 1 0\n3 0 1 2\n3 0 2 3\n");
}

TEST(PlyText, SkipsOtherElementsAndPropertiesOfFaces) {
    expect_square(
        "ply\nformat ascii 1.0\nelement camera 2\nproperty float fov\nproperty list uchar int pixels\n"
        "element vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 2\n"
        "property uchar red\nproperty list uchar float texcoord\nproperty list uint uint vertex_indices\n"
        "property float quality\nelement edge 1\nproperty int a\nend_header\n"
        "45 0\n50 2 1 1\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n255 1 0.5 3 0 1 2 1\n0 0 3 0 2 3 nan\n1\n");
}

TEST(PlyText, ExpandsTriangleStrips) {
    const ReadMesh read = must_read(
        "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
        "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
        "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n9 0 1 2 3 -1 2 3 3 4\n",
        "ply");
    EXPECT_EQ(read.mesh.triangles, (Triangles{{0, 1, 2}, {2, 1, 3}}));
    const ReadMesh stitched = must_read(
        "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
        "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
        "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n6 0 1 2 3 4 -1\n",
        "ply");
    EXPECT_EQ(stitched.mesh.triangles, (Triangles{{0, 1, 2}, {2, 1, 3}, {2, 3, 4}}));
}

TEST(PlyText, NamesTheLineOfWhatIsWrong) {
    expect_refused(replaced(square, "3 0 2 3", "3 0 2 4"), "ply", 16, "names vertex 4 of 4");
    expect_refused(replaced(square, "3 0 2 3", "3 0 -1 3"), "ply", 16, "names vertex -1 of 4");
    expect_refused(replaced(square, "3 0 2 3", "3 0 1.5 3"), "ply", 16, "names vertex 1.5 of 4");
    expect_refused(replaced(square, "3 0 2 3", "-3 0 2 3"), "ply", 16, "length -3 of a list");
    expect_refused(replaced(square, "3 0 2 3", "1e300 0 2 3"), "ply", 16, "past the end");
    expect_refused(replaced(square, "3 0 2 3", "nan 0 2 3"), "ply", 16, "length nan");
    expect_refused(replaced(square, "3 0 2 3", "3 0 2"), "ply", 17, "ends before the last element");
    expect_refused(replaced(square, "1 1 0", "1 nan 0"), "ply", 13, "vertex 2 is not a finite number");
    expect_refused(replaced(square, "1 1 0", "1 b 0"), "ply", 13, "found \"b\"");
    expect_refused(replaced(square, "vertex 4", "vertex 4000000000"), "ply", 11, "rows of vertex");
    expect_refused(replaced(square, "face 2", "face 4000000000"), "ply", 15, "rows of face");
    expect_refused(replaced(square, "face 2", "face 0"), "ply", 0, "has no facets");
}

TEST(PlyText, RefusesVerticesWithoutCoordinatesHoweverTheyAreAnnounced) {
    const std::string faces = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    for (const std::string format : {"ascii", "binary_little_endian"})
        for (const std::string vertices :
             {"element vertex 100\n", "element vertex 100\nproperty list uchar float x\n",
              "element vertex 4294967295\n"}) {
            SCOPED_TRACE(format + ' ' + vertices);
            const std::string row =
                format == "ascii" ? "3 0 1 2\n" : std::string("\3\0\0\0\0\1\0\0\0\2\0\0\0", 13);
            const Result<ReadMesh> read =
                read_text("ply\nformat " + format + " 1.0\n" + vertices + faces + row, "ply");
            ASSERT_FALSE(read);
            EXPECT_EQ(read.error().code, ErrorCode::bad_input);
        }
    // Other elements without properties are nothing at all.
    expect_square(replaced(square, "element face", "element nothing 1000000000000\nelement face"));
}

/// A file of random elements and properties, as nobody would write them but the grammar allows, and a random body.
std::string random_file(std::mt19937& random) {
    const auto one_of = [&](const std::vector<std::string>& words) {
        return words[std::uniform_int_distribution<std::size_t>(0, words.size() - 1)(random)];
    };
    const auto chance = [&](int in) { return std::uniform_int_distribution<int>(1, in)(random) == 1; };
    const std::string format = one_of({"ascii", "binary_little_endian", "binary_big_endian"});
    std::string text = "ply\nformat " + format + " 1.0\n";
    const std::vector<std::string> types{"uchar", "char", "short", "uint", "int", "float", "double"};
    for (const std::string& element : {one_of({"vertex", "vertex", "edge"}), one_of({"face", "tristrips"})}) {
        text += "element " + element + ' ' + one_of({"3", "4", "5", "1", "0", "100", "4294967295", "1e15"}) +
                '\n';
        if (element == "vertex" && !chance(6))
            for (const char* axis : {"x", "y", "z"}) text += "property " + one_of(types) + ' ' + axis + '\n';
        if (element != "vertex" && !chance(6))
            text += "property list " + one_of(types) + ' ' + one_of(types) + " vertex_indices\n";
        while (chance(5)) text += "property " + one_of(types) + " more\n";
    }
    text += "end_header\n";
    const std::string bytes_of_a_face("\3\0\0\0\0\1\0\0\0\2\0\0\0", 13);
    for (int i = 0; i < 60; ++i)
        text += format == "ascii" ? one_of({"0 ", "1 ", "2 ", "3 0 1 2\n", "3 0 1 2\n"})
                                  : one_of({std::string(1, '\0'), "\1", "\2", bytes_of_a_face});
    return text;
}

TEST(PlyHeader, WhateverItSaysTheMeshIsSound) {
    std::mt19937 random(7);
    int meshes = 0;
    for (int round = 0; round < 30000; ++round) {
        const std::string text = random_file(random);
        const Result<ReadMesh> read = read_text(text, "ply");
        if (!read) continue;
        ++meshes;
        for (const mesh::Triangle& triangle : read->mesh.triangles)
            for (const mesh::VertexIndex corner : triangle)
                ASSERT_LT(corner, read->mesh.vertices.size()) << text;
    }
    EXPECT_GT(meshes, 100) << "hardly any file was good, so hardly anything was tested";
}

TEST(PlyHeader, NamesTheLineOfWhatIsWrong) {
    expect_refused(replaced(square, "ascii", "ebcdic"), "ply", 2, "none of ascii");
    expect_refused(replaced(square, "format ascii 1.0\n", ""), "ply", 9, "names no format");
    expect_refused(replaced(square, "float z", "half z"), "ply", 7, "half");
    expect_refused(replaced(square, "element face", "element vertex"), "ply", 8, "twice");
    expect_refused(replaced(square, "face 2", "face two"), "ply", 8, "a name and a count");
    expect_refused(replaced(square, "face 2", "face -2"), "ply", 8, "a name and a count");
    expect_refused(replaced(square, "comment", "commment"), "ply", 3, "\"commment\"");
    expect_refused(replaced(square, "end_header", "comment"), "ply", 11, "\"0\"");
    expect_refused(replaced(square, "float z", "float w"), "ply", 11, "no property z");
    expect_refused(replaced(square, "vertex_indices", "corners"), "ply", 15, "no list vertex_indices");
    expect_refused("ply\nformat ascii 1.0\nproperty float x\nend_header\n", "ply", 3, "before any element");
    expect_refused("plyx\n", "ply", 1, "does not begin");
}

/// Writes values in either byte order.
template <std::endian order>
struct Binary {
    std::string text;
    template <class T>
    Binary& add(std::initializer_list<double> values) {
        for (const double value : values) {
            std::byte bytes[sizeof(T)];
            store<T, order>(bytes, static_cast<T>(value));
            text.append(reinterpret_cast<const char*>(bytes), sizeof bytes);
        }
        return *this;
    }
};

template <std::endian order>
std::string binary_header(const std::string& vertex, const std::string& face) {
    return std::string("ply\nformat binary_") + (order == std::endian::little ? "little" : "big") +
           "_endian 1.0\nelement vertex 4\n" + vertex + "element face 2\n" + face + "end_header\n";
}

template <std::endian order, class Real, class Count, class Index>
void expect_binary_square(const char* real, const char* count, const char* index) {
    const std::string of_real = std::string("property ") + real + " ";
    const std::string list = std::string("property list ") + count + " " + index + " vertex_indices\n";
    Binary<order> plain;
    plain.template add<Real>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
    for (const auto& face : {std::array{0, 1, 2}, std::array{0, 2, 3}})
        plain.template add<Count>({3}).template add<Index>(
            {double(face[0]), double(face[1]), double(face[2])});
    expect_square(binary_header<order>(of_real + "x\n" + of_real + "y\n" + of_real + "z\n", list) +
                  plain.text);

    // The same among other properties, in another order.
    Binary<order> mixed;
    for (const Vec3& vertex : square_vertices)
        mixed.template add<std::uint8_t>({200})
            .template add<Real>({vertex.z, vertex.x})
            .template add<double>({std::nan("")})
            .template add<Real>({vertex.y});
    for (const auto& face : {std::array{0, 1, 2}, std::array{0, 2, 3}})
        mixed.template add<std::int16_t>({-1})
            .template add<Count>({3})
            .template add<Index>({double(face[0]), double(face[1]), double(face[2])})
            .template add<std::uint32_t>({2})
            .template add<float>({1, 2});
    expect_square(binary_header<order>("property uchar red\n" + of_real + "z\n" + of_real +
                                           "x\nproperty double q\n" + of_real + "y\n",
                                       "property short flags\n" + list + "property list uint float uv\n") +
                  mixed.text);
}

TEST(PlyBinary, ReadsEveryTypeInBothByteOrders) {
    constexpr std::endian little = std::endian::little, big = std::endian::big;
    expect_binary_square<little, float, std::uint8_t, std::int32_t>("float", "uchar", "int");
    expect_binary_square<big, float, std::uint8_t, std::int32_t>("float32", "uint8", "int32");
    expect_binary_square<little, double, std::int32_t, std::uint32_t>("double", "int", "uint");
    expect_binary_square<big, double, std::uint32_t, std::uint16_t>("float64", "uint32", "ushort");
    expect_binary_square<little, std::int8_t, std::int16_t, std::uint8_t>("char", "short", "uchar");
    expect_binary_square<big, std::int16_t, std::uint16_t, std::int8_t>("int16", "uint16", "int8");
    expect_binary_square<little, std::uint32_t, std::int8_t, std::int16_t>("uint", "char", "int16");
    expect_binary_square<big, std::int32_t, std::int8_t, std::uint32_t>("int32", "int8", "uint32");
}

TEST(PlyBinary, FindsTheBodyAfterAnyLineEnd) {
    // The first byte of the body is a line feed: the float 1.4e-44 + … in little-endian bytes 0a 00 00 00.
    const float first = std::bit_cast<float>(std::uint32_t{10});
    Binary<std::endian::little> body;
    body.add<float>({double{first}, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
    for (int i = 0; i < 2; ++i) body.add<std::uint8_t>({3}).add<std::int32_t>({0, 1, 2});
    const std::string header = binary_header<std::endian::little>(
        "property float x\nproperty float y\nproperty float z\n", "property list uchar int vertex_indices\n");
    for (const char* end : {"\n", "\r\n", "\r"})
        EXPECT_EQ(must_read(replaced(header, "\n", end) + body.text, "ply").mesh.vertices[0].x,
                  double{first});
}

TEST(PlyBinary, ReadsPolygonsBetweenTriangles) {
    Binary<std::endian::little> body;
    body.add<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
    body.add<std::uint8_t>({3}).add<std::int32_t>({0, 1, 2}).add<std::uint8_t>({4}).add<std::int32_t>(
        {0, 1, 2, 3});
    const ReadMesh read =
        must_read(binary_header<std::endian::little>("property float x\nproperty float y\nproperty float z\n",
                                                     "property list uchar int vertex_indices\n") +
                      body.text,
                  "ply");
    EXPECT_EQ(read.mesh.triangles.size(), 3u);
    EXPECT_EQ(read.polygon_of_triangle, (std::vector<std::uint32_t>{0, 1, 1}));
}

TEST(Ply, WarnsOfBytesAfterTheLastElement) {
    for (const Encoding encoding : {Encoding::automatic, Encoding::ascii}) {
        const std::string file = write_text(awkward_mesh(), "ply", encoding);
        EXPECT_TRUE(must_read(file, "ply").warnings.empty());
        const ReadMesh read = must_read(file + "3 0 1 2", "ply");
        EXPECT_EQ(read.mesh.triangles.size(), 4u);
        ASSERT_EQ(read.warnings.size(), 1u);
        EXPECT_EQ(read.warnings[0], "7 bytes after the last announced element are ignored");
        const Result<ReadPoints> points = read_points(bytes_of(file + "3 0 1 2"));
        ASSERT_TRUE(points);
        EXPECT_EQ(points->warnings, read.warnings);
    }
    EXPECT_TRUE(must_read(square + " \n\r\n", "ply").warnings.empty());
}

TEST(PlyBinary, RefusesEveryTruncationAndEveryBadIndex) {
    const std::string file = write_text(awkward_mesh(), "ply");
    const std::size_t body = file.find("end_header") + 11;
    for (std::size_t size = body; size < file.size(); ++size) {
        const Result<ReadMesh> read = read_text(std::string_view(file).substr(0, size), "ply");
        ASSERT_FALSE(read) << size;
        EXPECT_NE(read.error().place.byte, Place::no_byte) << read.error().describe();
    }
    for (const char* index : {"\xff\xff\xff\xff", "\x04\0\0\0", "\0\0\0\x80"}) {
        std::string bad = file;
        bad.replace(bad.size() - 4, 4, std::string_view(index, 4));
        const Result<ReadMesh> read = read_text(bad, "ply");
        ASSERT_FALSE(read);
        EXPECT_THAT(read.error().sentence, testing::HasSubstr("face 3 names vertex"));
    }
    std::string bad = file;
    bad.replace(body, 8, std::string_view("\0\0\0\0\0\0\xf0\x7f", 8));
    EXPECT_THAT(read_text(bad, "ply").error().sentence,
                testing::HasSubstr("vertex 0 is not a finite number"));
}

TEST(PlyPoints, MayKeepNumbersThatAreNotFinite) {
    const std::string text =
        "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
        "property float z\nend_header\n1 2 3\nnan 0 inf\n";
    const Result<FileMesh> read = read_ply(bytes_of(text), {}, NonFinite::keep);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->vertices[0], (Vec3{1, 2, 3}));
    EXPECT_TRUE(std::isnan(read->vertices[1].x));
    EXPECT_EQ(read->vertices[1].z, std::numeric_limits<double>::infinity());
}

TEST(PlyWriter, ReadsBackAsTheSameDoubles) {
    const mesh::Mesh mesh = awkward_mesh();
    for (const Encoding encoding : {Encoding::automatic, Encoding::ascii}) {
        const std::string text = write_text(mesh, "ply", encoding);
        const ReadMesh read = must_read(text, "ply");
        EXPECT_EQ(read.mesh.vertices, mesh.vertices);
        EXPECT_TRUE(std::signbit(read.mesh.vertices[0].z));
        EXPECT_EQ(read.mesh.triangles, mesh.triangles);
        EXPECT_THAT(text, testing::HasSubstr("property double x"));
    }
}

TEST(PlyWriter, StoresFloatsWhenThatLosesNothing) {
    mesh::Mesh mesh = awkward_mesh();
    for (Vec3& vertex : mesh.vertices)
        for (int axis = 0; axis < 3; ++axis) vertex[axis] = double{static_cast<float>(vertex[axis])};
    const std::string text = write_text(mesh, "ply");
    EXPECT_THAT(text, testing::HasSubstr("property float x"));
    EXPECT_EQ(must_read(text, "ply").mesh.vertices, mesh.vertices);
}

}  // namespace
}  // namespace octavo::io
