// SPDX-License-Identifier: Apache-2.0
#include <fstream>

#include <octavo/mesh/measure.hpp>
#include <octavo/mesh/shapes.hpp>
#include <octavo/mesh/snap.hpp>
#include <octavo/mesh/validate.hpp>

#include "folder.hpp"
#include "from_text.hpp"

namespace octavo::io {
namespace {

/// Exact for the small integers here.
double volume_of(const mesh::Mesh& mesh) {
    double sum = 0;
    for (const auto& [a, b, c] : mesh.triangles)
        sum += dot(mesh.vertices[a], cross(mesh.vertices[b], mesh.vertices[c]));
    return sum / 6;
}
/// The same, of facets across one axis.
double area_of(const mesh::Mesh& mesh) {
    double sum = 0;
    for (const auto& [a, b, c] : mesh.triangles)
        sum += length(cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]));
    return sum / 2;
}

/// A cube of side 6 with a square shaft through it, as TetGen has it: contours and hole points.
const std::string pierced = R"(# Part 1: points
16 3 0 0   # number, dimension, attributes, markers
1 0 0 0
2 6 0 0
3 6 6 0
4 0 6 0
5 0 0 6
6 6 0 6
7 6 6 6
8 0 6 6
9 2 2 0
10 4 2 0
11 4 4 0
12 2 4 0
13 2 2 6
14 4 2 6
15 4 4 6
16 2 4 6
# Part 2: facets
10 1
2 1 7     # contours, hole points, marker
4 1 4 3 2
4 9 10 11 12
1 3 3 0
2 1
4 5 6 7 8
4 13 16 15
  14      # goes on
1 3 3 6
1
4 1 2 6 5
1
4 2 3 7 6
1
4 3 4 8 7
1
4 4 1 5 8
1
4 9 13 14 10
1
4 10 14 15 11
1
4 11 15 16 12
1
4 12 16 13 9
# Part 3: hole points
0
# Part 4: regions
1
1 1 1 1 10 0.5
)";

TEST(TetGen, ReadsFacetsWithHoles) {
    const ReadMesh read = must_read(pierced, "poly");
    EXPECT_EQ(read.polygons, 10u);
    EXPECT_EQ(volume_of(read.mesh), 6 * 6 * 6 - 2 * 2 * 6);
    const Result<mesh::Report> report = mesh::validate(read.mesh);
    ASSERT_TRUE(report);
    EXPECT_TRUE(report->solid && report->manifold) << report->describe();
    EXPECT_TRUE(read.warnings.empty()) << read.warnings[0];
}

TEST(TetGen, KeepsContoursAsPolygons) {
    const Result<ReadPolygons> read = read_polygons(bytes_of(pierced), {.format = "poly"});
    ASSERT_TRUE(read) << read.error().describe();
    const mesh::PolygonMesh& mesh = read->mesh;
    ASSERT_EQ(mesh.face_begin.size(), 11u);
    EXPECT_EQ(mesh.face_begin[1], 2u);
    EXPECT_EQ(std::vector<mesh::VertexIndex>(mesh.corners.begin(), mesh.corners.begin() + 8),
              (std::vector<mesh::VertexIndex>{0, 3, 2, 1, 8, 9, 10, 11}));
    EXPECT_EQ(mesh.contour_begin[2], 8u);
    EXPECT_EQ(mesh.face_begin[10], 12u);
}

TEST(TetGen, TakesContoursOfEitherDirection) {
    // The inner contours run the same way as the outer ones, and facets look anywhere.
    std::string text = replaced(pierced, "4 9 10 11 12", "4 12 11 10 9");
    text = replaced(text, "4 1 2 6 5", "4 5 6 2 1");
    text = replaced(text, "4 4 1 5 8", "4 8 5 1 4");
    const ReadMesh read = must_read(text, "poly");
    EXPECT_EQ(volume_of(read.mesh), 192);
    ASSERT_EQ(read.warnings.size(), 1u);
    EXPECT_THAT(read.warnings[0], testing::HasSubstr("2 facets were turned over"));
    // All facets look inwards when the points are mirrored.
    std::string mirrored = pierced;
    for (int i = 5; i <= 16; ++i) {
        const std::size_t at = mirrored.find("\n" + std::to_string(i) + " ", 100);
        const std::size_t end = mirrored.find('\n', at + 1);
        if (mirrored[end - 1] == '6') mirrored.replace(end - 1, 1, "-6");
    }
    EXPECT_EQ(volume_of(must_read(replaced(mirrored, "1 3 3 6", "1 3 3 -6"), "poly").mesh), 192);
}

