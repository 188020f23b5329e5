// SPDX-License-Identifier: Apache-2.0
#include <map>
#include <vector>

#include "cli/program.hpp"

// The verb `render`, whatever it reads and writes.

namespace octavo::tests {
namespace {

using nlohmann::json;

constexpr char cube_with_a_hole[] = R"(difference() {
  cube(size = [4, 4, 4], center = true);
  cylinder($fn = 24, h = 6, r1 = 1, r2 = 1, center = true);
}
)";

constexpr char open_square[] = "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";

class Render : public ProgramTest {
  protected:
    void SetUp() override {
        ProgramTest::SetUp();
        write("part.csg", cube_with_a_hole);
        ASSERT_EQ(octavo("convert part.csg part.ply").exit_code, 0);
        ASSERT_EQ(octavo("bsp part.ply -o part.bso").exit_code, 0);
        ASSERT_EQ(octavo("build part.ply -o part.bpo").exit_code, 0);
        ASSERT_EQ(octavo("octree part.ply --depth 4 -o part.oct").exit_code, 0);
    }
};

TEST_F(Render, DrawsEveryKindOfModelInEveryFormat) {
    const std::map<std::string, std::string> beginnings{{"png", "\x89PNG"}, {"svg", "<svg"}, {"pdf", "%PDF"}};
    for (const char* model : {"part.csg", "part.ply", "part.bso", "part.bpo", "part.oct"})
        for (const auto& [format, beginning] : beginnings) {
            const std::string output = "out." + format;
            const Ran ran = octavo(std::string("render ") + model + " -o " + output +
                                   " --size 200x150 --cut x:0.5,y:0:0.5 --json");
            ASSERT_EQ(ran.exit_code, 0) << model << ": " << ran.err;
            EXPECT_EQ(ran.json()["result"]["method"], format == "png" ? "depth" : "order");
            EXPECT_EQ(read(output).substr(0, 4), beginning) << model;
        }
}

TEST_F(Render, DrawsTheSameForAllModelsOfASolid) {
    const auto areas = [&](const std::string& arguments) {
        const Ran ran = octavo("render " + arguments + " -o out.svg --hidden-lines --json");
        EXPECT_EQ(ran.exit_code, 0) << ran.err;
        return ran.json()["result"];
    };
    const json expected = areas("part.ply");
    EXPECT_GT(expected["areas"], 3);
    for (const char* model : {"part.csg", "part.bso", "part.bpo"}) {
        const json result = areas(model);
        EXPECT_EQ(result["areas"], expected["areas"]) << model;
        EXPECT_EQ(result["strokes"], expected["strokes"]) << model;
    }
}

TEST_F(Render, ColoursByOperandAndByNode) {
    ASSERT_EQ(octavo("render part.csg --paint source -o source.svg").exit_code, 0);
    ASSERT_EQ(octavo("render part.csg --paint solid -o solid.svg").exit_code, 0);
    EXPECT_NE(read("source.svg"), read("solid.svg"));
    const Ran node = octavo("render part.bso --paint node -o node.png --size 80x60 --json");
    ASSERT_EQ(node.exit_code, 0) << node.err;
    EXPECT_EQ(node.json()["result"]["method"], "order");
    EXPECT_EQ(octavo("render part.ply --paint node -o a.svg").exit_code, 2);
    EXPECT_EQ(octavo("render part.ply --paint source -o a.svg").exit_code, 2);
    EXPECT_EQ(octavo("render part.oct --paint solid -o a.svg").exit_code, 2);
}

TEST_F(Render, DashesHiddenLinesOnlyWhenAsked) {
    ASSERT_EQ(octavo("render part.ply -o a.svg").exit_code, 0);
    EXPECT_EQ(read("a.svg").find("stroke-dasharray"), std::string::npos);
    ASSERT_EQ(octavo("render part.ply -o a.svg --hidden-lines").exit_code, 0);
    EXPECT_NE(read("a.svg").find("stroke-dasharray"), std::string::npos);
    ASSERT_EQ(octavo("render part.ply -o a.png --hidden-lines --size 80x60").exit_code, 0);
    EXPECT_EQ(octavo("render part.ply -o a.png --hidden-lines --method depth").exit_code, 2);
    EXPECT_EQ(octavo("render part.ply -o a.svg --method depth").exit_code, 2);
}

TEST_F(Render, WritesTheSameBytesForAnyNumberOfThreads) {
    for (const char* format : {"svg", "pdf", "png"}) {
        const std::string arguments =
            std::string("render part.bso --method order --size 300x200 --cut z -o ");
        ASSERT_EQ(octavo(arguments + "one." + format + " --threads 1").exit_code, 0);
        ASSERT_EQ(octavo(arguments + "two." + format + " --threads 2").exit_code, 0);
        EXPECT_EQ(read(std::string("one.") + format), read(std::string("two.") + format)) << format;
    }
}

TEST_F(Render, DrawsContoursByDepthOnlyWhenAsked) {
    const auto lines = [&](const std::string& options) {
        return octavo("render part.ply --size 80x60 --json " + options).json()["result"]["lines"].get<int>();
    };
    const int sharp = lines("--sharp 50 -o a.png");
    EXPECT_GT(lines("--sharp 50 -o a.svg"), sharp);
    EXPECT_GT(lines("--edges contours -o a.png"), 0);
    EXPECT_EQ(lines("--edges none -o a.svg"), 0);
}

TEST_F(Render, WritesToStandardOutput) {
    EXPECT_EQ(octavo("render part.ply -o - --to svg").out.substr(0, 4), "<svg");
    EXPECT_EQ(octavo("render part.ply -o - --to bmp").exit_code, 2);
}

TEST_F(Render, DrawsOpenSurfacesAndSaysWhyItCannotCutThem) {
    write("open.off", open_square);
    EXPECT_EQ(octavo("render open.off -o a.svg --elevation -30").exit_code, 0);
    EXPECT_EQ(octavo("render open.off -o a.png --cut x --size 80x60").exit_code, 0);
    const Ran cut = octavo("render open.off -o cut.svg --cut x");
    EXPECT_EQ(cut.exit_code, 3);
    EXPECT_NE(cut.err.find("--method depth"), std::string::npos) << cut.err;
    EXPECT_NE(cut.err.find("open.off"), std::string::npos) << cut.err;
    EXPECT_EQ(read("cut.svg"), "");
    EXPECT_EQ(octavo("render open.off -o a.png --cut x,y").exit_code, 3);
}

TEST_F(Render, RefusesCutsThatAreNone) {
    for (const char* cut :
         {"w", "x:2", "x:0.5:0.5", "x:0.6:0.4", "x,x", "x,", ",x", "x:", "xy", "x:0:1:0", "''"})
        EXPECT_EQ(octavo(std::string("render part.ply -o a.svg --cut ") + cut).exit_code, 2) << cut;
    // All of it cut away leaves nothing to look at.
    EXPECT_EQ(octavo("render part.ply -o a.svg --cut x:0:1").exit_code, 3);
    EXPECT_EQ(octavo("render part.bso -o a.svg --cut x:0:1").exit_code, 3);
}

}  // namespace
}  // namespace octavo::tests
