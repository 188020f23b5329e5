// SPDX-License-Identifier: Apache-2.0
#include "cli/program.hpp"

// The verbs of BSP-octrees: bsp, mill, stats and convert on .bso.

namespace octavo::tests {
namespace {

using BspVerbs = ProgramTest;

TEST_F(BspVerbs, MakeTreesAndMeshesOfThem) {
    ASSERT_EQ(octavo("shape gear -o gear.ply").exit_code, 0);
    const Ran made = octavo("bsp gear.ply -o gear.bso --json");
    ASSERT_EQ(made.exit_code, 0) << made.err;
    for (const char* key : {"leaves", "white", "black", "bsp_leaves", "bsp_nodes", "planes", "bytes"})
        EXPECT_TRUE(made.json()["result"].contains(key)) << key;
    EXPECT_EQ(made.json()["result"]["bytes"], read("gear.bso").size());
    const Ran stats = octavo("stats gear.bso --json");
    ASSERT_EQ(stats.exit_code, 0) << stats.err;
    EXPECT_EQ(stats.json()["result"]["bsp_nodes"], made.json()["result"]["bsp_nodes"]);
    // Back to a mesh, both ways.
    ASSERT_EQ(octavo("bsp gear.bso -o back.ply").exit_code, 0);
    ASSERT_EQ(octavo("convert gear.bso other.ply").exit_code, 0);
    EXPECT_EQ(octavo("check back.ply").exit_code, 0);
    const double volume = octavo("info gear.ply --json").json()["result"]["volume"];
    for (const char* file : {"back.ply", "other.ply"})
        EXPECT_NEAR(octavo(std::string("info --json ") + file).json()["result"]["volume"], volume,
                    1e-6 * volume);
}

TEST_F(BspVerbs, MillTakesTheToolAwayAtEveryPose) {
    ASSERT_EQ(octavo("shape cube -o work.ply").exit_code, 0);
    ASSERT_EQ(octavo("shape cube -o tool.ply").exit_code, 0);
    // Unit cubes about the origin: each pose takes away an eighth, the last one nothing.
    write("poses.csv", "x,y,z\n0.5,0.5,0.5\n-0.5,0.5,0.5\n5,5,5\n");
    const Ran milled = octavo("mill work.ply --tool tool.ply --path poses.csv -o part.ply --json");
    ASSERT_EQ(milled.exit_code, 0) << milled.err;
    const auto result = milled.json()["result"];
    EXPECT_EQ(result["steps"], 3);
    EXPECT_EQ(result["cutting_steps"], 2);
    EXPECT_NEAR(result["volume"], 0.75, 1e-6);
    EXPECT_TRUE(result.contains("triangles"));
    EXPECT_TRUE(result.contains("seconds_per_step"));
    EXPECT_EQ(octavo("check part.ply").exit_code, 0);
}

TEST_F(BspVerbs, MillTakesTreesAsTheyAre) {
    ASSERT_EQ(octavo("shape sphere --detail 12 -o ball.ply").exit_code, 0);
    ASSERT_EQ(octavo("shape sphere --detail 3 -o tool.ply").exit_code, 0);
    ASSERT_EQ(octavo("bsp ball.ply -o ball.bso").exit_code, 0);
    write("first.csv", "0.3,0.4,0.2\n");
    write("second.csv", "-0.3,0.1,0.4\n");
    write("both.csv", "0.3,0.4,0.2\n-0.3,0.1,0.4\n");
    const auto mill = [&](const std::string& files) {
        return octavo("mill " + files + " --tool tool.ply --json");
    };
    const Ran first = mill("ball.bso --path first.csv -o a.bso"),
              second = mill("a.bso --path second.csv -o b.bso"),
              both = mill("ball.bso --path both.csv -o c.bso");
    for (const Ran& ran : {first, second, both}) ASSERT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_EQ(second.json()["result"]["largest_displacement"], 0) << "nothing was rounded between sessions";
    EXPECT_NEAR(second.json()["result"]["volume"], both.json()["result"]["volume"].get<double>(), 1e-13);
}

TEST_F(BspVerbs, ContainsAsksTheTreeAndNotAMeshOfIt) {
    // An octahedron loses a slanted corner. Cuts end where a mesh has to round; the plane 35 x + 21 y + 15 z = 105 of a
    // face stays what it is, and so do points in it.
    write("work.off",
          "OFF\n6 8 0\n3 0 0\n-3 0 0\n0 5 0\n0 -5 0\n0 0 7\n0 0 -7\n3 0 2 4\n3 2 1 4\n3 1 3 4\n3 3 0 4\n3 2 "
          "0 5\n"
          "3 1 2 5\n3 3 1 5\n3 0 3 5\n");
    write("tool.off", "OFF\n4 4 0\n2.1 0.25 0\n6 0 7\n6 5 -7\n6 -5 -7\n3 0 1 2\n3 0 2 3\n3 0 3 1\n3 1 3 2\n");
    write("poses.csv", "0,0,0\n");
    const Ran milled = octavo("mill work.off --tool tool.off --path poses.csv -o part.bso --json");
    ASSERT_EQ(milled.exit_code, 0) << milled.err;
    ASSERT_EQ(milled.json()["result"]["cutting_steps"], 1);
    std::string points;
    int count = 0;
    for (int i = 1; i < 16; ++i)
        for (int k = 1; i + k < 32; ++k, ++count)
            points += std::to_string(3 * i / 32.0) + "," + std::to_string(5 * k / 32.0) + "," +
                      std::to_string(7 * (32 - i - k) / 32.0) + "\n";
    write("points.csv", points + "nan,0,0\n0,0,0\n9,9,9\n");
    const Ran asked = octavo("contains part.bso points.csv --json");
    ASSERT_EQ(asked.exit_code, 0) << asked.err;
    EXPECT_EQ(asked.json()["result"]["on"], count);
    EXPECT_EQ(asked.json()["result"]["inside"], 1);
    EXPECT_EQ(asked.json()["result"]["outside"], 2);
    EXPECT_EQ(asked.json()["result"]["largest_displacement"], 0);
}

TEST_F(BspVerbs, MillIsNotDisturbedByPosesFarAway) {
    ASSERT_EQ(octavo("shape cube -o work.ply").exit_code, 0);
    ASSERT_EQ(octavo("shape cube -o tool.ply").exit_code, 0);
    write("poses.csv", "0.5,0.5,0.5\n1e15,0,0\n0,-1e300,0\n");
    const Ran milled = octavo("mill work.ply --tool tool.ply --path poses.csv -o part.ply --json");
    ASSERT_EQ(milled.exit_code, 0) << milled.err;
    EXPECT_EQ(milled.json()["result"]["steps"], 3);
    EXPECT_NEAR(milled.json()["result"]["volume"], 0.875, 1e-9);
}

TEST_F(BspVerbs, MillNamesTheFileThatIsNoSolid) {
    ASSERT_EQ(octavo("shape cube -o cube.ply").exit_code, 0);
    write("open.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    write("poses.csv", "0.5,0.5,0.5\n");
    for (const char* files : {"cube.ply --tool open.off", "open.off --tool cube.ply"}) {
        const Ran ran = octavo(std::string("mill ") + files + " --path poses.csv -o part.ply");
        EXPECT_EQ(ran.exit_code, 3);
        EXPECT_NE(ran.err.find("open.off: "), std::string::npos) << ran.err;
    }
    const Ran overflowing = [&] {
        write("poses.csv", "0,0,0\n1e308,1e308,0,1e308,0,1,0,0,0,0,1,0\n");
        return octavo("mill cube.ply --tool cube.ply --path poses.csv -o part.ply");
    }();
    EXPECT_EQ(overflowing.exit_code, 3);
    EXPECT_NE(overflowing.err.find("pose 1"), std::string::npos) << overflowing.err;
    EXPECT_EQ(read("part.ply"), "");
}

TEST_F(BspVerbs, OptionsOfMakingTreesAreForWhatIsNone) {
    ASSERT_EQ(octavo("shape cube -o cube.ply").exit_code, 0);
    ASSERT_EQ(octavo("bsp cube.ply --planes 1 --depth 9 --stop common-point -o cube.bso").exit_code, 0);
    for (const char* option : {"--planes 1", "--depth 9", "--stop common-point"}) {
        const Ran ran = octavo(std::string("bsp cube.bso -o other.bso ") + option);
        EXPECT_EQ(ran.exit_code, 2);
        EXPECT_NE(ran.err.find("holds one already"), std::string::npos) << ran.err;
    }
}

TEST_F(BspVerbs, GoWhereverSolidsDo) {
    // A boundary of TetGen with a pierced facet, milled to a .bso file, cut and drawn from there.
    write("block.poly",
          "16 3\n1 0 0 0\n2 6 0 0\n3 6 6 0\n4 0 6 0\n5 0 0 6\n6 6 0 6\n7 6 6 6\n8 0 6 6\n9 2 2 0\n10 4 2 0\n"
          "11 4 4 0\n12 2 4 0\n13 2 2 6\n14 4 2 6\n15 4 4 6\n16 2 4 6\n10\n2 1\n4 1 4 3 2\n4 9 10 11 12\n1 3 "
          "3 0\n"
          "2 1\n4 5 6 7 8\n4 13 14 15 16\n1 3 3 6\n1\n4 1 2 6 5\n1\n4 2 3 7 6\n1\n4 3 4 8 7\n1\n4 4 1 5 8\n"
          "1\n4 9 13 14 10\n1\n4 10 14 15 11\n1\n4 11 15 16 12\n1\n4 12 16 13 9\n");
    write("tool.csg", "cube(size = [2, 2, 2], center = true);\n");
    write("poses.csv", "0,0,0\n6,6,6\n");
    const Ran milled = octavo("mill block.poly --tool tool.csg --path poses.csv -o part.bso --json");
    ASSERT_EQ(milled.exit_code, 0) << milled.err;
    EXPECT_NEAR(milled.json()["result"]["volume"], 216 - 24 - 2, 1e-6);
    EXPECT_FALSE(milled.json()["result"].contains("triangles"));
    const Ran tree = octavo("bsp block.poly -o block.bso --json");
    ASSERT_EQ(tree.exit_code, 0) << tree.err;
    EXPECT_EQ(tree.json()["result"]["planes"], 10);
    ASSERT_EQ(octavo("difference block.bso part.bso -o chips.ply").exit_code, 0);
    EXPECT_NEAR(octavo("info chips.ply --json").json()["result"]["volume"], 2, 1e-6);
    ASSERT_EQ(octavo("eval 'b - p' b=block.poly p=part.bso -o chips2.ply").exit_code, 0);
    EXPECT_NEAR(octavo("info chips2.ply --json").json()["result"]["volume"], 2, 1e-6);
    ASSERT_EQ(octavo("bsp tool.csg -o tool.bso").exit_code, 0);
    EXPECT_EQ(octavo("render part.bso -o part.svg").exit_code, 0);
    ASSERT_EQ(octavo("convert part.bso part.poly").exit_code, 0);
    EXPECT_NEAR(octavo("info part.poly --json").json()["result"]["volume"], 190, 1e-6);
}

TEST_F(BspVerbs, ReadTreesFromPipes) {
    ASSERT_EQ(octavo("shape rock --detail 16 -o ball.ply").exit_code, 0);
    ASSERT_EQ(octavo("bsp ball.ply -o ball.bso").exit_code, 0);
    ASSERT_GT(read("ball.bso").size(), 40000U);
    // In one go, in pieces with pauses, and cut short: what is missing is named by its byte.
    const Ran piped = shell("$octavo bsp ball.ply -o - | $octavo stats - --json");
    ASSERT_EQ(piped.exit_code, 0) << piped.err;
    EXPECT_EQ(piped.json()["result"]["bytes"], read("ball.bso").size());
    const Ran paused = shell(
        "(head -c 5 ball.bso; sleep 0.1; head -c 20000 ball.bso | tail -c +6; sleep 0.1; tail -c +20001 "
        "ball.bso) | "
        "$octavo bsp - -o back.ply");
    EXPECT_EQ(paused.exit_code, 0) << paused.err;
    EXPECT_EQ(octavo("check back.ply").exit_code, 0);
    const Ran cut = shell("head -c 20000 ball.bso | $octavo stats -");
    EXPECT_EQ(cut.exit_code, 3);
    EXPECT_NE(cut.err.find("20000"), std::string::npos) << cut.err;
}

TEST_F(BspVerbs, RefuseBadFilesWithTheirPlace) {
    ASSERT_EQ(octavo("shape cube -o cube.ply").exit_code, 0);
    write("poses.csv", "1,2,3\n1,2\n");
    const Ran poses = octavo("mill cube.ply --tool cube.ply --path poses.csv -o part.ply");
    EXPECT_EQ(poses.exit_code, 3);
    EXPECT_NE(poses.err.find("poses.csv:2"), std::string::npos) << poses.err;
    EXPECT_EQ(read("part.ply"), "") << "nothing half done is written";
    ASSERT_EQ(octavo("bsp cube.ply -o cube.bso").exit_code, 0);
    std::string bytes = read("cube.bso");
    bytes.back() = static_cast<char>(bytes.back() ^ 1);
    write("damaged.bso", bytes);
    const Ran damaged = octavo("stats damaged.bso");
    EXPECT_EQ(damaged.exit_code, 3);
    EXPECT_NE(damaged.err.find("checksum"), std::string::npos) << damaged.err;
}

}  // namespace
}  // namespace octavo::tests