TEST(TetGen, CountsFromZeroToo) {
    EXPECT_EQ(volume_of(must_read("4 3 0 0\n0 0 0 0\n1 6 0 0\n2 0 6 0\n3 0 0 6\n"
                                  "4 0\n1\n3 0 2 1\n1\n3 0 1 3\n1\n3 1 2 3\n1\n3 2 0 3\n",
                                  "poly")
                            .mesh),
              36);
}

TEST(TetGen, ReadsSmeshWithAttributesAndMarkers) {
    const std::string text =
        "4 3 2 1\n1 0 0 0 0.5 7 -1\n2 6 0 0 1 1 1\n3 0 6 0 1 1 1\n4 0 0 6 1 1 1\n"
        "4 1\n3 1 3 2 -5\n3 1 2 4 0\n3 2 3 4 0\n3 3 1 4 0\n0\n0\n";
    EXPECT_EQ(volume_of(must_read(text, "smesh").mesh), 36);
    // Lines may end anywhere within a contour, and comments stand anywhere.
    EXPECT_EQ(volume_of(must_read(replaced(text, "3 1 3 2 -5", "# c\n3 1\n\n3 # d\n2 -5 6"), "smesh").mesh),
              36);
    EXPECT_EQ(volume_of(must_read(replaced(text, "\n", "\r\n"), "smesh").mesh), 36);
}

/// A square with `contours` and `holes` as the only facet of a file.
ReadMesh read_facet(const std::string& contours, const std::string& holes, int count, int hole_count) {
    return must_read(
        "12 3\n1 0 0 0\n2 9 0 0\n3 9 9 0\n4 0 9 0\n5 1 1 0\n6 8 1 0\n7 8 8 0\n8 1 8 0\n9 2 2 0\n"
        "10 4 2 0\n11 4 4 0\n12 2 4 0\n1\n" +
            std::to_string(count) + " " + std::to_string(hole_count) + "\n" + contours + holes,
        "poly");
}
double area_of(const ReadMesh& read) { return area_of(read.mesh); }

TEST(TetGen, NestsContoursByTheirHolePoints) {
    const std::string outer = "4 1 2 3 4\n", middle = "4 5 6 7 8\n", inner = "4 9 10 11 12\n";
    // A contour without a hole point divides the facet and takes nothing away.
    EXPECT_EQ(area_of(read_facet(outer + inner, "", 2, 0)), 81);
    EXPECT_EQ(area_of(read_facet(outer + inner, "1 3 3 0\n", 2, 1)), 77);
    // An island in a hole, in any order; then a hole in the island.
    EXPECT_EQ(area_of(read_facet(inner + outer + middle, "1 5 5 0\n", 3, 1)), 81 - 49 + 4);
    EXPECT_EQ(area_of(read_facet(middle + inner + outer, "1 5 5 0\n2 3 3 0\n", 3, 2)), 81 - 49);
    EXPECT_EQ(area_of(read_facet(middle + inner + outer, "1 3 3 0\n", 3, 1)), 81 - 4);
    // Points and segments that only force a mesh are left out.
    const ReadMesh loose = read_facet(outer + "1 9\n2 9 10\n", "", 3, 0);
    EXPECT_EQ(area_of(loose), 81);
    ASSERT_EQ(loose.warnings.size(), 1u);
    EXPECT_THAT(loose.warnings[0], testing::HasSubstr("2 contours of fewer than three corners"));
    // All parts of a facet are that facet.
    const ReadMesh two = read_facet(outer + inner, "", 2, 0);
    EXPECT_EQ(two.polygons, 1u);
    EXPECT_EQ(std::count(two.polygon_of_triangle.begin(), two.polygon_of_triangle.end(), 0u),
              static_cast<std::ptrdiff_t>(two.mesh.triangles.size()));
}

