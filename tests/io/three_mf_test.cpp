// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <octavo/io/zip.hpp>

#include "from_text.hpp"

namespace octavo::io {
namespace {

using Parts = std::vector<std::pair<std::string, std::string>>;

std::string archive_of(const Parts& parts) {
    Output output = Output::to_memory();
    ZipWriter writer(output);
    for (const auto& [name, content] : parts) EXPECT_TRUE(writer.add(name, content));
    EXPECT_TRUE(writer.finish());
    return std::string(text_of(std::move(output).take_memory()));
}

/// A file whose model part is this.
std::string file_of(const std::string& resources, const std::string& build,
                    const std::string& attributes = "") {
    return archive_of(
        {{"3D/3dmodel.model",
          "<?xml version=\"1.0\"?>\n<model xmlns=\"core\" xmlns:p=\"http://x/production/2015\" " +
              attributes + ">\n<resources>\n" + resources + "</resources>\n<build>\n" + build +
              "</build>\n</model>\n"}});
}

const std::string one_triangle =
    "<mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"1\" y=\"0\" z=\"0\"/>"
    "<vertex x=\"0\" y=\"1.5\" z=\"0\"/></vertices><triangles><triangle v1=\"0\" v2=\"1\" v3=\"2\"/>"
    "</triangles></mesh>";
const std::string object_1 = "<object id=\"1\">" + one_triangle + "</object>\n";

TEST(ThreeMf, ReadsTheObjectsOfTheBuild) {
    const ReadMesh read = must_read(
        file_of(object_1 + "<object id=\"2\">" + one_triangle + "</object>", "<item objectid=\"1\"/>"),
        "3mf");
    EXPECT_EQ(read.mesh.vertices, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1.5, 0}}));
    EXPECT_EQ(read.mesh.triangles, (std::vector<mesh::Triangle>{{0, 1, 2}}));
    EXPECT_EQ(read.unit, "millimeter");
    EXPECT_EQ(read.millimetres_per_unit, 1);
}

TEST(ThreeMf, RefusesTwoObjectsOfOneId) {
    expect_refused(file_of(object_1 + object_1, "<item objectid=\"1\"/>"), "3mf", 5,
                   "two objects of the id 1");
}

TEST(ThreeMf, NamesWhatItLeavesBehind) {
    EXPECT_EQ(must_read(file_of(object_1, "<item objectid=\"1\"/>"), "3mf").left_behind,
              std::vector<std::string>{});
    const std::string wheel =
        "<m:colorgroup id=\"7\"/><s:slicestack id=\"8\"/><object id=\"1\" name=\"wheel\">" +
        replaced(one_triangle, "</mesh>", "<b:beamlattice/></mesh>") + "</object>\n";
    EXPECT_EQ(
        must_read(file_of(wheel, "<item objectid=\"1\"/><item objectid=\"1\"/>"), "3mf").left_behind,
        (std::vector<std::string>{"objects", "beam lattices", "materials", "names of objects", "slices"}));
}

TEST(ThreeMf, TellsTheUnit) {
    for (const auto& [unit, scale] : {std::pair{"micron", 0.001},
                                      {"centimeter", 10.0},
                                      {"inch", 25.4},
                                      {"foot", 304.8},
                                      {"meter", 1000.0}}) {
        const ReadMesh read = must_read(
            file_of(object_1, "<item objectid=\"1\"/>", std::string("unit=\"") + unit + "\""), "3mf");
        EXPECT_EQ(read.unit, unit);
        EXPECT_EQ(read.millimetres_per_unit, scale);
        EXPECT_EQ(read.mesh.vertices[2].y, 1.5);
    }
    expect_refused(file_of(object_1, "<item objectid=\"1\"/>", "unit=\"ell\""), "3mf", 2, "unknown unit");
}

TEST(ThreeMf, AppliesTransformsRowByRow) {
    const ReadMesh read = must_read(
        file_of(object_1, "<item objectid=\"1\" transform=\"0 1 0 -1 0 0 0 0 1 10 20 30\"/>"), "3mf");
    // x goes to y, y to -x, then the translation.
    EXPECT_EQ(read.mesh.vertices, (std::vector<Vec3>{{10, 20, 30}, {10, 21, 30}, {8.5, 20, 30}}));
    EXPECT_EQ(read.mesh.triangles[0], (mesh::Triangle{0, 1, 2}));
}

