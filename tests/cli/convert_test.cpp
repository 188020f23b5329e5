// SPDX-License-Identifier: Apache-2.0
#include "cli/program.hpp"

// What `convert` writes, and what it tells of it: units, faces, and what is not kept.

namespace octavo::tests {
namespace {

using Convert = ProgramTest;
using nlohmann::json;

class Units : public ProgramTest {
  protected:
    void SetUp() override {
        ProgramTest::SetUp();
        ASSERT_EQ(octavo("shape cube --size 10 -o cube.off").exit_code, 0);
        ASSERT_EQ(octavo("convert cube.off inch.3mf --unit inch").exit_code, 0);
    }
    json facts(const std::string& file) const { return octavo("info " + file + " --json").json()["result"]; }
};

TEST_F(Units, OfAFileThatStatesNoneTheNumbersAreTakenToBeInTheUnit) {
    EXPECT_EQ(facts("inch.3mf")["unit"], "inch");
    EXPECT_EQ(facts("inch.3mf")["volume"], 1000.0);
}

TEST_F(Units, AFileThatStatesItsUnitKeepsItsSizeInAnother) {
    const Ran ran = octavo("convert inch.3mf meter.3mf --unit meter --json");
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_DOUBLE_EQ(ran.json()["result"]["scale"], 0.0254);
    EXPECT_EQ(facts("meter.3mf")["unit"], "meter");
    EXPECT_DOUBLE_EQ(facts("meter.3mf")["bounds"][1][0], 5 * 0.0254);
    EXPECT_NE(
        octavo("convert inch.3mf meter.3mf --unit meter").out.find("scaled by 0.0254: from inch to meter"),
        std::string::npos);
    // The same unit changes nothing, and leaving it out keeps it.
    for (const char* option : {" --unit inch", ""}) {
        const json result = octavo(std::string("convert inch.3mf same.3mf --json") + option).json()["result"];
        EXPECT_EQ(result["scale"], 1.0);
        EXPECT_EQ(read("same.3mf"), read("inch.3mf"));
    }
}

TEST_F(Units, MillimetresGoIntoFormatsThatStateNoUnit) {
    const Ran ran = octavo("convert inch.3mf mm.stl --unit millimeter --json");
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_EQ(ran.json()["warnings"], json::array());
    EXPECT_EQ(facts("mm.stl")["bounds"][1][0], 127.0);
    EXPECT_NE(octavo("convert inch.3mf inch.stl").err.find("the unit is not kept: inch"), std::string::npos);
    // Through a pipe the format is known when it is read.
    EXPECT_EQ(shell("cat inch.3mf | $octavo convert - mm.stl --unit millimeter").exit_code, 0);
    EXPECT_EQ(shell("cat cube.off | $octavo convert - mm.stl --unit millimeter").exit_code, 2);
}

TEST_F(Convert, TheOutputMayBeNamedByAnOption) {
    ASSERT_EQ(octavo("shape cube -o cube.off").exit_code, 0);
    ASSERT_EQ(octavo("convert cube.off a.obj").exit_code, 0);
    ASSERT_EQ(octavo("convert cube.off -o b.obj").exit_code, 0);
    EXPECT_EQ(read("a.obj"), read("b.obj"));
    EXPECT_EQ(octavo("convert cube.off -o - --to obj").out, read("a.obj"));
}

TEST_F(Convert, FacesOfTetGenAreToldAsTheyAreInTheFile) {
    // A square of four triangles round a vertex that is a corner of no face, as the bottom of a pyramid.
    write("pyramid.off",
          "OFF\n6 8 0\n0 0 0\n2 0 0\n2 2 0\n0 2 0\n1 1 0\n1 1 1\n"
          "3 1 0 4\n3 2 1 4\n3 3 2 4\n3 0 3 4\n3 0 1 5\n3 1 2 5\n3 2 3 5\n3 3 0 5\n");
    const Ran ran = octavo("convert pyramid.off pyramid.poly --json");
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_EQ(
        ran.json()["warnings"],
        json::array({"not kept: 1 vertex that is a corner of no face; the file has 5 vertices and 5 faces"}));
    EXPECT_EQ(octavo("info pyramid.poly --json").json()["result"]["vertices"], 5);
    EXPECT_EQ(octavo("convert pyramid.off pyramid.obj --json").json()["warnings"], json::array());
    ASSERT_EQ(octavo("shape cube -o cube.off").exit_code, 0);
    EXPECT_EQ(octavo("convert cube.off cube.poly --json").json()["warnings"], json::array());
}

}  // namespace
}  // namespace octavo::tests
