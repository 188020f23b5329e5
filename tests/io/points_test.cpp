// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <limits>

#include <octavo/io/columns.hpp>
#include <octavo/io/points.hpp>

#include "from_text.hpp"

namespace octavo::io {
namespace {

using Points = std::vector<Vec3>;

Points points_in(std::string_view text, const char* format = "csv") {
    const Result<ReadPoints> read = read_points(bytes_of(text), {.format = format});
    EXPECT_TRUE(read) << read.error().describe() << "\nin\n" << text;
    return read ? read->points : Points{};
}

void expect_points_refused(std::string_view text, std::uint64_t line, const char* part,
                           const char* format = "csv") {
    const Result<ReadPoints> read = read_points(bytes_of(text), {.format = format});
    ASSERT_FALSE(read) << text;
    EXPECT_THAT(read.error().sentence, testing::HasSubstr(part));
    EXPECT_EQ(read.error().place.line, line) << text;
}

const Points two_points{{1, 2.5, -3e-5}, {4, 5, 6}};

TEST(PointText, RefusesTwoColumnsOfOneAxis) {
    expect_points_refused("# head\nx,y,z,X\n1,2,3,4\n", 2, "a second column is named X");
    EXPECT_EQ(points_in("x,y,z,t,t\n1,2,3,4,5\n"), (Points{{1, 2, 3}}));
}

TEST(PointText, ReadsAnySeparatorWithOrWithoutNames) {
    for (const char* text :
         {"1,2.5,-3e-5\n4,5,6\n", "1;2.5;-3e-5\n4;5;6", "1 2.5 -3e-5\n4  5\t6\n",
          "1\t2.5\t-3e-5\r\n4\t5\t6\r\n", "x,y,z\n1,2.5,-3e-5\n4,5,6\n", "a b c\n1 2.5 -3e-5\n4 5 6",
          "# head\n\n 1 , 2.5 , -3e-5 # tail\n\n#\n4,5,6\n", "1 2.5 -3e-5 # left, right; front\n4 5 6\n",
          "1,2.5,-3e-5,7\n4,5,6,\n", "\xef\xbb\xbfx;y;z\n1;2.5;-3e-5\n4;5;6",
          "\"x\",\"y\",\"z\"\n\"1\",\"2.5\",\"-3e-5\"\n4,5,6\n"})
        EXPECT_EQ(points_in(text), two_points) << text;
}

TEST(PointText, FindsItsColumnsByName) {
    EXPECT_EQ(points_in("distance,x,y,z,triangle\n0.5,1,2.5,-3e-5,7\n0,4,5,6,9\n"), two_points);
    EXPECT_EQ(points_in("Z;q;Y;X\n-3e-5;;2.5;1\n6;a;5;4\n"), two_points);
}

TEST(PointText, KeepsNumbersThatAreNotFinite) {
    const Points points = points_in("nan,1,2\n3,inf,-inf\n");
    ASSERT_EQ(points.size(), 2u);
    EXPECT_TRUE(std::isnan(points[0].x));
    EXPECT_EQ(points[1].y, std::numeric_limits<double>::infinity());
}

TEST(PointText, MayHoldNoPoints) { EXPECT_EQ(points_in("x,y,z\n"), Points{}); }

TEST(PointText, NeverTakesNumbersForNames) {
    // Decimal commas: what stands between semicolons is no number, but no name either.
    expect_points_refused("0,1;0,1;0,1\n", 1, "found \"0,1\"");
    expect_points_refused("# head\n0,1;0,2;0,3\n1;2;3\n", 2, "found \"0,1\"");
    expect_points_refused("-1x 2x 3x\n1 2 3\n", 1, "found \"-1x\"");
    expect_points_refused("x;.5.;z\n1;2;3\n", 1, "found \"x\"");
    EXPECT_EQ(points_in("infeed nanometres y0\n1 2.5 -3e-5\n4 5 6\n"), two_points);
}

TEST(PointText, RefusesNamesThatDoNotSayWhichColumnsAreMeant) {
    expect_points_refused("id,lon,lat,height\n7,1,2,3\n", 1, "columns named x, y and z");
    expect_points_refused("id,x,y\n7,1,2\n", 1, "found \"id,x,y\"");
    expect_points_refused("x,y\n1,2\n", 1, "columns named x, y and z");
    expect_points_refused("hello\n", 1, "columns named x, y and z");
}

TEST(PointText, RefusesFilesWithoutAnyLineAsEmpty) {
    for (const char* text : {"\n", " \n\t\r\n", "# only a comment\n", "\xef\xbb\xbf\n", "these are words\n"})
        expect_points_refused(text, 0, "has no points");
}

TEST(PointText, RefusesLinesOfOtherColumnsThanTheFirst) {
    expect_points_refused("x,y,z\n1,2,3\n4,5,6,7\n", 3, "the first line has 3 columns, this line has 4");
    expect_points_refused("x,y,z,w\n1,2,3\n", 2, "the first line has 4 columns, this line has 3");
    expect_points_refused("1 2 3\n4 5 6 7\n", 2, "this line has 4");
}

TEST(PointText, NamesTheLineOfWhatIsWrong) {
    expect_points_refused("1,2,3\n4,5\n", 2, "has 2");
    expect_points_refused("1,2\n4,5\n", 1, "needs 3 columns, this line has 2");
    expect_points_refused("x,y,z\n1,2,3\n4,five,6\n", 3, "found \"five\"");
    expect_points_refused("1;2,5;3\n", 1, "found \"2,5\"");
    expect_points_refused("1,2,3\n\n4,,6\n", 3, "found \"\"");
    expect_points_refused("x,y,z\nx,y,z\n", 2, "found \"x\"");
    expect_points_refused("", 0, "is empty");
}

/// An NPY file of version `version`.
std::string npy(int version, std::string header, std::string_view data) {
    std::string file = "\x93NUMPY";
    file += static_cast<char>(version);
    file += '\0';
    const auto size = static_cast<std::uint32_t>(header.size());
    file.append(reinterpret_cast<const char*>(&size), version == 1 ? 2 : 4);
    return file + header + std::string(data);
}

template <class T, std::endian order>
std::string array_of(std::initializer_list<double> values) {
    std::string result;
    for (const double value : values) {
        std::byte bytes[sizeof(T)];
        store<T, order>(bytes, static_cast<T>(value));
        result.append(reinterpret_cast<const char*>(bytes), sizeof bytes);
    }
    return result;
}

TEST(Npy, ReadsBothLayoutsTypesAndByteOrders) {
    constexpr std::endian little = std::endian::little, big = std::endian::big;
    const Points points{{1, 2, 3}, {4, 5, 6}};
    EXPECT_EQ(points_in(npy(1, "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }\n",
                            array_of<double, little>({1, 2, 3, 4, 5, 6})),
                        "npy"),
              points);
    EXPECT_EQ(points_in(npy(2, "{'descr': '>f4', 'fortran_order': False, 'shape': (2, 3), }   \n",
                            array_of<float, big>({1, 2, 3, 4, 5, 6})),
                        ""),
              points);
    EXPECT_EQ(points_in(npy(3, "{\"shape\":(2,3),\"descr\":\"<f4\",\"fortran_order\":True}",
                            array_of<float, little>({1, 4, 2, 5, 3, 6})),
                        "npy"),
              points);
    EXPECT_EQ(points_in(npy(1, "{'descr': '<i8', 'fortran_order': False, 'shape': (2, 3), }\n",
                            array_of<std::int64_t, little>({1, 2, 3, 4, 5, 6})),
                        "npy"),
              points);
}

TEST(Npy, NeverTrustsTheHeader) {
    const std::string data = array_of<double, std::endian::little>({1, 2, 3, 4, 5, 6});
    const auto sentence = [&](const std::string& header) {
        const std::string file = npy(1, header, data);
        const Result<ReadPoints> read = read_points(bytes_of(file), {.format = "npy"});
        return read ? std::string() : read.error().sentence;
    };
    EXPECT_EQ(sentence("{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }"), "");
    EXPECT_THAT(sentence("{'descr': '<f8', 'fortran_order': False, 'shape': (3, 3), }"),
                testing::HasSubstr("after 2"));
    EXPECT_THAT(sentence("{'descr': '<f8', 'fortran_order': False, 'shape': (999999999999999999, 3), }"),
                testing::HasSubstr("after 2"));
    for (const char* shape : {"(6,)", "()", "(3, 2)", "(2, 3, 1)", "(2 3)", "2, 3", "(-2, 3)", "(2, 3", ""})
        EXPECT_THAT(sentence("{'descr': '<f8', 'fortran_order': False, 'shape': " + std::string(shape) + "}"),
                    testing::HasSubstr("shape"))
            << shape;
    for (const char* type : {"'<c8'", "'|O'", "'|u1'", "[('x', '<f8')]", "'<f2'", "'", ""})
        EXPECT_THAT(sentence("{'fortran_order': False, 'shape': (2, 3), 'descr': " + std::string(type) + "}"),
                    testing::HasSubstr("holds"))
            << type;
    const std::string file = npy(1, "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }", data);
    for (std::size_t size = 1; size < file.size(); ++size)
        EXPECT_FALSE(read_points(bytes_of(std::string_view(file).substr(0, size)), {.format = "npy"}))
            << size;
}

TEST(Points, ComeFromTheVerticesOfPly) {
    const std::string file = write_text(awkward_mesh(), "ply");
    EXPECT_EQ(points_in(file, ""), awkward_mesh().vertices);
}

const std::vector<double> distances{-0.5, 1.0 / 3};
const std::vector<std::uint32_t> triangles{7, 4294967295u};
const std::vector<std::int8_t> sides{-1, 1};

TEST(Columns, BecomeCsvWithShortestNumbers) {
    const Column columns[] = {{"distance", distances}, {"triangle", triangles}, {"side", sides}};
    const Result<WrittenBytes> written = write_columns(columns, {.format = "csv"});
    ASSERT_TRUE(written);
    EXPECT_EQ(text_of(written->bytes),
              "distance,triangle,side\n-0.5,7,-1\n0.3333333333333333,4294967295,1\n");
}

TEST(Columns, BecomeAPlainArrayOrOneOfRecords) {
    const Column side[] = {{"side", sides}};
    const Result<WrittenBytes> plain = write_columns(side, {.format = "npy"});
    ASSERT_TRUE(plain);
    EXPECT_EQ(plain->bytes.size() % 64, 2u);
    EXPECT_THAT(std::string(text_of(plain->bytes)),
                testing::HasSubstr("{'descr': '|i1', 'fortran_order': False, 'shape': (2,), }"));
    EXPECT_TRUE(text_of(plain->bytes).ends_with("\n\xff\x01"));
    const Column columns[] = {{"distance", distances}, {"triangle", triangles}};
    const Result<WrittenBytes> records = write_columns(columns, {.format = "npy"});
    ASSERT_TRUE(records);
    EXPECT_EQ(records->bytes.size() % 64, 24u);
    EXPECT_THAT(std::string(text_of(records->bytes)),
                testing::HasSubstr("[('distance', '<f8'), ('triangle', '<u4')]"));
    EXPECT_EQ(load<double>(records->bytes.data() + records->bytes.size() - 12), 1.0 / 3);
}

TEST(Columns, BecomePlyThatReadsBack) {
    const std::vector<double> x{1, 4}, y{2.5, 5}, z{-3e-5, 6};
    const Column columns[] = {{"side", sides}, {"x", x}, {"triangle", triangles}, {"y", y}, {"z", z}};
    const Result<WrittenBytes> written = write_columns(columns, {.format = "ply"});
    ASSERT_TRUE(written);
    EXPECT_EQ(points_in(text_of(written->bytes), "ply"), two_points);
}

TEST(Columns, RefuseOtherFormats) {
    const Column columns[] = {{"side", sides}};
    EXPECT_EQ(write_columns(columns, {.format = "stl"}).error().code, ErrorCode::unsupported);
}

}  // namespace
}  // namespace octavo::io
