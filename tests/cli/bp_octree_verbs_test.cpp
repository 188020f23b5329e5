// SPDX-License-Identifier: Apache-2.0
#include <set>

#include "cli/program.hpp"

// The verbs of BP-octrees (build, stats, convert --level, contains and distance on .bpo), and `distance`.

namespace octavo::tests {
namespace {

using nlohmann::json;
using BpOctreeVerbs = ProgramTest;

TEST_F(BpOctreeVerbs, BuildTellsOfItsLevelsAndStatsReadsThemBack) {
    ASSERT_EQ(octavo("shape knot --detail 96 -o knot.ply").exit_code, 0);
    const Ran ran = octavo("build knot.ply -o knot.bpo --certify --json");
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    const json result = ran.json()["result"];
    for (const char* key : {"levels", "leaves", "planes", "bytes", "volume", "certified"})
        EXPECT_TRUE(result.contains(key)) << key;
    EXPECT_EQ(result["bytes"], std::filesystem::file_size(path("knot.bpo")));
    ASSERT_GE(result["levels"].size(), 3U);
    double before = 1e300;
    std::uint64_t planes = 0;
    for (const json& level : result["levels"]) {
        for (const char* key : {"level", "planes", "volume", "bytes"})
            EXPECT_TRUE(level.contains(key)) << key;
        EXPECT_LT(level["volume"], before);
        EXPECT_GE(level["volume"], result["volume"]);
        before = level["volume"];
        planes += level["planes"].get<std::uint64_t>();
    }
    EXPECT_EQ(planes, result["planes"]);

    json stats = octavo("stats knot.bpo --json").json()["result"];
    for (const char* key : {"levels", "leaves", "planes", "bytes", "volume", "triangles", "depth"})
        EXPECT_EQ(stats[key], result[key]) << key;
    // Head and index tell all that; the rest of the file is not read.
    EXPECT_EQ(stats["arrived"]["bytes"], result["bytes"]);
    EXPECT_EQ(stats["arrived"]["triangles"], result["triangles"]);
    EXPECT_FALSE(stats.contains("certified"));
    stats = octavo("stats knot.bpo --certify --json").json()["result"];
    EXPECT_EQ(stats["certified"], true);
    EXPECT_GT(stats["bytes_read"], result["bytes"]);
    EXPECT_EQ(shell("$octavo stats - --json < knot.bpo").json()["result"]["planes"], result["planes"]);
}

TEST_F(BpOctreeVerbs, NoMoreOfALargeFileIsReadThanIsAskedFor) {
    ASSERT_EQ(octavo("shape knot --detail 400 -o knot.ply").exit_code, 0);
    const json built = octavo("build knot.ply -o knot.bpo --quality fast --json").json()["result"];
    const auto size = built["bytes"].get<std::size_t>();
    ASSERT_GT(size, 150000U);
    EXPECT_EQ(octavo("stats knot.bpo --json").json()["result"]["bytes_read"], 65536);
    const json level = octavo("convert knot.bpo level.off --level 2 --json").json()["result"];
    EXPECT_LT(level["bytes_read"], 65536 + size / 4);
    // All but the last byte: all but the triangles of the last chunk are there.
    write("most.bpo", read("knot.bpo").substr(0, size - 1));
    const json arrived = octavo("stats most.bpo --json").json()["result"]["arrived"];
    EXPECT_EQ(arrived["levels"], built["levels"].size());
    EXPECT_GT(arrived["triangles"], built["triangles"].get<std::uint64_t>() / 2);
    EXPECT_LT(arrived["triangles"], built["triangles"]);
}

TEST_F(BpOctreeVerbs, LeavesFollowTheCriterionOfTheirSiblings) {
    ASSERT_EQ(octavo("shape knot --detail 96 -o knot.ply").exit_code, 0);
    std::set<std::uint64_t> leaves;
    for (const char* criterion : {"count", "sum", "mean --leaf-mean 8", "none"}) {
        const Ran ran = octavo("build knot.ply --depth 6 --quality fast --certify --json --coalesce " +
                               std::string(criterion));
        ASSERT_EQ(ran.exit_code, 0) << ran.err;
        leaves.insert(ran.json()["result"]["leaves"].get<std::uint64_t>());
    }
    EXPECT_EQ(leaves.size(), 4U);
    EXPECT_EQ(octavo("build knot.ply --coalesce most").exit_code, 2);
}

TEST_F(BpOctreeVerbs, PartsAreMoreThanNothingAndAtMostAll) {
    ASSERT_EQ(octavo("shape cube -o cube.off").exit_code, 0);
    for (const std::string option : {"--gain", "--planes k-medoids --part"}) {
        for (const std::string part : {"0", "-1", "1.5", "1e308", "nan", "x"}) {
            const Ran ran = octavo("build cube.off " + option + " " + part);
            EXPECT_EQ(ran.exit_code, 2) << option << ' ' << part;
            EXPECT_NE(ran.err.find("must be a part: more than 0 and at most 1, not " + part),
                      std::string::npos)
                << ran.err;
        }
        EXPECT_EQ(octavo("build cube.off " + option + " 1").exit_code, 0);
    }
}

TEST_F(BpOctreeVerbs, BuildIsTheSameForAnyNumberOfThreads) {
    ASSERT_EQ(octavo("shape knot --detail 96 -o knot.ply").exit_code, 0);
    ASSERT_EQ(octavo("build knot.ply -o one.bpo --threads 1").exit_code, 0);
    ASSERT_EQ(octavo("build knot.ply -o four.bpo --threads 4").exit_code, 0);
    EXPECT_EQ(read("one.bpo"), read("four.bpo"));
}

TEST_F(BpOctreeVerbs, ConvertWritesLevelsAsClosedShellsAndTheExactTriangles) {
    ASSERT_EQ(octavo("shape knot --detail 96 -o knot.ply").exit_code, 0);
    ASSERT_EQ(octavo("build knot.ply -o knot.bpo").exit_code, 0);
    const Ran level = octavo("convert knot.bpo level.off --level 2 --json");
    ASSERT_EQ(level.exit_code, 0) << level.err;
    const double volume = octavo("stats knot.bpo --json").json()["result"]["levels"][2]["volume"];
    EXPECT_NEAR(octavo("info level.off --json").json()["result"]["volume"].get<double>(), volume, 1e-6);
    const Ran open = octavo("convert knot.bpo open.off --level 2 --without-cell-faces --json");
    EXPECT_LT(open.json()["result"]["triangles"], level.json()["result"]["triangles"]);

    ASSERT_EQ(octavo("convert knot.bpo exact.off").exit_code, 0);
    const json exact = octavo("info exact.off --json").json()["result"];
    const json original = octavo("info knot.ply --json").json()["result"];
    EXPECT_EQ(exact["triangles"], original["triangles"]);
    EXPECT_NEAR(exact["volume"].get<double>(), original["volume"].get<double>(), 1e-6);
    EXPECT_EQ(octavo("convert knot.ply x.off --level 2").exit_code, 2);
}

TEST_F(BpOctreeVerbs, TheBeginningOfAFileIsEnoughForItsLevels) {
    ASSERT_EQ(octavo("shape knot --detail 96 -o knot.ply").exit_code, 0);
    const json built = octavo("build knot.ply -o knot.bpo --json").json()["result"];
    std::uint64_t bytes = 0;
    for (int level = 0; level <= 2; ++level) bytes += built["levels"][level]["bytes"].get<std::uint64_t>();
    write("begun.bpo", read("knot.bpo").substr(0, bytes + 1));
    const json stats = octavo("stats begun.bpo --json").json();
    EXPECT_EQ(stats["result"]["levels"], built["levels"]);
    EXPECT_EQ(stats["result"]["triangles"], built["triangles"]);
    EXPECT_EQ(stats["result"]["arrived"],
              (json{{"bytes", bytes + 1}, {"levels", 3}, {"leaves", 0}, {"triangles", 0}}));
    EXPECT_EQ(stats["warnings"].size(), 1U);
    EXPECT_EQ(octavo("stats begun.bpo --certify").exit_code, 3);
    EXPECT_EQ(octavo("convert begun.bpo level.off --level 2").exit_code, 0);
    write("far.csv", "0,0,9\n");
    const Ran bound = octavo("distance begun.bpo far.csv --level 2");
    EXPECT_EQ(bound.exit_code, 0) << bound.err;
    ASSERT_EQ(bound.out.substr(0, 9), "distance\n");
    const double at_least = std::stod(bound.out.substr(9)),
                 distance = octavo("distance knot.bpo far.csv --json").json()["result"]["min"];
    EXPECT_LE(at_least, distance);
    EXPECT_GT(at_least, 0.9 * distance);
    EXPECT_EQ(octavo("distance knot.ply far.csv --level 2").exit_code, 2);
    // The triangles are not there, and nothing pretends that they were.
    write("points.csv", "0,0,0\n");
    for (const char* arguments :
         {"contains begun.bpo points.csv", "distance begun.bpo points.csv", "convert begun.bpo exact.off"}) {
        const Ran ran = octavo(arguments);
        EXPECT_EQ(ran.exit_code, 3) << arguments;
        EXPECT_NE(ran.err.find("begun.bpo"), std::string::npos) << ran.err;
    }
}

TEST_F(BpOctreeVerbs, SolidsOfAVolumeBeyondDoublesAreRefused) {
    for (const auto& [size, code] : {std::pair{"1e103", 4}, {"1e-120", 0}, {"1e100", 0}}) {
        ASSERT_EQ(octavo(std::string("shape cube -o cube.off --size ") + size).exit_code, 0);
        const Ran ran = octavo("build cube.off -o cube.bpo --json");
        EXPECT_EQ(ran.exit_code, code) << size << ran.err;
        EXPECT_EQ(std::filesystem::exists(path("cube.bpo")), code == 0) << size;
        if (code == 0) {
            EXPECT_EQ(octavo("stats cube.bpo").exit_code, 0) << size;
        } else {
            EXPECT_NE(ran.json()["error"]["message"].get<std::string>().find("volume"), std::string::npos);
        }
        std::filesystem::remove(path("cube.bpo"));
    }
}

TEST_F(BpOctreeVerbs, ADamagedFileIsExitCode3WithTheByte) {
    ASSERT_EQ(octavo("shape cube -o cube.ply").exit_code, 0);
    ASSERT_EQ(octavo("build cube.ply -o cube.bpo").exit_code, 0);
    std::string bytes = read("cube.bpo");
    bytes.back() = static_cast<char>(bytes.back() ^ 1);
    write("cube.bpo", bytes);
    EXPECT_EQ(octavo("stats cube.bpo").exit_code, 0);  // the last chunk is damaged, and not read
    const Ran ran = octavo("stats cube.bpo --certify --json");
    EXPECT_EQ(ran.exit_code, 3);
    EXPECT_EQ(ran.json()["error"]["file"], "cube.bpo");
    EXPECT_EQ(octavo("build cube.ply -o cube.oct").exit_code, 2);
    EXPECT_FALSE(std::filesystem::exists(path("cube.oct")));
}

TEST_F(BpOctreeVerbs, AnOpenSurfaceIsEnvelopedAsASurface) {
    write("open.off", "OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n");
    const Ran ran = octavo("build open.off -o open.bpo --json");
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_EQ(ran.json()["result"]["closed"], false);
    EXPECT_NE(ran.json()["warnings"].dump().find("enveloped as a surface"), std::string::npos);
    write("points.csv", "0,0,0\n");
    EXPECT_EQ(octavo("contains open.bpo points.csv").exit_code, 3);
    EXPECT_EQ(octavo("distance open.bpo points.csv").exit_code, 3);
    EXPECT_EQ(octavo("distance open.bpo points.csv --unsigned").exit_code, 0);
}

TEST_F(BpOctreeVerbs, ContainsAndDistanceAnswerTheSameFromMeshAndBpOctree) {
    ASSERT_EQ(octavo("shape cube -o cube.stl").exit_code, 0);  // from −0.5 to 0.5
    ASSERT_EQ(octavo("build cube.stl -o cube.bpo").exit_code, 0);
    write("points.csv", "x,y,z\n0,0,0.25\n0.5,0,0\n0,0,2.5\n1.5,1.5,0\nnan,0,0\ninf,0,0\n");
    EXPECT_EQ(octavo("contains cube.bpo points.csv").out, octavo("contains cube.stl points.csv").out);
    const Ran mesh = octavo("distance cube.stl points.csv -o mesh.csv --json");
    ASSERT_EQ(mesh.exit_code, 0) << mesh.err;
    const json result = mesh.json()["result"];
    EXPECT_EQ(result["min"], -0.25);
    EXPECT_EQ(result["max"], 2.0);
    EXPECT_NEAR(result["mean"].get<double>(), (-0.25 + 0 + 2 + std::sqrt(2.0)) / 4, 1e-15);
    ASSERT_EQ(octavo("distance cube.bpo points.csv -o tree.csv").exit_code, 0);
    // Triangles are numbered anew in a .bpo; distances and points are the same.
    const auto columns = [](std::string text) {
        std::string kept;
        std::istringstream lines(text);
        for (std::string line; std::getline(lines, line);) kept += line.substr(0, line.rfind(',')) + "\n";
        return kept;
    };
    EXPECT_EQ(columns(read("mesh.csv")), columns(read("tree.csv")));
    EXPECT_EQ(read("mesh.csv").substr(0, 23), "distance,x,y,z,triangle");
    const json absolute = octavo("distance cube.stl points.csv --unsigned --json").json()["result"];
    EXPECT_EQ(absolute["min"], 0.0);
}

}  // namespace
}  // namespace octavo::tests
