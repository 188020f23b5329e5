// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <map>

#include "cli/program.hpp"

// Models of every kind, given to every verb: meshes, CSG trees and octrees work where they mean something, and where
// they do not, a sentence says which verb to use. And what is told of solids that wind twice.

namespace octavo::tests {
namespace {

using Models = ProgramTest;
using nlohmann::json;

constexpr const char* two_boxes =
    "union() {\n  cube(size = [2, 2, 2]);\n"
    "  multmatrix([[1,0,0,1],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) { cube(size = [2, 2, 2]); }\n}\n";

/// A cube of side 2 given twice, with vertices of its own each time, or shifted by `shift` along x.
std::string two_cubes(double shift) {
    const char* faces[] = {"4 0 3 2 1", "4 4 5 6 7", "4 0 1 5 4", "4 1 2 6 5", "4 2 3 7 6", "4 3 0 4 7"};
    std::ostringstream off;
    off << "OFF\n16 12 0\n";
    for (int copy = 0; copy < 2; ++copy)
        for (int corner = 0; corner < 8; ++corner)
            off << (corner % 4 == 1 || corner % 4 == 2 ? 2 : 0) + copy * shift << " "
                << (corner % 4 >= 2 ? 2 : 0) << " " << (corner >= 4 ? 2 : 0) << "\n";
    for (int copy = 0; copy < 2; ++copy)
        for (const char* face : faces) {
            std::istringstream words(face);
            int count = 0;
            words >> count;
            off << count;
            for (int index = 0; words >> index;) off << " " << index + 8 * copy;
            off << "\n";
        }
    return off.str();
}

TEST_F(Models, TheVolumeOfTheSolidIsToldWhereSpaceCountsTwice) {
    write("same.off", two_cubes(0));
    write("shifted.off", two_cubes(1));
    ASSERT_EQ(octavo("shape cube -o one.off").exit_code, 0);
    const auto volumes = [&](const char* file) {
        const json result = octavo(std::string("info ") + file + " --json").json()["result"];
        return std::pair(result["volume"].get<double>(), result["solid_volume"].get<double>());
    };
    EXPECT_EQ(volumes("one.off"), std::pair(1.0, 1.0));
    EXPECT_EQ(volumes("same.off"), std::pair(16.0, 8.0));
    EXPECT_EQ(volumes("shifted.off"), std::pair(16.0, 12.0));
    const std::string text = octavo("info same.off").out;
    EXPECT_NE(text.find("volume of solid     8"), std::string::npos) << text;
    EXPECT_EQ(text.find("open surface"), std::string::npos) << text;
    // The octree is of the solid, so its bounds agree with the solid's volume.
    const json tree = octavo("octree shifted.off --depth 6 --json").json()["result"];
    EXPECT_LE(tree["volume_lower"], 12.0);
    EXPECT_GE(tree["volume_upper"], 12.0);
}

TEST_F(Models, ABodyInABodyCountsTwiceWithoutAnyContact) {
    ASSERT_EQ(octavo("shape cube --size 4 -o large.off").exit_code, 0);
    ASSERT_EQ(octavo("shape cube --size 2 -o small.off").exit_code, 0);
    // One file with both: their OBJ texts, the second with shifted indices.
    ASSERT_EQ(shell("$octavo convert large.off - --to obj > both.obj; $octavo convert small.off - --to obj |"
                    "awk '$1==\"f\" {print \"f\", $2+8, $3+8, $4+8; next} {print}' >> both.obj")
                  .exit_code,
              0);
    const json result = octavo("info both.obj --json").json()["result"];
    EXPECT_EQ(result["volume"], 72.0);
    EXPECT_EQ(result["solid_volume"], 64.0);
    EXPECT_EQ(octavo("check both.obj --json").json()["result"]["nested_bodies"], 1);
}

TEST_F(Models, AnOpenSurfaceHasNoVolumeOfTheSolid) {
    write("open.off", "OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n");
    EXPECT_TRUE(octavo("info open.off --json").json()["result"]["solid_volume"].is_null());
    EXPECT_NE(octavo("info open.off").out.find("open surface"), std::string::npos);
}

TEST_F(Models, AClosedSurfaceThatIsNotOrientedIsNotCalledOpen) {
    // A tetrahedron with its last facet turned over.
    write("turned.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 2 3\n");
    const json result = octavo("info turned.off --json").json()["result"];
    EXPECT_EQ(result["closed"], true);
    EXPECT_EQ(result["oriented"], false);
    EXPECT_TRUE(result["solid_volume"].is_null());
    const std::string text = octavo("info turned.off").out;
    EXPECT_NE(text.find("(of an inconsistently oriented surface: means nothing)"), std::string::npos) << text;
}

TEST_F(Models, InfoAndCheckCountContactsUnderTheSameNames) {
    write("same.off", two_cubes(0));
    write("shifted.off", two_cubes(1));
    write("apart.off", two_cubes(3));
    for (const char* file : {"same.off", "shifted.off", "apart.off"}) {
        std::map<std::string, std::uint64_t> counts;
        const json report = octavo(std::string("check --json ") + file).json()["result"];
        for (const json& problem : report["problems"]) counts[problem["kind"]] = problem["count"];
        const json facts = octavo(std::string("info --json ") + file).json()["result"];
        for (const char* kind : {"self_intersections", "penetrations", "overlaps"})
            EXPECT_EQ(facts[kind], counts[kind]) << file << " " << kind;
    }
    const std::string text = octavo("info shifted.off").out;
    EXPECT_NE(text.find("  overlaps "), std::string::npos) << text;
    EXPECT_EQ(octavo("info apart.off").out.find("  overlaps "), std::string::npos);
}

TEST_F(Models, DoubleSheetsBoundNoSolid) {
    write("sheet.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 2 1\n");
    // A prism so thin that the lattice makes a double sheet of it.
    write("thin.off",
          "OFF\n6 8 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1e-12\n1 0 1e-12\n0 1 1e-12\n3 0 2 1\n3 3 4 5\n"
          "3 0 1 4\n3 0 4 3\n3 1 2 5\n3 1 5 4\n3 2 0 3\n3 2 3 5\n");
    for (const char* file : {"sheet.off", "thin.off"}) {
        const Ran ran = octavo(std::string("check ") + file + " --json");
        EXPECT_EQ(ran.exit_code, 1) << file;
        EXPECT_NE(ran.out.find("flat_shells"), std::string::npos) << file;
    }
}

TEST_F(Models, InfoCountsWhatNoLatticeHolds) {
    write("huge.off",
          "OFF\n4 4 0\n0 0 0\n1e300 0 0\n0 1e300 0\n0 0 1e300\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n");
    const Ran ran = octavo("info huge.off --json");
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_EQ(ran.json()["result"]["triangles"], 4);
    EXPECT_EQ(ran.json()["result"]["closed"], true);
    EXPECT_TRUE(ran.json()["result"]["self_intersections"].is_null());
    ASSERT_EQ(ran.json()["warnings"].size(), 2U);
    EXPECT_EQ(ran.json()["warnings"][1],
              "too large for double numbers: the volume, the area and the inertia");
    EXPECT_TRUE(ran.json()["result"]["volume"].is_null());
    EXPECT_NE(octavo("octree huge.off").err.find("5e278"), std::string::npos);
}

TEST_F(Models, NumbersForPeopleAreRoundedOnceAndAlike) {
    ASSERT_EQ(octavo("shape torus -o torus.ply").exit_code, 0);
    const std::string text = octavo("info torus.ply").out;
    EXPECT_NE(text.find("centroid            0, 0, 0\n"), std::string::npos) << text;
    EXPECT_NE(text.find("triangles           9 408\n"), std::string::npos) << text;
    EXPECT_EQ(text.find("e-"), std::string::npos) << text;
    EXPECT_NE(octavo("check torus.ply").out.find("9 408 facets"), std::string::npos);
    ASSERT_EQ(octavo("shape cube --size 12345.678 -o large.off").exit_code, 0);
    EXPECT_NE(octavo("info large.off").out.find("volume              1 881 675 960 267\n"), std::string::npos)
        << octavo("info large.off").out;
}

TEST_F(Models, CsgTreesAreSolidsForEveryVerbThatAsksForOne) {
    write("part.csg", two_boxes);
    EXPECT_EQ(octavo("info part.csg --json").json()["result"]["volume"], 12.0);
    ASSERT_EQ(octavo("convert part.csg part.ply").exit_code, 0);
    EXPECT_EQ(octavo("check part.ply").exit_code, 0);
    EXPECT_EQ(octavo("render part.csg -o part.png --size 80x60").exit_code, 0);
    write("points.csv", "1,1,1\n3,1,1\n4,1,1\n");
    EXPECT_EQ(octavo("contains part.csg points.csv").out, "side\n-1\n0\n1\n");
}

TEST_F(Models, OctreesAreSolidsForEveryVerbThatAsksForOne) {
    ASSERT_EQ(octavo("shape cube --size 2 -o cube.off").exit_code, 0);
    ASSERT_EQ(octavo("octree cube.off --depth 4 -o cube.oct").exit_code, 0);
    const json info = octavo("info cube.oct --json").json()["result"];
    EXPECT_EQ(info["depth"], 4);
    EXPECT_LE(info["volume_lower"], 8.0);
    EXPECT_LE(info["bounds"][0][0], -1.0);
    EXPECT_GE(info["bounds"][1][2], 1.0);
    ASSERT_EQ(octavo("convert cube.oct cells.off").exit_code, 0);
    EXPECT_EQ(octavo("check cells.off").exit_code, 0);
    EXPECT_EQ(octavo("info cells.off --json").json()["result"]["volume"], info["volume_lower"]);
    ASSERT_EQ(octavo("convert cube.oct cells.vtu").exit_code, 0);
    EXPECT_GT(std::filesystem::file_size(path("cells.vtu")), 100U);

    write("points.csv", "0,0,0\n1,0,0\n9,0,0\nnan,0,0\n");
    const Ran answers = octavo("contains cube.oct points.csv --json");
    ASSERT_EQ(answers.exit_code, 0) << answers.err;
    EXPECT_EQ(answers.json()["result"]["side"], (json{-1, 0, 1, 1}));
    EXPECT_NE(answers.err.find("gray cells"), std::string::npos);
}

TEST_F(Models, BpOctreesAreTheirTriangles) {
    ASSERT_EQ(octavo("shape knot --detail 96 -o knot.ply").exit_code, 0);
    ASSERT_EQ(octavo("build knot.ply -o knot.bpo").exit_code, 0);
    EXPECT_EQ(octavo("info knot.bpo --json").json()["result"]["format"], "bpo");
    EXPECT_EQ(octavo("render knot.bpo -o knot.png --size 80x60").exit_code, 0);
    write("points.csv", "2,0,0\n");
    const json result = octavo("distance knot.bpo points.csv --json").json()["result"];
    ASSERT_EQ(result["distance"].size(), 1U);
    EXPECT_EQ(result["distance"][0], result["min"]);
    EXPECT_EQ(result["triangle"].size(), 1U);
}

TEST_F(Models, OctreesOfEveryKindAreKnownOnStdin) {
    ASSERT_EQ(octavo("shape cube --size 2 -o cube.stl").exit_code, 0);
    ASSERT_EQ(octavo("octree cube.stl --depth 4 -o cube.oct").exit_code, 0);
    ASSERT_EQ(octavo("build cube.stl -o cube.bpo").exit_code, 0);
    ASSERT_EQ(octavo("bsp cube.stl -o cube.bso").exit_code, 0);
    write("points.csv", "0,0,0\n9,0,0\n");
    for (const std::string format : {"oct", "bpo", "bso"}) {
        const std::string file = "cube." + format;
        const auto same = [&](const std::string& before, const std::string& after) {
            const json named = octavo(before + file + after + " --json").json()["result"];
            // Through a pipe, and from a file, of which the place could be set back.
            for (const std::string& stdin_of : {"cat " + file + " | ", std::string()})
                for (const std::string& given : {std::string(), " --from " + format}) {
                    if (!given.empty() && !after.empty()) continue;
                    const Ran piped = shell(stdin_of + "$octavo " + before + "-" + after + " --json" + given +
                                            (stdin_of.empty() ? " < " + file : ""));
                    ASSERT_EQ(piped.exit_code, 0) << before << file << given << piped.err;
                    EXPECT_EQ(piped.json()["result"], named) << before << file << given;
                }
        };
        same("stats ", "");
        same("info ", "");
        same("contains ", " points.csv");
        EXPECT_EQ(octavo("stats " + file + " --json").json()["result"]["format"], format);
    }
    EXPECT_EQ(shell("cat cube.stl | $octavo info - --json").json()["result"]["triangles"], 12);
    EXPECT_EQ(shell("cat cube.stl | $octavo stats -").exit_code, 3);
    EXPECT_EQ(shell("$octavo stats - </dev/null").exit_code, 3);
    EXPECT_EQ(octavo("stats cube.oct --from xyz").exit_code, 2);
    // What a file is called decides unless --from does.
    ASSERT_EQ(shell("cp cube.bpo renamed.data").exit_code, 0);
    EXPECT_EQ(octavo("stats renamed.data --from bpo").exit_code, 0);
}

TEST_F(Models, WhereAModelMeansNothingTheVerbToUseIsNamed) {
    write("part.csg", two_boxes);
    ASSERT_EQ(octavo("octree part.csg --depth 3 -o part.oct").exit_code, 0);
    ASSERT_EQ(octavo("convert part.csg part.off").exit_code, 0);
    const std::pair<const char*, const char*> cases[] = {
        {"check part.csg", "octavo convert"},      {"check part.oct", "octavo stats"},
        {"repair part.oct -o a.off", "octavo"},    {"union part.off part.oct -o a.off", "octavo convert"},
        {"octree part.oct -o a.oct", "an octree"}, {"stats part.off", "octavo octree"}};
    for (const auto& [arguments, words] : cases) {
        const Ran ran = octavo(arguments);
        EXPECT_EQ(ran.exit_code, 3) << arguments;
        EXPECT_NE(ran.err.find(words), std::string::npos) << arguments << ": " << ran.err;
    }
}

TEST_F(Models, TheSizeToldIsThatOfTheFile) {
    ASSERT_EQ(octavo("shape gear -o gear.ply").exit_code, 0);
    for (const char* file : {"gear.oct", "gear.vtu", "gear.htg"}) {
        const Ran ran = octavo(std::string("octree gear.ply --depth 5 --json -o ") + file);
        ASSERT_EQ(ran.exit_code, 0) << ran.err;
        EXPECT_EQ(ran.json()["result"]["bytes"], std::filesystem::file_size(path(file))) << file;
    }
}

TEST_F(Models, AMengerSpongeOfLevelZeroIsACube) {
    ASSERT_EQ(octavo("shape menger --detail 0 -o cube.off").exit_code, 0);
    EXPECT_EQ(octavo("info cube.off --json").json()["result"]["triangles"], 12);
}

}  // namespace
}  // namespace octavo::tests