TEST(ThreeMf, TurnsTheFacetsOfMirroredObjects) {
    const ReadMesh read =
        must_read(file_of(object_1, "<item objectid=\"1\" transform=\"-1 0 0 0 1 0 0 0 1 0 0 0\"/>"), "3mf");
    EXPECT_EQ(read.mesh.triangles[0], (mesh::Triangle{0, 2, 1}));
}

TEST(ThreeMf, PutsComponentsOfComponentsIntoPlace) {
    const ReadMesh read = must_read(
        file_of(
            object_1 +
                "<object id=\"2\"><components><component objectid=\"1\"/>"
                "<component objectid=\"1\" transform=\"2 0 0 0 2 0 0 0 2 100 0 0\"/></components></object>"
                "<object id=\"3\"><components><component objectid=\"2\" transform=\"1 0 0 0 1 0 0 0 1 0 7 "
                "0\"/>"
                "</components></object>",
            "<item objectid=\"3\" transform=\"1 0 0 0 1 0 0 0 1 0 0 9\"/><item objectid=\"1\"/>"),
        "3mf");
    ASSERT_EQ(read.mesh.vertices.size(), 9u);
    EXPECT_EQ(read.mesh.vertices[0], (Vec3{0, 7, 9}));
    EXPECT_EQ(read.mesh.vertices[4], (Vec3{102, 7, 9}));
    EXPECT_EQ(read.mesh.vertices[8], (Vec3{0, 1.5, 0}));
    EXPECT_EQ(read.mesh.triangles[2], (mesh::Triangle{6, 7, 8}));
}

TEST(ThreeMf, FollowsTheProductionExtensionIntoOtherParts) {
    const std::string other = "<model xmlns=\"core\"><resources><object id=\"5\">" + one_triangle +
                              "</object><object id=\"6\"><components><component objectid=\"5\"/></components>"
                              "</object></resources><build/></model>";
    const std::string root =
        "<model xmlns=\"core\" xmlns:p=\"http://schemas.microsoft.com/3dmanufacturing/production/2015/06\" "
        "requiredextensions=\"p\"><resources><object id=\"1\"><components>"
        "<component p:path=\"/3D/Objects/part.model\" objectid=\"6\"/></components></object></resources>"
        "<build><item objectid=\"1\"/><item objectid=\"5\" "
        "p:path=\"/3D/objects/part.model\"/></build></model>";
    const std::string relationships =
        "<Relationships><Relationship Target=\"/thumb.png\" Type=\"x/thumbnail\"/><Relationship "
        "Target=\"/3D/root.model\" Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/>"
        "</Relationships>";
    EXPECT_EQ(must_read(archive_of({{"3D/Objects/part.model", other},
                                    {"_rels/.rels", relationships},
                                    {"3D/root.model", root}}),
                        "3mf")
                  .mesh.triangles.size(),
              2u);
    expect_refused(archive_of({{"_rels/.rels", relationships}, {"3D/root.model", root}}), "3mf", 0,
                   "has no part /3D/Objects/part.model");
}

TEST(ThreeMf, LeavesOutSupportsAndTakesAllWhenNothingIsBuilt) {
    const std::string support = "<object id=\"9\" type=\"support\">" + one_triangle + "</object>";
    const ReadMesh read =
        must_read(file_of(object_1 + support, "<item objectid=\"9\"/><item objectid=\"1\"/>"), "3mf");
    EXPECT_EQ(read.mesh.triangles.size(), 1u);
    EXPECT_EQ(read.warnings.size(), 1u);
    const ReadMesh all = must_read(
        file_of(object_1 + "<object id=\"2\"><components><component objectid=\"1\"/></components></object>",
                ""),
        "3mf");
    EXPECT_EQ(all.mesh.triangles.size(), 1u);
    EXPECT_EQ(all.warnings.size(), 1u);
}

