// SPDX-License-Identifier: Apache-2.0
#include "cli/program.hpp"

// What is told of surfaces that bound no solid, or not as they stand: open, with flaps, inside out, through themselves.

namespace octavo::tests {
namespace {

using Surfaces = ProgramTest;
using nlohmann::json;

/// A cube from 0 to 1; `more` faces may use vertex 8, far off, and `vertices` is how many there are.
std::string cube_with(const std::string& more, int faces) {
    return "OFF\n9 " + std::to_string(6 + faces) +
           " 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n3 0.5 0.5\n"
           "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n" +
           more;
}

constexpr const char* open_cube =
    "OFF\n8 5 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
    "4 0 3 2 1\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";

TEST_F(Surfaces, RepairDropsAFlapOfNoThickness) {
    // Both sides of a triangle that stands on an edge of the cube.
    write("flap.off", cube_with("3 1 2 8\n3 2 1 8\n", 2));
    ASSERT_EQ(octavo("check flap.off").exit_code, 1);
    const Ran ran = octavo("repair flap.off -o fixed.off --json");
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    const json result = ran.json()["result"];
    EXPECT_EQ(result["valid"], true);
    ASSERT_EQ(result["repairs"].size(), 2U) << result["repairs"];
    EXPECT_EQ(result["repairs"][0]["kind"], "dropped_flaps");
    EXPECT_EQ(result["repairs"][0]["faces"], (json{6, 7}));
    EXPECT_EQ(result["repairs"][1]["kind"], "dropped_vertices");
    EXPECT_NE(
        octavo("repair flap.off -o fixed.off").out.find("2 facets of flaps without thickness were dropped."),
        std::string::npos);
    EXPECT_EQ(octavo("check fixed.off").exit_code, 0);
    EXPECT_EQ(octavo("info fixed.off --json").json()["result"]["volume"], 1.0);
}

TEST_F(Surfaces, RepairSaysWhatHelpsWhereItDoesNot) {
    write("open.off", open_cube);
    const Ran open = octavo("repair open.off -o a.off");
    EXPECT_EQ(open.exit_code, 0) << "the file was written";
    EXPECT_NE(open.err.find("what was written bounds no solid"), std::string::npos) << open.err;
    EXPECT_NE(open.err.find("--open winding"), std::string::npos) << open.err;
    // A tetrahedron that runs through the cube's side.
    write("through.off",
          "OFF\n12 10 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
          "0.5 0.2 0.3\n2 0.4 0.4\n0.5 0.8 0.3\n0.5 0.5 0.7\n"
          "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n"
          "3 8 10 9\n3 8 9 11\n3 9 10 11\n3 10 8 11\n");
    const Ran through = octavo("repair through.off -o b.off --json");
    EXPECT_EQ(through.exit_code, 0);
    EXPECT_EQ(through.json()["result"]["valid"], false);
    EXPECT_NE(through.err.find("octavo union b.off -o FILE"), std::string::npos) << through.err;
    ASSERT_EQ(octavo("union b.off -o c.off").exit_code, 0);
    EXPECT_EQ(octavo("check c.off").exit_code, 0) << octavo("check c.off").out;
    // Nothing is left: nothing is said.
    EXPECT_EQ(octavo("repair c.off -o d.off --json").json()["warnings"], json::array());
}

TEST_F(Surfaces, RepairIsAdvisedOnlyWhereItHelps) {
    write("inward.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 0 3 1\n3 1 3 2\n3 2 3 0\n");
    write("points.csv", "0.1,0.1,0.1\n");
    for (const char* arguments :
         {"octree inward.off", "contains inward.off points.csv", "distance inward.off points.csv"})
        EXPECT_NE(
            octavo(arguments).err.find("point inwards, so hardly anything counts as inside; octavo repair"),
            std::string::npos)
            << arguments;
    ASSERT_EQ(octavo("repair inward.off -o outward.off").exit_code, 0);
    EXPECT_EQ(octavo("contains outward.off points.csv").out, "side\n-1\n");
    // Three loose triangles that look to the origin: their "volume" is negative, and repair leaves them.
    write("loose.off",
          "OFF\n9 3 0\n1 0 0\n1 1 0\n1 0 1\n0 1 0\n0 1 1\n1 1 0\n0 0 1\n1 0 1\n0 1 1\n3 0 2 1\n3 3 5 4\n3 6 "
          "8 7\n");
    for (const char* arguments : {"octree loose.off", "contains loose.off points.csv"})
        EXPECT_EQ(octavo(arguments).err.find("repair"), std::string::npos) << octavo(arguments).err;
}

TEST_F(Surfaces, FacetsThatCloseASurfaceAreToldByEveryVerbThatAddsThem) {
    write("open.off", open_cube);
    write("points.csv", "0.5,0.5,0.5\n5,5,5\n");
    for (const char* arguments :
         {"octree open.off --open winding", "contains open.off points.csv --open winding",
          "distance open.off points.csv --open winding"}) {
        const json warnings = octavo(std::string(arguments) + " --json").json()["warnings"];
        EXPECT_EQ(warnings, json::array({"the surface is open; 4 facets were added to close it"}))
            << arguments;
    }
    ASSERT_EQ(octavo("shape cube -o cube.off").exit_code, 0);
    EXPECT_EQ(octavo("contains cube.off points.csv --open winding --json").json()["warnings"], json::array());
    // Inside out: what is closed holds nothing, which the open surface could not say.
    write("inward.off",
          "OFF\n8 5 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
          "4 0 1 2 3\n4 0 4 5 1\n4 1 5 6 2\n4 2 6 7 3\n4 3 7 4 0\n");
    EXPECT_NE(octavo("contains inward.off points.csv --open winding").err.find("point inwards"),
              std::string::npos);
}

TEST_F(Surfaces, InfoSaysWhatInertiaIsAboutAndWhatMeansNothing) {
    ASSERT_EQ(octavo("shape cube -o cube.off").exit_code, 0);
    const std::string solid = octavo("info cube.off").out;
    EXPECT_NE(solid.find("about the centroid, at density 1\n"), std::string::npos) << solid;
    EXPECT_EQ(solid.find("means nothing"), std::string::npos) << solid;
    write("turned.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 2 3\n");
    std::istringstream lines(octavo("info turned.off").out);
    int told = 0;
    for (std::string line; std::getline(lines, line);)
        for (const char* name : {"  volume ", "  centroid ", "  inertia "})
            if (line.rfind(name, 0) == 0) {
                ++told;
                EXPECT_NE(line.find("(of an inconsistently oriented surface: means nothing)"),
                          std::string::npos)
                    << line;
            }
    EXPECT_EQ(told, 3);
}

TEST_F(Surfaces, AnEmptySolidIsReadAsOne) {
    ASSERT_EQ(octavo("shape cube -o cube.off").exit_code, 0);
    write("points.csv", "0,0,0\n");
    for (const std::string format : {"stl", "obj", "ply", "off", "3mf", "poly", "smesh"}) {
        const std::string empty = "empty." + format;
        ASSERT_EQ(octavo("difference cube.off cube.off -o " + empty).exit_code, 0) << format;
        const Ran info = octavo("info --json " + empty);
        ASSERT_EQ(info.exit_code, 0) << format << info.err;
        EXPECT_EQ(info.json()["result"]["volume"], 0.0);
        EXPECT_EQ(info.json()["result"]["solid_volume"], 0.0);
        EXPECT_TRUE(info.json()["result"]["bounds"].is_null());
        EXPECT_EQ(info.json()["warnings"], json::array({"the file has no facets: the solid is empty"}))
            << format;
    }
    EXPECT_NE(octavo("info empty.off").out.find("bounds              none"), std::string::npos);
    EXPECT_EQ(octavo("check empty.off").exit_code, 1);
    EXPECT_EQ(octavo("union cube.off empty.off -o both.off --json").json()["result"]["volume"], 1.0);
    EXPECT_EQ(octavo("contains empty.off points.csv").out, "side\n1\n");
    EXPECT_EQ(octavo("octree empty.off --depth 3 --json").json()["result"]["black"], 0);
    EXPECT_EQ(octavo("convert empty.off again.stl").exit_code, 0);
    for (const char* arguments : {"render empty.off -o a.png", "hexmesh empty.off", "build empty.off",
                                  "distance empty.off points.csv"}) {
        const Ran ran = octavo(arguments);
        EXPECT_EQ(ran.exit_code, 3) << arguments << ran.out;
        EXPECT_NE(ran.err.find("error: "), std::string::npos) << arguments;
    }
}

TEST_F(Surfaces, OneOfAThingIsNotSeveral) {
    ASSERT_EQ(octavo("shape cube --size 2 -o cube.off").exit_code, 0);
    ASSERT_EQ(octavo("octree cube.off --depth 2 -o cube.oct").exit_code, 0);
    write("points.csv", "nan,0,0\n");
    EXPECT_NE(octavo("contains cube.off points.csv").err.find("1 point has a coordinate"), std::string::npos);
    write("wall.csv", "1,0,0\n");
    EXPECT_NE(octavo("contains cube.oct wall.csv").err.find("1 point lies in gray cells"), std::string::npos)
        << octavo("contains cube.oct wall.csv").err;
    EXPECT_NE(octavo("contains cube.off wall.csv -o a.csv").out.find("1 point: 0 inside"), std::string::npos);
    EXPECT_NE(octavo("mill cube.off --tool cube.off --path wall.csv -o a.stl").out.find("after 1 step,"),
              std::string::npos);
}

}  // namespace
}  // namespace octavo::tests