TEST(TetGen, NamesTheFacetAndTheLineOfWhatIsWrong) {
    const std::string points =
        "8 3\n1 0 0 0\n2 9 0 0\n3 9 9 0\n4 0 9 0\n5 1 1 0\n6 8 1 0\n7 8 8 0.01\n8 1 8 0\n";
    const std::string fine = "2\n1\n3 1 2 3\n";  // the second facet begins on line 13
    const auto refused = [&](const std::string& facet, std::uint64_t line, const char* part) {
        expect_refused(points + fine + facet, "poly", line, part);
    };
    refused("1\n4 5 6 7 8\n", 13, "facet 2 is not flat: a corner is 0.0");
    refused("1\n4 1 3 2 8\n", 13, "facet 2 crosses itself");
    refused("3\n4 1 2 3 4\n3 5 6 3\n3 6 8 5\n", 13, "facet 2 has contours that cross");
    refused("2 1\n4 1 2 3 4\n3 5 6 8\n1 20 3 0\n", 16, "facet 2 has a hole point in none of its contours");
    refused("2 1\n4 1 2 3 4\n3 5 6 8\n1 2 1 0\n", 16, "facet 2 has a hole point on a contour");
    refused("2 0\n4 1 2 3 4\n4 4 3 2 1\n", 13, "contours 1 and 2 that cover each other");
    refused("1 1\n4 1 2 3 4\n1 3 3 0\n", 13, "facet 2 is all holes");
    refused("1\n4 1 2 1 2\n", 13, "facet 2 has no area");
    refused("1\n4 1 2 3 9\n", 14, "names point 9 of 8, which are numbered from 1");
    refused("1\n4 1 2 3 0\n", 14, "names point 0 of 8");
    refused("1\n4 1 2 three\n", 14, "expected the number of a point, found \"three\"");
    refused("1 x\n", 13, "expected the number of hole points");
    refused("1\n4000000000 1 2 3\n", 14, "runs past the end");
    refused("", 13, "ends before facet 2 of 2");
    refused("1\n3 1 2 3\n1\n", 16, "ends before hole point 1 of 1");
    expect_refused("3 3\n1 0 0 0\n3 1 0 0\n2 0 1 0\n1\n1\n3 1 2 3\n", "poly", 3, "point 3 stands where 2 is");
    expect_refused("3 3\n5 0 0 0\n", "poly", 1, "announces 3 points");
    expect_refused("3 3\n5 0 0 0\n6 1 1 1\n7 2 2 2\n", "poly", 2, "point 5 stands where 0 or 1 is");
    expect_refused("3 3\n1 0 0 0\n2 1 1\n3 1 1 1\n", "poly", 3, "a point needs three coordinates");
    expect_refused("3 3\n1 0 0 0\n2 1 1 inf\n3 1 1 1\n", "poly", 3, "not a finite number");
    const Result<ReadMesh> flat =
        read_text("3 2 0 0\n1 0 0\n2 1 0\n3 0 1\n3 0\n1 1 2\n2 2 3\n3 3 1\n0\n", "poly");
    ASSERT_FALSE(flat);
    EXPECT_EQ(flat.error().code, ErrorCode::unsupported);
}

