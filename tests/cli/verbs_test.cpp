// SPDX-License-Identifier: Apache-2.0
#include <map>

#include "cli/program.hpp"

// Each verb once, end to end: the keys that scripts rely on, and answers known beforehand.

namespace octavo::tests {
namespace {

using Verbs = ProgramTest;
using nlohmann::json;

TEST_F(Verbs, InfoMeasuresACube) {
    ASSERT_EQ(octavo("shape cube --size 2 -o cube.stl").exit_code, 0);
    const Ran ran = octavo("info cube.stl --json");
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    const json result = ran.json()["result"];
    EXPECT_EQ(result["vertices"], 8);
    EXPECT_EQ(result["triangles"], 12);
    EXPECT_EQ(result["components"], 1);
    EXPECT_EQ(result["closed"], true);
    EXPECT_EQ(result["oriented"], true);
    EXPECT_EQ(result["self_intersections"], 0);
    EXPECT_EQ(result["volume"], 8.0);
    EXPECT_EQ(result["area"], 24.0);
    EXPECT_EQ(result["euler_number"], 2);
    EXPECT_EQ(result["centroid"], json::array({0.0, 0.0, 0.0}));
    EXPECT_EQ(result["bounds"], json::array({json::array({-1.0, -1.0, -1.0}), json::array({1.0, 1.0, 1.0})}));
    EXPECT_NEAR(result["inertia"][0][0].get<double>(), 8.0 * (4 + 4) / 12, 1e-12);
    EXPECT_NE(octavo("info cube.stl").out.find("volume"), std::string::npos);
}

constexpr const char* open_cube = R"(OFF
8 5 0
0 0 0
1 0 0
1 1 0
0 1 0
0 0 1
1 0 1
1 1 1
0 1 1
4 0 3 2 1
4 0 1 5 4
4 1 2 6 5
4 2 3 7 6
4 3 0 4 7
)";

TEST_F(Verbs, CheckSaysYesByItsExitCode) {
    ASSERT_EQ(octavo("shape gear -o gear.ply").exit_code, 0);
    const Ran ran = octavo("check gear.ply --json");
    EXPECT_EQ(ran.exit_code, 0) << ran.out;
    EXPECT_EQ(ran.json()["result"]["valid"], true);
}

TEST_F(Verbs, CheckSaysNoAndWhere) {
    write("open.off", open_cube);
    const Ran ran = octavo("check open.off --json");
    EXPECT_EQ(ran.exit_code, 1);
    const json result = ran.json()["result"];
    EXPECT_EQ(result["valid"], false);
    ASSERT_GE(result["problems"].size(), 1U);
    EXPECT_EQ(result["problems"][0]["kind"], "open_edges");
    EXPECT_EQ(result["problems"][0]["count"], 4);
    // The faces of the file, not the triangles that they are cut into.
    EXPECT_EQ(result["problems"][0]["faces"], json::array({1, 2, 3, 4}));
    EXPECT_NE(octavo("octree open.off -o open.oct").err.find("(facets 1, 2, 3, 4)"), std::string::npos);
}

TEST_F(Verbs, RepairNamesTheFacesOfTheFile) {
    // Face 5 repeats face 4.
    write("twice.off", std::string(open_cube).replace(4, 5, "8 7 0") + "4 3 0 4 7\n4 4 5 6 7\n");
    const Ran ran = octavo("repair twice.off -o once.off --json");
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    const json result = ran.json()["result"];
    ASSERT_EQ(result["repairs"].size(), 1U);
    EXPECT_EQ(result["repairs"][0]["kind"], "dropped_duplicate_facets");
    EXPECT_EQ(result["repairs"][0]["count"], 2);
    EXPECT_EQ(result["repairs"][0]["faces"], json::array({5}));
    EXPECT_EQ(result["valid"], true);
}

TEST_F(Verbs, SetOperationsOnShiftedCubesHaveTheirExactVolumes) {
    ASSERT_EQ(octavo("shape cube --size 2 -o a.stl").exit_code, 0);
    ASSERT_EQ(octavo("shape cube --size 2 -o b.off").exit_code, 0);
    const std::string shift = " a.stl b.off --transform b.off:1,0,0,1,0,1,0,0,0,0,1,0 -o out.ply --json";
    const std::map<std::string, double> volumes{
        {"union", 12}, {"intersection", 4}, {"difference", 4}, {"xor", 8}};
    for (const auto& [verb, volume] : volumes) {
        const Ran ran = octavo(verb + shift);
        ASSERT_EQ(ran.exit_code, 0) << ran.err;
        const json result = ran.json()["result"];
        for (const char* key :
             {"triangles", "vertices", "volume", "area", "closed", "manifold", "exact_fallbacks"})
            EXPECT_TRUE(result.contains(key)) << key;
        EXPECT_EQ(result["volume"], volume) << verb;
        EXPECT_EQ(result["closed"], true);
        EXPECT_EQ(octavo("check out.ply").exit_code, 0) << verb;
    }
}

TEST_F(Verbs, AnEmptyResultIsASuccessWithAWarning) {
    ASSERT_EQ(octavo("shape cube -o a.stl").exit_code, 0);
    ASSERT_EQ(octavo("shape cube -o b.stl").exit_code, 0);
    const Ran ran = octavo("difference a.stl b.stl -o out.off --json");
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_EQ(ran.json()["result"]["triangles"], 0);
    EXPECT_EQ(ran.json()["result"]["volume"], 0.0);
    EXPECT_EQ(ran.json()["warnings"].size(), 1U);
}

TEST_F(Verbs, SetOperationsRefuseOpenOperandsNamingFacets) {
    write("open.off", open_cube);
    ASSERT_EQ(octavo("shape cube -o a.stl").exit_code, 0);
    const Ran ran = octavo("union a.stl open.off -o out.ply --json");
    EXPECT_EQ(ran.exit_code, 3);
    EXPECT_EQ(ran.json()["error"]["code"], "not_a_solid");
    EXPECT_FALSE(std::filesystem::exists(path("out.ply")));
    EXPECT_EQ(octavo("union a.stl a.stl --transform b.stl:1 -o out.ply").exit_code, 2);
}

TEST_F(Verbs, EvalTakesExpressionsOfNamesAndCsgFiles) {
    ASSERT_EQ(octavo("shape cube --size 2 -o a.stl").exit_code, 0);
    ASSERT_EQ(octavo("shape cube --size 1 -o b.stl").exit_code, 0);
    const Ran ran = octavo("eval '(big - small) | small & big' big=a.stl small=b.stl -o out.ply --json");
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_EQ(ran.json()["result"]["volume"], 8.0);
    EXPECT_EQ(octavo("eval 'a -' a=a.stl -o out.ply").exit_code, 2);
    EXPECT_EQ(octavo("eval 'a - b' a=a.stl -o out.ply").exit_code, 2);
    EXPECT_EQ(octavo("eval 'a' a=a.stl b=b.stl -o out.ply").exit_code, 2);
    EXPECT_EQ(octavo("eval 'a' a.stl -o out.ply").exit_code, 2);

    write("plate.csg",
          "difference() {\n  cube(size = [4, 4, 1], center = false);\n"
          "  multmatrix([[1, 0, 0, 1], [0, 1, 0, 1], [0, 0, 1, -1], [0, 0, 0, 1]]) {\n"
          "    cube(size = [2, 2, 3], center = false);\n  }\n}\n");
    const Ran plate = octavo("eval plate.csg -o plate.ply --json");
    ASSERT_EQ(plate.exit_code, 0) << plate.err;
    EXPECT_NEAR(plate.json()["result"]["volume"].get<double>(), 12.0, 1e-9);
    EXPECT_EQ(octavo("check plate.ply").exit_code, 0);
    EXPECT_EQ(octavo("eval plate.csg a=a.stl -o plate.ply").exit_code, 2);
    write("bad.csg", "cube(size = [4, 4, 1]");
    EXPECT_EQ(octavo("eval bad.csg -o out.ply --json").json()["error"]["code"], "bad_input");
}

TEST_F(Verbs, SetOperationsMakeFlushWhatIsNearerThanTheTolerance) {
    ASSERT_EQ(octavo("shape cube --size 2 -o a.stl").exit_code, 0);
    ASSERT_EQ(octavo("shape cube --size 2 -o b.off").exit_code, 0);
    const auto area = [&](const std::string& tolerance) {
        const Ran ran = octavo(
            "union a.stl b.off --transform b.off:1,0,0,2.001,0,1,0,0,0,0,1,0 -o out.ply --json" + tolerance);
        EXPECT_EQ(ran.exit_code, 0) << ran.err;
        EXPECT_EQ(octavo("check out.ply").exit_code, 0);
        return ran.json()["result"]["area"].get<double>();
    };
    EXPECT_NEAR(area(""), 48, 1e-6);
    EXPECT_NEAR(area(" --tolerance 0.01"), 40, 0.1);
    EXPECT_NEAR(area(" --tolerance 0"), 48, 1e-6);
    EXPECT_EQ(octavo("union a.stl b.off --tolerance -1 -o out.ply").exit_code, 2);
    EXPECT_EQ(octavo("union a.stl b.off --tolerance 100 -o out.ply").exit_code, 3);
}

TEST_F(Verbs, SetOperationsKeepDanglingFacesWhenAsked) {
    ASSERT_EQ(octavo("shape cube --size 2 -o a.stl").exit_code, 0);
    ASSERT_EQ(octavo("shape cube --size 2 -o b.off").exit_code, 0);
    const std::string touching =
        "intersection a.stl b.off --transform b.off:1,0,0,2,0,1,0,0,0,0,1,0 -o out.ply --json --regularized ";
    EXPECT_EQ(octavo(touching + "yes").json()["result"]["triangles"], 0);
    const json face = octavo(touching + "no").json()["result"];
    EXPECT_EQ(face["dangling_facets"], 2);
    EXPECT_EQ(face["area"], 4);
    EXPECT_EQ(face["closed"], false);
}

TEST_F(Verbs, SetOperationsCloseOpenOperandsWhenAsked) {
    write("open.off", open_cube);
    const Ran ran = octavo("union open.off --open winding -o out.ply --json");
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_GT(ran.json()["result"]["closing_facets"], 0);
    EXPECT_EQ(ran.json()["warnings"].size(), 1U);
    EXPECT_EQ(octavo("check out.ply").exit_code, 0);
}

TEST_F(Verbs, OctreeBoundsTheVolumeAndStatsReadsItBack) {
    ASSERT_EQ(octavo("shape sphere --detail 20 -o ball.ply").exit_code, 0);
    const json volume = octavo("info ball.ply --json").json()["result"]["volume"];
    const Ran built = octavo("octree ball.ply --depth 7 -o ball.oct --json");
    ASSERT_EQ(built.exit_code, 0) << built.err;
    const json result = built.json()["result"];
    for (const char* key : {"depth", "leaves", "white", "black", "gray", "volume_lower", "volume_upper",
                            "bytes", "peak_nodes", "primitive_tests"})
        EXPECT_TRUE(result.contains(key)) << key;
    EXPECT_EQ(result["depth"], 7);
    EXPECT_EQ(result["leaves"],
              result["white"].get<int>() + result["black"].get<int>() + result["gray"].get<int>());
    EXPECT_LE(result["volume_lower"], volume);
    EXPECT_GE(result["volume_upper"], volume);
    EXPECT_EQ(result["bytes"], std::filesystem::file_size(path("ball.oct")));

    json stats = octavo("stats ball.oct --json").json()["result"];
    for (const char* key :
         {"depth", "leaves", "white", "black", "gray", "volume_lower", "volume_upper", "bytes"})
        EXPECT_EQ(stats[key], result[key]) << key;
}

TEST_F(Verbs, OctreeIsTheSameForAnyNumberOfThreads) {
    ASSERT_EQ(octavo("shape knot -o knot.ply").exit_code, 0);
    ASSERT_EQ(octavo("octree knot.ply --depth 8 -o one.oct --threads 1").exit_code, 0);
    ASSERT_EQ(octavo("octree knot.ply --depth 8 -o four.oct --threads 4").exit_code, 0);
    EXPECT_EQ(read("one.oct"), read("four.oct"));
}

TEST_F(Verbs, OctreesOfTooManyNodesAreRefusedWithWhatToChange) {
    ASSERT_EQ(octavo("shape cube -o cube.stl").exit_code, 0);
    const Ran octree = octavo("octree cube.stl --depth 21 --max-nodes 1.5M -o cube.oct");
    EXPECT_EQ(octree.exit_code, 4) << octree.err;
    EXPECT_NE(octree.err.find("cube.stl: the octree has more than 1 500 000 nodes at depth 21"),
              std::string::npos);
    EXPECT_NE(octree.err.find("(--max-nodes)"), std::string::npos);
    EXPECT_FALSE(std::filesystem::exists(path("cube.oct")));
    write("ball.csg", "sphere(r = 1);");
    EXPECT_EQ(octavo("octree ball.csg --depth 21 --max-nodes 100K").exit_code, 4);
    EXPECT_EQ(octavo("octree ball.csg --depth 6 --max-nodes 100K").exit_code, 0);
    ASSERT_EQ(octavo("shape gear -o gear.stl").exit_code, 0);
    const Ran hexmesh = octavo("hexmesh gear.stl --level 17 --max-cells 50K");
    EXPECT_EQ(hexmesh.exit_code, 4) << hexmesh.err;
    EXPECT_NE(hexmesh.err.find("(--max-cells)"), std::string::npos) << hexmesh.err;
    const nlohmann::json error = octavo("octree ball.csg --depth 21 --max-nodes 100K --json").json()["error"];
    EXPECT_EQ(error["option"], "--max-nodes");
    EXPECT_EQ(error["message"].get<std::string>().find("max"), std::string::npos) << error;
    for (const char* wrong : {"0", "K", "-5M", "12X", "nan", "1e30"}) {
        const Ran usage = octavo(std::string("octree cube.stl --max-nodes ") + wrong);
        EXPECT_EQ(usage.exit_code, 2) << wrong;
    }
}

TEST_F(Verbs, OctreeTakesAPrecision) {
    ASSERT_EQ(octavo("shape cube -o cube.ply").exit_code, 0);
    const Ran ran = octavo("octree cube.ply --precision 0.01 --json");
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    const double size = ran.json()["result"]["cell_size"];
    EXPECT_LE(size, 0.01);
    EXPECT_GT(size, 0.005);
    EXPECT_EQ(octavo("octree cube.ply --precision 1e-30").exit_code, 4);
    EXPECT_EQ(octavo("octree cube.ply --precision 0.1 --depth 3").exit_code, 2);
}

TEST_F(Verbs, OctreeReadsOpenScadTreesByBothMethods) {
    write("part.csg",
          "difference() {\n  cube(size = [4, 4, 4], center = true);\n  sphere(r = 2.5, $fn = 30);\n}\n");
    const Ran top_down = octavo("octree part.csg --depth 7 -o a.oct --json");
    ASSERT_EQ(top_down.exit_code, 0) << top_down.err;
    const json result = top_down.json()["result"];
    const double volume =
        64 - 4.0 / 3 * 3.14159265358979 * 15.625 + 6 * 3.14159265358979 * 0.25 / 3 * (7.5 - 0.5);
    EXPECT_LE(result["volume_lower"], volume);  // the ball is truly round, and cut by the cube's six sides
    EXPECT_GE(result["volume_upper"], volume);
    ASSERT_EQ(octavo("octree part.csg --depth 7 -o b.oct --method classic").exit_code, 0);
    EXPECT_EQ(read("a.oct"), read("b.oct"));

    write("bad.csg", "union() {\n  cube(size = [1, 1, 1);\n}\n");
    const Ran bad = octavo("octree bad.csg --json");
    EXPECT_EQ(bad.exit_code, 3);
    EXPECT_EQ(bad.json()["error"]["line"], 2);
}

TEST_F(Verbs, OctreeRefusesAnOpenSurfaceNamingFacets) {
    write("open.off", open_cube);
    const Ran ran = octavo("octree open.off -o open.oct --json");
    EXPECT_EQ(ran.exit_code, 3);
    EXPECT_EQ(ran.json()["error"]["code"], "not_a_solid");
    EXPECT_GE(ran.json()["error"]["faces"].size(), 1U);
    EXPECT_FALSE(std::filesystem::exists(path("open.oct")));
    EXPECT_EQ(octavo("octree open.off -o open.oct --open winding").exit_code, 0);
}

TEST_F(Verbs, WhatEnclosesNothingIsRefusedOrTold) {
    write("needle.off", "OFF\n3 2 0\n0 0 0\n1 1 1\n2 2 2\n3 0 1 2\n3 2 1 0\n");
    write("points.csv", "1,1,1\n");
    ASSERT_EQ(octavo("shape cube -o cube.stl").exit_code, 0);
    for (const char* arguments : {"octree needle.off", "hexmesh needle.off"}) {
        const Ran ran = octavo(arguments);
        EXPECT_EQ(ran.exit_code, 3) << arguments;
        EXPECT_NE(ran.err.find("needle.off: the surface encloses nothing"), std::string::npos) << ran.err;
    }
    for (const char* arguments :
         {"build needle.off", "contains needle.off points.csv", "distance needle.off points.csv"}) {
        const Ran ran = octavo(arguments);
        EXPECT_EQ(ran.exit_code, 0) << arguments;
        EXPECT_NE(ran.err.find("none of the facets has any area"), std::string::npos) << ran.err;
    }
    EXPECT_NE(octavo("bsp needle.off").err.find("the solid is empty"), std::string::npos);
    // A set operation leaves it out, and says so.
    const Ran united = octavo("union cube.stl needle.off -o both.ply");
    EXPECT_EQ(united.exit_code, 0) << united.err;
    EXPECT_NE(united.err.find("2 facets have no area"), std::string::npos) << united.err;
}

// The bottom is a hexagon of four triangles, so that the sides have other numbers than their triangles.
constexpr const char* open_prism = R"(OFF
12 7 0
2 0 0
1 2 0
-1 2 0
-2 0 0
-1 -2 0
1 -2 0
2 0 1
1 2 1
-1 2 1
-2 0 1
-1 -2 1
1 -2 1
6 5 4 3 2 1 0
4 0 1 7 6
4 1 2 8 7
4 2 3 9 8
4 3 4 10 9
4 4 5 11 10
4 5 0 6 11
)";