TEST(ThreeMf, ReadsPrefixedElementsAndUtf16) {
    std::string xml = "<m:model xmlns:m=\"core\"><m:resources>" + object_1 +
                      "</m:resources><m:build><m:item objectid=\"1\"/></m:build></m:model>";
    EXPECT_EQ(must_read(archive_of({{"a.model", xml}}), "3mf").mesh.triangles.size(), 1u);
    std::string wide = "\xff\xfe";
    for (const char c : xml) wide += c, wide += '\0';
    EXPECT_EQ(must_read(archive_of({{"a.model", wide}}), "3mf").mesh.triangles.size(), 1u);
}

TEST(ThreeMf, NamesTheLineOfWhatIsWrong) {
    const std::string item = "<item objectid=\"1\"/>\n";
    expect_refused(file_of(replaced(object_1, "1.5", "nan"), item), "3mf", 4, "vertex whose y");
    expect_refused(file_of(replaced(object_1, "1.5", "1.5mm"), item), "3mf", 4, "vertex whose y");
    expect_refused(file_of(replaced(object_1, "y=\"1.5\"", ""), item), "3mf", 4, "vertex whose y");
    expect_refused(file_of(replaced(object_1, "v3=\"2\"", "v3=\"3\""), item), "3mf", 4,
                   "none of the object's 3");
    expect_refused(file_of(replaced(object_1, "v3=\"2\"", "v3=\"-1\""), item), "3mf", 4, "v3");
    expect_refused(file_of(object_1, "\n<item objectid=\"1\" transform=\"1 2 3\"/>"), "3mf", 8, "twelve");
    expect_refused(file_of(object_1, "\n<item objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 0 0 0 0\"/>"),
                   "3mf", 8, "twelve");
    expect_refused(file_of(object_1, "\n<item/>"), "3mf", 8, "without naming its id");
    expect_refused(file_of(object_1, "<item objectid=\"2\"/>"), "3mf", 0, "no object 2");
    expect_refused(file_of(object_1 + "<object", item), "3mf", 5, "not well-formed XML");
    expect_refused(archive_of({{"a.txt", ""}}), "3mf", 0, "holds no 3D model");
    expect_refused(file_of(object_1, item, "requiredextensions=\"b\" xmlns:b=\"http://x/beamlattice/2017\""),
                   "3mf", 2, "extension \"b\"");
}

TEST(ThreeMf, RefusesCirclesAndExplosionsOfComponents) {
    expect_refused(file_of("<object id=\"1\"><components><component objectid=\"2\"/></components></object>"
                           "<object id=\"2\"><components><component objectid=\"1\"/></components></object>",
                           "<item objectid=\"1\"/>"),
                   "3mf", 0, "component of itself");
    std::string doubling = object_1, hollow = "<object id=\"1\"/>";
    for (int i = 2; i < 60; ++i) {
        const std::string below = "<component objectid=\"" + std::to_string(i - 1) + "\"/>";
        const std::string object = "<object id=\"" + std::to_string(i) + "\"><components>" + below + below +
                                   "</components></object>";
        doubling += object;
        hollow += object;
    }
    const Result<ReadMesh> read = read_text(file_of(doubling, "<item objectid=\"59\"/>"), "3mf");
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().code, ErrorCode::limit);
    EXPECT_TRUE(must_read(file_of(hollow, "<item objectid=\"59\"/>"), "3mf").mesh.triangles.empty());
    std::string chain = object_1;
    for (int i = 2; i < 100000; ++i)
        chain += "<object id=\"" + std::to_string(i) + "\"><components><component objectid=\"" +
                 std::to_string(i - 1) + "\"/></components></object>";
    const Result<ReadMesh> deep = read_text(file_of(chain, "<item objectid=\"99999\"/>"), "3mf");
    ASSERT_FALSE(deep);
    EXPECT_EQ(deep.error().code, ErrorCode::limit);
}