/// Boxes from 0 to 10, 2 to 8 and 4 to 6, with the facets of the middle one looking as `middle` says.
std::string boxes(bool turn_middle, const std::string& hole_points) {
    std::string points, facets;
    int count = 0;
    for (const auto& [low, high] : {std::pair{0, 10}, {2, 8}, {4, 6}}) {
        const int first = count + 1;
        for (int i = 0; i < 8; ++i)
            points += std::to_string(++count) + " " + std::to_string(i & 1 ? high : low) + " " +
                      std::to_string(i & 2 ? high : low) + " " + std::to_string(i & 4 ? high : low) + "\n";
        for (const std::array<int, 4>& face :
             {std::array{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
            std::string corners;
            for (const int corner : face) {
                const std::string text = " " + std::to_string(first + corner);
                corners = turn_middle && low == 2 ? text + corners : corners + text;
            }
            facets += "4" + corners + "\n";
        }
    }
    return "24 3\n" + points + "18 0\n" + facets + hole_points;
}

TEST(TetGen, TakesHolePointsForCavities) {
    const auto read = [](bool turned, const std::string& holes) {
        return must_read(boxes(turned, holes), "smesh");
    };
    // Directions of the file do not matter where there are hole points.
    for (const bool turned : {false, true}) {
        EXPECT_EQ(volume_of(read(turned, "1\n1 3 3 3\n").mesh), 1000 - 216 + 8);
        EXPECT_EQ(volume_of(read(turned, "2\n1 3 3 3\n2 5 5 5\n").mesh), 1000 - 216);
        EXPECT_EQ(volume_of(read(turned, "1\n1 5 5 5\n").mesh), 1000 - 8);
        EXPECT_EQ(volume_of(read(turned, "1\n1 1 1 1\n").mesh), 216);
        EXPECT_EQ(read(turned, "1\n1 5 5 5\n").mesh.triangles.size(), 24u);  // the middle box bounds nothing
        const ReadMesh outside = read(turned, "1\n1 50 5 5\n");
        EXPECT_EQ(volume_of(outside.mesh), 1000);
        EXPECT_THAT(outside.warnings.back(), testing::HasSubstr("1 hole points lie outside of everything"));
    }
    // Where there are none, the directions are what is left.
    EXPECT_EQ(volume_of(read(true, "0\n").mesh), 1000 - 216 + 8);
}

TEST(TetGen, FindsPointsInTheNodeFileBeside) {
    const Folder folder;
    std::ofstream(folder / "part.1.node") << "4 3 0 0\n0 0 0 0\n1 6 0 0\n2 0 6 0\n3 0 0 6\n";
    std::ofstream(folder / "part.1.smesh")
        << "0 3 0 0 # points are in part.1.node\n4 0\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n0\n";
    const Result<ReadMesh> read = read_mesh(folder / "part.1.smesh");
    ASSERT_TRUE(read) << read.error().describe();
    EXPECT_EQ(volume_of(read->mesh), 36);
    EXPECT_EQ(read->beside, std::vector<std::string>{folder / "part.1.node"});
    std::ofstream(folder / "part.1.node") << "4 3 0 0\n0 0 0 0\n1 6 0 0\n2 0 x 0\n3 0 0 6\n";
    const Result<ReadMesh> bad = read_mesh(folder / "part.1.smesh");
    ASSERT_FALSE(bad);
    EXPECT_THAT(bad.error().place.file, testing::HasSubstr("part.1.node"));
    EXPECT_EQ(bad.error().place.line, 4u);
    const Result<ReadMesh> alone = read_text("0 3 0 0\n1 0\n3 0 1 2\n", "smesh");
    ASSERT_FALSE(alone);
    EXPECT_EQ(alone.error().code, ErrorCode::unsupported);
}

TEST(TetGen, WritesCoplanarNeighboursAsOneFacet) {
    const std::string text = write_text(must_read(pierced, "poly").mesh, "poly");
    const ReadMesh again = must_read(text, "poly");
    EXPECT_EQ(again.polygons, 10u) << text;
    EXPECT_EQ(volume_of(again.mesh), 192);
    EXPECT_TRUE(again.warnings.empty());
    EXPECT_EQ(write_text(again.mesh, "poly"), text);
    // .smesh has no holes: the two pierced facets stay triangles, eight each.
    const ReadMesh smesh = must_read(write_text(again.mesh, "smesh"), "smesh");
    EXPECT_EQ(smesh.polygons, 8u + 16u);
    EXPECT_EQ(volume_of(smesh.mesh), 192);
}

TEST(TetGen, WritesAHolePointInEachCavity) {
    const ReadMesh hollow = must_read(boxes(false, "1\n1 3 3 3\n"), "smesh");
    for (const char* format : {"poly", "smesh"}) {
        const std::string text = write_text(hollow.mesh, format);
        const ReadMesh again = must_read(text, format);
        EXPECT_EQ(volume_of(again.mesh), 1000 - 216 + 8);
        EXPECT_TRUE(again.warnings.empty()) << again.warnings[0] << text;
    }
}

TEST(TetGen, CarriesSolidsThere) {
    // On the lattice the solid that comes back is the one that went, whatever was merged.
    for (const mesh::Mesh& solid :
         {mesh::gear(), mesh::bearing_housing(), mesh::icosphere(1, 5), mesh::menger_sponge(2)}) {
        const Result<mesh::Snapped> there = mesh::snap(solid);
        ASSERT_TRUE(there);
        for (const char* format : {"poly", "smesh"}) {
            const ReadMesh read = must_read(write_text(solid, format), format);
            const Result<mesh::Snapped> back = mesh::snap(read.mesh);
            ASSERT_TRUE(back);
            EXPECT_EQ(mesh::exact_volume6(there->mesh), mesh::exact_volume6(back->mesh));
            EXPECT_TRUE(mesh::validate(read.mesh)->solid);
            EXPECT_LE(read.polygons, solid.triangles.size());
        }
    }
}

}  // namespace
}  // namespace octavo::io