TEST_F(Verbs, ErrorsNameTheFacesOfTheFileAndNotTriangles) {
    write("prism.off", open_prism);
    write("points.csv", "0,0,0.5\n");
    ASSERT_EQ(octavo("shape cube -o cube.stl").exit_code, 0);
    for (const char* arguments :
         {"octree prism.off", "hexmesh prism.off", "hexmesh cube.stl prism.off", "bsp prism.off",
          "contains prism.off points.csv", "distance prism.off points.csv",
          "union cube.stl prism.off -o out.ply", "eval 'a - b' a=cube.stl b=prism.off -o out.ply"}) {
        const Ran ran = octavo(std::string(arguments) + " --json");
        EXPECT_EQ(ran.exit_code, 3) << arguments;
        const json error = ran.json()["error"];
        EXPECT_EQ(error["file"], "prism.off") << arguments;
        EXPECT_EQ(error["faces"], json::array({1, 2, 3, 4, 5, 6})) << arguments << ran.out;
    }
    const Ran closed = octavo("hexmesh prism.off --open winding");
    EXPECT_NE(closed.err.find("near facet 1"), std::string::npos) << closed.err;
}

TEST_F(Verbs, SetOperationsNameTheirOperandsAsUsersDo) {
    write("prism.off", open_prism);
    ASSERT_EQ(octavo("shape cube -o cube.stl").exit_code, 0);
    const Ran united = octavo("union cube.stl prism.off -o out.ply");
    EXPECT_NE(united.err.find("error: prism.off: is not closed"), std::string::npos) << united.err;
    EXPECT_NE(united.err.find("--open winding"), std::string::npos) << united.err;
    const Ran named = octavo("eval 'body - bore' body=cube.stl bore=prism.off -o out.ply");
    EXPECT_NE(named.err.find("error: prism.off: bore is not closed"), std::string::npos) << named.err;
    EXPECT_NE(named.err.find("--open winding"), std::string::npos) << named.err;
    // Warnings too, and where --open winding is already there it is not advised.
    const Ran closed = octavo("union cube.stl prism.off -o out.ply --open winding");
    EXPECT_EQ(closed.exit_code, 0) << closed.err;
    EXPECT_NE(closed.err.find("1 operand is open, the first is prism.off: 6 open sides were closed by"),
              std::string::npos)
        << closed.err;
    ASSERT_EQ(octavo("shape cube --size 1e-6 -o small.stl").exit_code, 0);
    ASSERT_EQ(octavo("shape cube --size 1e3 -o large.stl").exit_code, 0);
    const Ran small = octavo("eval 'a - b - c' a=large.stl b=small.stl c=small.stl -o out.ply");
    EXPECT_NE(small.err.find("b, c are small beside the whole"), std::string::npos) << small.err;
    for (const Ran& ran : {united, named, closed, small})
        for (const char* number : {"operand 0", "operand 1", "operands 1"})
            EXPECT_EQ(ran.err.find(number), std::string::npos) << ran.err;
}