TEST(ThreeMf, RefusesExplosionsOfVerticesThatFewTrianglesUse) {
    // A hundred vertices and one triangle, eleven times.
    std::string object = "<object id=\"1\"><mesh><vertices>", copies;
    for (int i = 0; i < 100; ++i)
        object += "<vertex x=\"" + std::to_string(i) + "\" y=\"" + std::to_string(i * i) + "\" z=\"0\"/>";
    object += "</vertices><triangles><triangle v1=\"0\" v2=\"1\" v3=\"2\"/></triangles></mesh></object>";
    for (int i = 0; i < 11; ++i) copies += "<component objectid=\"1\"/>";
    const std::string nested = "<object id=\"2\"><components>" + copies + "</components></object>";
    ReadOptions options;
    options.format = "3mf";
    for (const std::string& file : {file_of(object + nested, "<item objectid=\"2\"/>"),
                                    file_of(object, replaced(copies, "component", "item"))}) {
        options.max_triangles = 1000;
        const Result<ReadMesh> read = read_mesh(bytes_of(file), options);
        ASSERT_FALSE(read);
        EXPECT_EQ(read.error().code, ErrorCode::limit);
        EXPECT_THAT(read.error().sentence, testing::HasSubstr("1000 vertices"));
        options.max_triangles = 1100;
        EXPECT_TRUE(read_mesh(bytes_of(file), options));
    }
}

// Looked up one after the other, this many objects and parts took minutes.
TEST(ThreeMf, FindsEachOfManyObjectsAndParts) {
    std::string resources, build;
    for (int id = 1; id <= 100'000; ++id) {
        resources += "<object id=\"" + std::to_string(id) + "\"/>\n";
        build += "<item objectid=\"" + std::to_string(id) + "\"/>\n";
    }
    resources += "<object id=\"100001\">" + one_triangle + "</object>\n";
    build += "<item objectid=\"100001\"/>\n";
    EXPECT_EQ(must_read(file_of(resources, build), "3mf").mesh.triangles.size(), 1U);

    Parts parts{{"3D/3dmodel.model", ""}};
    std::string items;
    constexpr int part_count = 20'000;
    for (int i = 0; i < part_count; ++i) {
        const std::string name = "3D/Part" + std::to_string(i) + ".model";
        parts.emplace_back(name, "<model><resources>" + object_1 + "</resources></model>");
        items += "<item objectid=\"1\" p:path=\"/3d/pART" + std::to_string(i) + ".model\"/>";
    }
    parts[0].second = "<model xmlns=\"core\" xmlns:p=\"http://x/production/2015\"><resources/><build>" +
                      items + "</build></model>";
    EXPECT_EQ(must_read(archive_of(parts), "3mf").mesh.triangles.size(), std::size_t{part_count});
}

TEST(ThreeMf, RefusesBombs) {
    const std::string bomb = file_of(object_1 + std::string(20'000'000, ' '), "<item objectid=\"1\"/>");
    EXPECT_LT(bomb.size(), 200'000u);
    const Result<ReadMesh> read = read_text(bomb, "3mf");
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().code, ErrorCode::limit);
}

TEST(ThreeMfWriter, ReadsBackAsTheSameDoubles) {
    const mesh::Mesh mesh = awkward_mesh();
    const std::string text = write_text(mesh, "3mf");
    EXPECT_EQ(text, write_text(mesh, "3mf"));
    const ReadMesh read = must_read(text, "3mf");
    EXPECT_EQ(read.mesh.vertices, mesh.vertices);
    EXPECT_TRUE(std::signbit(read.mesh.vertices[0].z));
    EXPECT_EQ(read.mesh.triangles, mesh.triangles);
    EXPECT_TRUE(read.warnings.empty());
    EXPECT_EQ(must_read(text, "").format, "3mf");
}

TEST(ThreeMfWriter, StatesTheUnit) {
    const Result<WrittenBytes> written = write_mesh(awkward_mesh(), {.format = "3mf", .unit = "inch"});
    ASSERT_TRUE(written);
    EXPECT_EQ(must_read(text_of(written->bytes), "3mf").unit, "inch");
    EXPECT_EQ(write_mesh(awkward_mesh(), {.format = "3mf", .unit = "ell"}).error().code,
              ErrorCode::unsupported);
}

}  // namespace
}  // namespace octavo::io
