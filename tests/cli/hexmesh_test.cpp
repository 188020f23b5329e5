// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <filesystem>
#include <string>

#include <places.hpp>

#include "cli/program.hpp"

// The verb hexmesh, end to end: the keys that scripts rely on, every kind of output, and what it refuses.

namespace octavo::tests {
namespace {

using Hexmesh = ProgramTest;
using nlohmann::json;

TEST_F(Hexmesh, TellsWhatScriptsRelyOn) {
    ASSERT_EQ(octavo("shape cube --size 2 -o cube.off").exit_code, 0);
    const Ran ran = octavo("hexmesh cube.off -p 0.25 --largest 0.25 -o cube.inp --json");
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    const json result = ran.json()["result"];
    EXPECT_EQ(result["cells"], 512);
    EXPECT_EQ(result["nodes"], 729);
    EXPECT_EQ(result["hanging_nodes"], 0);
    EXPECT_EQ(result["interior"], 512);
    EXPECT_EQ(result["boundary"], 0);
    EXPECT_EQ(result["volume"], 8.0);
    ASSERT_EQ(result["levels"].size(), 1u);
    EXPECT_EQ(result["levels"][0]["side"], 0.25);
    ASSERT_EQ(result["solids"].size(), 1u);
    EXPECT_EQ(result["solids"][0]["name"], "cube");
    EXPECT_EQ(result["solids"][0]["filled_volume"], 8.0);
    EXPECT_TRUE(ran.json()["timings"].contains("mesh"));
}

TEST_F(Hexmesh, SaysInWordsHowMuchOfASolidIsFilled) {
    ASSERT_EQ(octavo("shape cube --size 2 -o cube.stl").exit_code, 0);
    ASSERT_EQ(octavo("shape rock --detail 6 -o rock.ply").exit_code, 0);
    for (const char* arguments : {"cube.stl -p 0.25", "cube.stl -p 0.3", "rock.ply --level 3"}) {
        const Ran ran = octavo(std::string("hexmesh ") + arguments);
        ASSERT_EQ(ran.exit_code, 0) << ran.err;
        EXPECT_NE(ran.out.find(", all of it filled\n"), std::string::npos) << ran.out;
        EXPECT_EQ(ran.out.find("filled but"), std::string::npos) << ran.out;
    }
}

TEST_F(Hexmesh, TellsWhatBodyASolverWillSee) {
    ASSERT_EQ(octavo("shape cube --size 2 -o cube.off").exit_code, 0);
    const json exact = octavo("hexmesh cube.off -p 0.25 -o a.inp --json").json();
    EXPECT_EQ(exact["result"]["mesh_volume"], 8.0);
    EXPECT_EQ(exact["result"]["pieces"], 1);
    EXPECT_TRUE(exact["warnings"].empty()) << exact;

    // Cells that a rock touches stick out of it; the boundary drawn onto it gives the volume back.
    ASSERT_EQ(octavo("shape rock --detail 6 -o rock.ply").exit_code, 0);
    const Ran stairs = octavo("hexmesh rock.ply --level 3 -o rock.inp");
    EXPECT_NE(stairs.err.find("% more volume than the solid"), std::string::npos) << stairs.err;
    EXPECT_NE(stairs.out.find("the mesh: 1 piece, volume "), std::string::npos) << stairs.out;
    EXPECT_EQ(octavo("hexmesh rock.ply --level 3 -o rock.vtu").err.find("% more"), std::string::npos)
        << "a viewer has the fractions";
    const json fitted = octavo("hexmesh rock.ply --level 6 --fit -o rock.inp --json").json()["result"];
    EXPECT_NEAR(fitted["mesh_volume"].get<double>() / fitted["solids"][0]["exact_volume"].get<double>(), 1,
                0.02);
    EXPECT_GT(fitted["quality"]["shortest_edge"].get<double>(), 0);
    EXPECT_GE(fitted["quality"]["largest_edge_ratio"].get<double>(), 1);
}

TEST_F(Hexmesh, WarnsWhenTheMeshFallsIntoMorePiecesThanTheSolid) {
    // A dumbbell: two cubes and a rod between them that cells half filled or less leave out.
    const auto moved = [](const std::string& x, const std::string& yz, const std::string& size) {
        return "multmatrix([[1,0,0," + x + "],[0,1,0," + yz + "],[0,0,1," + yz +
               "],[0,0,0,1]]) { cube(size = [" + size + "]); }";
    };
    write("dumbbell.csg", "union() { cube(size = [4,4,4]);" + moved("4", "1.9", "8,0.2,0.2") +
                              moved("12", "0", "4,4,4") + "}");
    const Ran ran = octavo("hexmesh dumbbell.csg -p 1 --keep half");
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_NE(ran.err.find("the mesh falls into 2 pieces, the solid is of 1 shell"), std::string::npos)
        << ran.err;
    EXPECT_EQ(octavo("hexmesh dumbbell.csg -p 0.1 --keep half").err.find("falls into"), std::string::npos);
}

TEST_F(Hexmesh, WritesEveryFormat) {
    ASSERT_EQ(octavo("shape gear -o gear.ply").exit_code, 0);
    for (const char* output : {"g.inp", "g.mesh", "g.csv", "g.p8est", "g.vtu", "g.htg"}) {
        const Ran ran = octavo(std::string("hexmesh gear.ply --level 4 -o ") + output);
        EXPECT_EQ(ran.exit_code, 0) << output << ran.err;
        EXPECT_GT(std::filesystem::file_size(path(output)), 1000u) << output;
    }
    EXPECT_EQ(octavo("hexmesh gear.ply --level 4 -o case").exit_code, 0);
    EXPECT_TRUE(std::filesystem::exists(path("case/constant/polyMesh/owner")));
    EXPECT_EQ(octavo("hexmesh gear.ply --level 4 --fit -o fitted_case").exit_code, 0);
    EXPECT_FALSE(std::filesystem::exists(path("fitted_case/constant/polyMesh/cellLevel"))) << "no octants";
    EXPECT_EQ(octavo("hexmesh gear.ply --level 4 --conforming -o g.msh").exit_code, 0);
    EXPECT_EQ(read("g.msh").rfind("$MeshFormat", 0), 0u);
    EXPECT_EQ(octavo("hexmesh gear.ply --level 4 --to p8est-30 -o wide.p8est").exit_code, 0);
    EXPECT_EQ(read("wide.p8est").size(), read("g.p8est").size());
    EXPECT_NE(read("wide.p8est"), read("g.p8est"));
    EXPECT_EQ(octavo("hexmesh gear.ply --level 4 -o g.oct").exit_code, 0);
    const Ran again = octavo("hexmesh g.oct -p 10 --json");
    EXPECT_EQ(again.exit_code, 0) << again.err;
    const Ran piped = octavo("hexmesh gear.ply --level 4 -o - --to abaqus");
    EXPECT_EQ(piped.out, read("g.inp"));
}

TEST_F(Hexmesh, MeshesSeveralSolidsAndCsgTrees) {
    write("a.csg",
          "difference() { cube(size = [4, 4, 4], center = true); cylinder(h = 9, r1 = 1, r2 = 1, "
          "center = true, $fn = 16); }");
    ASSERT_EQ(octavo("shape cube --size 2 -o b.stl").exit_code, 0);
    const Ran ran = octavo("hexmesh a.csg b.stl -p 0.3 --size b.stl:0.1:0.2 -o ab.inp --json");
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    const json solids = ran.json()["result"]["solids"];
    ASSERT_EQ(solids.size(), 2u);
    for (const json& solid : solids)
        EXPECT_NEAR(solid["filled_volume"].get<double>() / solid["exact_volume"].get<double>(), 1, 1e-9);
    // 16-gon of radius 1.
    EXPECT_NEAR(solids[0]["exact_volume"].get<double>(), 64 - 4 * 8 * std::sin(M_PI / 8), 1e-5);
    const std::string file = read("ab.inp");
    for (const char* set :
         {"ELSET=A\n", "ELSET=B\n", "ELSET=A_AND_B\n", "NAME=SURFACE_OF_A\n", "NSET=XMIN\n"})
        EXPECT_NE(file.find(set), std::string::npos) << set;
}

TEST_F(Hexmesh, FitsAndReportsQuality) {
    ASSERT_EQ(octavo("shape gear -o gear.ply").exit_code, 0);
    const Ran ran = octavo("hexmesh gear.ply --level 4 --fit -o fitted.inp --json");
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    const json result = ran.json()["result"];
    EXPECT_EQ(result["quality"]["not_proved_positive"], 0);
    EXPECT_GE(result["quality"]["least_scaled_jacobian"].get<double>(), 0.2);
    EXPECT_EQ(result["quality"]["histogram"].size(), 10u);
    EXPECT_LT(result["fit"]["mean_distance"].get<double>(),
              result["fit"]["mean_distance_before"].get<double>());
    EXPECT_NE(octavo("hexmesh gear.ply --level 4 --fit").out.find("scaled Jacobian"), std::string::npos);
}

TEST_F(Hexmesh, SaysWhenASolidFillsNoCell) {
    write("sheet.csg",
          "multmatrix([[1, 0, 0, 0.1], [0, 1, 0, 0.1], [0, 0, 1, 0.1], [0, 0, 0, 1]]) { cube(size = [10, 10, "
          "0.001]); }");
    ASSERT_EQ(octavo("shape cube --size 8 -o cube.off").exit_code, 0);
    for (const char* options : {"--fit", "--conforming", "--keep half"}) {
        const Ran beside = octavo(std::string("hexmesh sheet.csg cube.off --level 4 ") + options);
        EXPECT_EQ(beside.exit_code, 0) << beside.err;
        EXPECT_NE(beside.err.find("sheet: no cell of the mesh belongs to it"), std::string::npos)
            << options << beside.err;
        const Ran alone = octavo(std::string("hexmesh sheet.csg --level 4 -o sheet.inp ") + options);
        EXPECT_EQ(alone.exit_code, 3) << alone.err;
        EXPECT_NE(alone.err.find("the mesh has no cells"), std::string::npos) << options << alone.err;
        EXPECT_FALSE(std::filesystem::exists(path("sheet.inp")));
    }
    EXPECT_EQ(octavo("hexmesh sheet.csg --level 4").err.find("no cell of the mesh"), std::string::npos);
}

TEST_F(Hexmesh, SaysWhenABoxMissesTheModel) {
    ASSERT_EQ(octavo("shape cube --size 8 -o cube.off").exit_code, 0);
    for (const char* options : {"", "--conforming "}) {
        const Ran ran = octavo(std::string("hexmesh cube.off --level 3 --box 0,0,0,1,1,1:0.5 ") + options +
                               "--box 50,50,50,51,51,51:0.1");
        EXPECT_EQ(ran.exit_code, 0) << ran.err;
        EXPECT_NE(ran.err.find("--box number 2 misses the model"), std::string::npos) << ran.err;
        EXPECT_EQ(ran.err.find("--box number 1"), std::string::npos) << ran.err;
    }
}

TEST_F(Hexmesh, NamesTheLevelWhenItIsTooDeep) {
    ASSERT_EQ(octavo("shape cube --size 8 -o cube.off").exit_code, 0);
    const Ran ran = octavo("hexmesh cube.off --level 21");
    EXPECT_NE(ran.exit_code, 0);
    EXPECT_NE(ran.err.find("level 21"), std::string::npos) << ran.err;
    EXPECT_EQ(ran.err.find("precision"), std::string::npos) << ran.err;
}

TEST_F(Hexmesh, ProvesCellsOfAnySizeOrRefusesThem) {
    for (const auto& [size, code] : {std::pair{"1e-110", 4}, {"1e-85", 0}, {"1e85", 0}, {"1e115", 4}}) {
        ASSERT_EQ(octavo(std::string("shape sphere --detail 4 -o ball.off --size ") + size).exit_code, 0);
        for (const char* how : {"--fit", "--conforming"}) {
            const Ran ran =
                octavo(std::string("hexmesh ball.off --level 3 --max-cells 1M -o ball.inp --json ") + how);
            ASSERT_EQ(ran.exit_code, code) << size << how << ran.err;
            if (code == 0) {
                EXPECT_EQ(ran.json()["result"]["quality"]["not_proved_positive"], 0) << size << how;
            } else {
                EXPECT_NE(ran.err.find("1e90"), std::string::npos) << ran.err;
            }
        }
    }
}

TEST_F(Hexmesh, AnOpenfoamCaseKeepsForeignFilesAndIsWhole) {
    ASSERT_EQ(octavo("shape cube -o cube.off").exit_code, 0);
    std::filesystem::create_directories(path("case/constant/polyMesh"));
    write("case/constant/polyMesh/blockMeshDict", "mine");
    const Ran ran = octavo("hexmesh cube.off --level 2 -o case");
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_NE(ran.err.find("keeps what others put there: blockMeshDict"), std::string::npos) << ran.err;
    EXPECT_EQ(read("case/constant/polyMesh/blockMeshDict"), "mine");
    for (const char* name : {"controlDict", "fvSchemes", "fvSolution"})
        EXPECT_NE(read(std::string("case/system/") + name).find(name), std::string::npos);
    write("a_file", "mine");
    EXPECT_EQ(octavo("hexmesh cube.off --level 2 -o a_file").exit_code, 3);
    EXPECT_EQ(read("a_file"), "mine");
}

TEST_F(Hexmesh, GoesFromOpenscadToAPictureOfStresses) {
    // The worked example of docs/methods/hexmesh.md, coarser.
    const std::string examples = std::string(source_folder) + "/docs/examples/";
    for (const char* file : {"bracket.csg", "bracket.inp", "mises.awk"})
        std::filesystem::copy_file(examples + file, path(file));
    const std::string mesh = "hexmesh bracket.csg -p 4 --fit ";
    const Ran meshed = octavo(mesh + "-o bracket_mesh.inp --json");
    ASSERT_EQ(meshed.exit_code, 0) << meshed.err;
    const Ran solved = shell(
        "command -v ccx > /dev/null || exit 77; OMP_NUM_THREADS=1 ccx bracket > log 2>&1 && awk -f "
        "mises.awk bracket.dat > stress.csv");
    if (solved.exit_code == 77) GTEST_SKIP() << "CalculiX (ccx) is not installed";
    ASSERT_EQ(solved.exit_code, 0) << read("log");
    const Ran drawn = octavo(mesh + "--values stress.csv --picture stress.png -o stress.vtu");
    ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
    EXPECT_EQ(read("stress.png").substr(1, 3), "PNG");
    EXPECT_NE(read("stress.vtu").find("Name=\"value\""), std::string::npos);
    write("short.csv", "1\n2\n");
    EXPECT_EQ(octavo(mesh + "--values short.csv --picture no.png").exit_code, 3);
    write("words.csv", "stress\nhigh\n");
    const Ran words = octavo(mesh + "--values words.csv --picture no.png");
    EXPECT_EQ(words.exit_code, 3);
    EXPECT_NE(words.err.find("words.csv:2"), std::string::npos) << words.err;
    EXPECT_EQ(octavo(mesh + "--picture mesh.jpg").exit_code, 2);
}

TEST_F(Hexmesh, RefusesBadUsageAndBadDataWithThePlace) {
    ASSERT_EQ(octavo("shape cube --size 2 -o cube.off").exit_code, 0);
    for (const char* arguments : {"hexmesh",
                                  "hexmesh cube.off --level 22",
                                  "hexmesh cube.off -p 0",
                                  "hexmesh cube.off --size cube.off",
                                  "hexmesh cube.off --box 1,2,3:4",
                                  "hexmesh cube.off --level 3 -p 1",
                                  "hexmesh cube.off --curvature 1:999",
                                  "hexmesh cube.off --conforming --balance face",
                                  "hexmesh none.off --fit --balance face",
                                  "hexmesh cube.off -o cube.xyz",
                                  "hexmesh cube.off --size other.off:1 -o c.inp",
                                  "hexmesh cube.off -o - --to abaqus --json",
                                  "hexmesh - - -o c.inp",
                                  "hexmesh cube.off --level two",
                                  "hexmesh cube.off --layers 1.5",
                                  "hexmesh cube.off --balance sides",
                                  "hexmesh cube.off --keep some",
                                  "hexmesh cube.off -o -",
                                  "hexmesh cube.off --to stl -o c.inp",
                                  "hexmesh cube.off --proximity nan",
                                  "hexmesh cube.off --fit -o c.csv",
                                  "hexmesh cube.off --fit -o c.p8est",
                                  "hexmesh cube.off --fit --to p8est-30 -o c.p8est",
                                  "hexmesh cube.off --fit -o c.htg",
                                  "hexmesh cube.off --fit -o c.oct"})
        EXPECT_EQ(octavo(arguments).exit_code, 2) << arguments;
    for (const char* arguments :
         {"hexmesh none.off -o c.inp", "hexmesh cube.off -o c.msh --level 3 --box 0,0,0,0.1,0.1,0.1:0.05",
          "hexmesh cube.off --balance face -o c.inp"}) {
        EXPECT_EQ(octavo(arguments).exit_code, 3) << arguments;
        EXPECT_FALSE(std::filesystem::exists(path("c.inp"))) << arguments;
    }
    write("open.off", "OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n");
    const Ran ran = octavo("hexmesh cube.off open.off -o c.inp --json");
    EXPECT_EQ(ran.exit_code, 3);
    EXPECT_EQ(ran.json()["error"]["file"], "open.off");
    EXPECT_EQ(ran.json()["error"]["message"].get<std::string>().find("solid 1"), std::string::npos);
    EXPECT_FALSE(ran.json()["error"]["faces"].empty());
    EXPECT_NE(ran.err.find("the first runs from"), std::string::npos) << ran.err;
}

TEST_F(Hexmesh, OverwritesNothingThatItReads) {
    ASSERT_EQ(octavo("shape cube --size 2 -o cube.off").exit_code, 0);
    write("values.csv", "1\n2\n");
    for (const char* arguments : {"hexmesh cube.off --level 0 --values values.csv -o values.csv",
                                  "hexmesh cube.off --level 0 --values values.csv -o ./values.csv"}) {
        const Ran ran = octavo(arguments);
        EXPECT_NE(ran.exit_code, 0);
        EXPECT_NE(ran.err.find("would overwrite"), std::string::npos) << ran.err;
        EXPECT_EQ(read("values.csv"), "1\n2\n");
    }
}

/// Two boxes in one file that overlap in a slice of 0.05 × 4.4 × 4.4, thinner than cells of 1.
constexpr const char* overlapping_boxes =
    "v 0 0 0\nv 4.6 0 0\nv 0 4.6 0\nv 4.6 4.6 0\nv 0 0 4.6\nv 4.6 0 4.6\nv 0 4.6 4.6\n"
    "v 4.6 4.6 4.6\nv 4.55 .1 .1\nv 9 .1 .1\nv 4.55 4.5 .1\nv 9 4.5 .1\nv 4.55 .1 4.5\n"
    "v 9 .1 4.5\nv 4.55 4.5 4.5\nv 9 4.5 4.5\n"
    "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n"
    "f 9 11 12 10\nf 13 14 16 15\nf 9 10 14 13\nf 11 15 16 12\nf 9 13 15 11\nf 10 12 16 14\n";

TEST_F(Hexmesh, SaysWhichFilesAndFacetsOverlapThemselves) {
    write("thin.obj", overlapping_boxes);
    const Ran refused = octavo("hexmesh thin.obj -p 1 -o thin.vtu --overlaps reject --json");
    EXPECT_EQ(refused.exit_code, 3);
    EXPECT_EQ(refused.json()["error"]["file"], "thin.obj");
    EXPECT_EQ(refused.json()["error"]["faces"].size(), 2u);
    const Ran counted = octavo("hexmesh thin.obj -p 1 -o thin.vtu --overlaps winding --json");
    EXPECT_EQ(counted.exit_code, 0) << counted.err;
    EXPECT_EQ(counted.json()["result"]["overlaps"], true);
    EXPECT_NE(counted.err.find("overlaps"), std::string::npos) << counted.err;
}

TEST_F(Hexmesh, MeshesTheUnionOfWhatOverlapsItselfAndWarns) {
    write("thin.obj", overlapping_boxes);
    ASSERT_EQ(octavo("shape cube --size 2 -o cube.off").exit_code, 0);
    const double expected = 4.6 * 4.6 * 4.6 + (9 - 4.6) * 4.4 * 4.4;
    for (const char* more : {"", " --conforming", " --fit"}) {
        const Ran ran = octavo(std::string("hexmesh cube.off thin.obj -p 1 -o out.vtu --json") + more);
        ASSERT_EQ(ran.exit_code, 0) << ran.err;
        EXPECT_NE(ran.err.find("thin.obj: the surface overlaps itself"), std::string::npos) << ran.err;
        EXPECT_NE(ran.err.find("near facet"), std::string::npos) << ran.err;
        const auto result = ran.json()["result"];
        EXPECT_EQ(result["overlaps"], false);
        EXPECT_EQ(result["solids"][0]["united"], false);
        EXPECT_EQ(result["solids"][1]["united"], true);
        EXPECT_NEAR(result["solids"][1]["exact_volume"], expected, 1e-5);
        if (std::string(more).empty()) {
            EXPECT_NEAR(result["volume"].get<double>(), expected + 8, 1e-5);
        }
    }
    // What is open as well is closed first where that is asked for.
    std::string open = overlapping_boxes;
    open.erase(open.rfind("f "));
    write("holed.obj", open);
    EXPECT_EQ(octavo("hexmesh holed.obj -p 1").exit_code, 3);
    const Ran closed = octavo("hexmesh holed.obj -p 1 --open winding --json");
    ASSERT_EQ(closed.exit_code, 0) << closed.err;
    EXPECT_NE(closed.err.find("overlaps itself"), std::string::npos) << closed.err;
    EXPECT_NE(closed.err.find("close"), std::string::npos) << "and of the hole: " << closed.err;
    EXPECT_NEAR(closed.json()["result"]["solids"][0]["exact_volume"], expected, 1e-5);
    // A union is no remedy for what is open or inside out.
    write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n");
    write("out.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n");
    EXPECT_NE(octavo("hexmesh open.obj").err.find("not closed"), std::string::npos);
    EXPECT_NE(octavo("hexmesh out.obj").err.find("inside out"), std::string::npos);
}

TEST_F(Hexmesh, CallsAnEstimateAnEstimate) {
    ASSERT_EQ(octavo("shape sphere --size 2 -o ball.off").exit_code, 0);
    const auto result = [&](const std::string& more) {
        return octavo("hexmesh ball.off --level 5 --json" + more).json()["result"];
    };
    EXPECT_TRUE(result("").contains("volume"));
    EXPECT_FALSE(result(" --no-fractions").contains("volume"));
    EXPECT_TRUE(result(" --no-fractions").contains("estimated_volume"));
    const auto conforming = result(" --conforming");
    EXPECT_NEAR(conforming["volume"].get<double>() / conforming["mesh_volume"].get<double>(), 1, 1e-12)
        << "the cells, each wholly in";
}

}  // namespace
}  // namespace octavo::tests