TEST_F(Verbs, ContainsAnswersInOnAndOut) {
    ASSERT_EQ(octavo("shape cube --size 2 -o cube.stl").exit_code, 0);
    write("points.csv",
          "x,y,z\n0,0,0\n1,0,0\n1,1,1\n0.9999999999999999,0,0\n1.0000000000000002,0,0\n5,5,5\n");
    const Ran ran = octavo("contains cube.stl points.csv -o sides.csv --json");
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_EQ(ran.json()["result"],
              (json{{"inside", 2}, {"on", 2}, {"outside", 2}, {"largest_displacement", 0.0}}));
    EXPECT_EQ(read("sides.csv"), "side\n-1\n0\n0\n-1\n1\n1\n");
    EXPECT_EQ(octavo("contains cube.stl points.csv").out, read("sides.csv"));
}

TEST_F(Verbs, ContainsWarnsOfPointsThatAreNowhere) {
    ASSERT_EQ(octavo("shape sphere --detail 3 -o ball.ply").exit_code, 0);
    write("points.csv", "nan,0,0\n0,0,0\ninf,0,0\n");
    const json answer = octavo("contains ball.ply points.csv --json").json();
    EXPECT_EQ(answer["result"]["outside"], 2);
    EXPECT_EQ(answer["warnings"].size(), 1U) << answer["warnings"];
}

TEST_F(Verbs, RepairListsWhatItDid) {
    std::string doubled(open_cube);
    doubled.replace(doubled.find("8 5 0"), 5, "8 7 0");
    write("doubled.off", doubled + "4 4 5 6 7\n4 4 5 6 7\n");
    ASSERT_EQ(octavo("check doubled.off").exit_code, 1);
    const Ran ran = octavo("repair doubled.off -o fixed.off --json");
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_EQ(ran.json()["result"]["valid"], true);
    EXPECT_EQ(octavo("check fixed.off").exit_code, 0);
}

TEST_F(Verbs, RenderMakesAPngOfAMeshAndOfAnOctree) {
    ASSERT_EQ(octavo("shape gear -o gear.ply").exit_code, 0);
    ASSERT_EQ(octavo("octree gear.ply --depth 5 -o gear.oct").exit_code, 0);
    for (const char* model : {"gear.ply", "gear.oct"}) {
        const Ran ran = octavo(std::string("render ") + model + " --cut x -o out.png --size 200x150 --json");
        ASSERT_EQ(ran.exit_code, 0) << ran.err;
        EXPECT_GT(ran.json()["result"]["polygons"], 0);
        EXPECT_EQ(read("out.png").substr(1, 3), "PNG");
    }
    // A picture goes through a pipe as well.
    EXPECT_EQ(shell("$octavo render gear.ply -o - --size 80x60 | head -c 4 | tail -c 3").out, "PNG");
}

TEST_F(Verbs, ConvertKeepsEveryDouble) {
    ASSERT_EQ(octavo("shape rock --detail 4 -o a.ply").exit_code, 0);
    for (const char* command :
         {"convert a.ply b.obj", "convert b.obj c.off", "convert c.off d.3mf", "convert d.3mf e.ply"})
        ASSERT_EQ(octavo(command).exit_code, 0) << command;
    EXPECT_EQ(read("a.ply"), read("e.ply"));
}

TEST_F(Verbs, ConvertAndRepairTellWhatIsNotKept) {
    write("tetrahedron.obj",
          "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\ng side\n"
          "f 1/1 3/1 2/1\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
    const json kinds = json::array({"not kept: materials, texture coordinates and groups"});
    EXPECT_EQ(octavo("convert tetrahedron.obj out.stl --json").json()["warnings"], kinds);
    EXPECT_EQ(octavo("repair tetrahedron.obj -o out.stl --json").json()["warnings"], kinds);
    // Who only asks loses nothing.
    EXPECT_EQ(octavo("check tetrahedron.obj --json").json()["warnings"], json::array());
    write("open.off", open_cube);
    EXPECT_EQ(octavo("convert open.off out.off --json").json()["warnings"],
              json::array({"5 polygons became 10 triangles"}));
    ASSERT_EQ(octavo("convert tetrahedron.obj inches.3mf --unit inch").exit_code, 0);
    EXPECT_EQ(octavo("convert inches.3mf out.3mf --json").json()["warnings"], json::array());
    EXPECT_EQ(octavo("convert inches.3mf out.ply --json").json()["warnings"],
              json::array({"the unit is not kept: inch; ply states none"}));
}

TEST_F(Verbs, PointsWithDecimalCommasAreNotTakenForNames) {
    ASSERT_EQ(octavo("shape cube -o cube.stl").exit_code, 0);
    write("points.csv", "0,1;0,1;0,1\n");
    const Ran ran = octavo("contains cube.stl points.csv");
    EXPECT_EQ(ran.exit_code, 3);
    EXPECT_EQ(ran.out, "");
    EXPECT_NE(ran.err.find("points.csv:1"), std::string::npos) << ran.err;
}

}  // namespace
}  // namespace octavo::tests
