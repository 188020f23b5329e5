// SPDX-License-Identifier: Apache-2.0
#include <map>

#include "cli/program.hpp"

// Where options may stand, what they are called in every verb, and that none is taken without having a use.

namespace octavo::tests {
namespace {

using Options = ProgramTest;
using nlohmann::json;

TEST_F(Options, CommonOptionsStandBeforeTheVerbOrBehindIt) {
    ASSERT_EQ(octavo("shape cube -o cube.off").exit_code, 0);
    const json behind = octavo("info cube.off --json --threads 2").json()["result"];
    EXPECT_EQ(octavo("--json --threads 2 info cube.off").json()["result"], behind);
    EXPECT_EQ(octavo("--threads 2 info cube.off --json").json()["result"], behind);
    EXPECT_EQ(octavo("-q info cube.off").out, "");
    EXPECT_EQ(octavo("--threads 5000 info cube.off").exit_code, 2);
}

TEST_F(Options, AWordThatIsNoneIsSaidWithWhatWasMeant) {
    const std::map<std::string, std::string> sentences{
        {"", "a verb is missing\n"},
        {"--json", "a verb is missing\n"},
        {"--quite info a.off", "info has no option --quite; did you mean --quiet?"},
        {"--thread 2", "there is no option --thread; did you mean --threads?"},
        {"--depth 3 octree a.off", "--depth belongs to octree and stands behind it: octavo octree --depth"},
        {"--threads 2 inof a.off", "there is no verb inof; did you mean info?"},
        {"--threads 5000 info a.off", "not 5000"},
        // A letter is near to every other, so that it suggests nothing.
        {"info a.off -o b.off", "info has no option -o\n"},
        {"stats a.oct -p 3", "stats has no option -p\n"},
        {"help frobnicate", "there is no verb frobnicate\n"},
        {"help octre", "did you mean octree?"}};
    for (const auto& [arguments, sentence] : sentences) {
        const Ran ran = octavo(arguments);
        EXPECT_EQ(ran.exit_code, 2) << arguments;
        EXPECT_NE(ran.err.find(sentence), std::string::npos) << arguments << ": " << ran.err;
    }
}

TEST_F(Options, HelpIsAVerbToo) {
    EXPECT_EQ(octavo("help octree").out, octavo("octree --help").out);
    EXPECT_EQ(octavo("help").out, octavo("--help").out);
    EXPECT_EQ(octavo("help octree --json").json()["result"]["help"], octavo("octree --help").out);
}

TEST_F(Options, TheFormatOfTheModelHasOneNameInEveryVerb) {
    ASSERT_EQ(octavo("shape cube -o cube.off").exit_code, 0);
    ASSERT_EQ(octavo("octree cube.off --depth 2 -o cube.oct").exit_code, 0);
    ASSERT_EQ(shell("cp cube.off cube.data; cp cube.oct cells.data").exit_code, 0);
    write("points.csv", "0,0,0\n");
    for (const std::string arguments :
         {"info cube.data", "check cube.data", "octree cube.data", "build cube.data", "bsp cube.data",
          "render cube.data --size 20x20 -o a.png", "convert cube.data a.stl", "repair cube.data -o a.stl",
          "contains cube.data points.csv", "distance cube.data points.csv"}) {
        EXPECT_EQ(octavo(arguments + " --from off").exit_code, 0) << arguments;
        EXPECT_EQ(octavo(arguments + " --format off").exit_code, 0)
            << arguments << ": the name it had before";
        const std::string help = octavo(arguments.substr(0, arguments.find(' ')) + " --help").out;
        EXPECT_NE(help.find("--from stl|obj|ply|off|3mf|poly|smesh|csg|oct|bpo|bso"), std::string::npos)
            << help;
        EXPECT_EQ(help.find("--format"), std::string::npos) << help;
    }
    EXPECT_EQ(octavo("stats cells.data --from oct").exit_code, 0);
    EXPECT_EQ(octavo("stats cells.data --from stl").exit_code, 2);
    EXPECT_EQ(octavo("octree cube.off -p 0.1 --json").json()["result"],
              octavo("octree cube.off --precision 0.1 --json").json()["result"]);
}

TEST_F(Options, WhatTheModelOrTheFormatHasNoUseForIsAWrongCommandLine) {
    ASSERT_EQ(octavo("shape cube -o cube.off").exit_code, 0);
    ASSERT_EQ(octavo("octree cube.off --depth 2 -o cube.oct").exit_code, 0);
    write("cube.csg", "cube(size = [1, 1, 1]);\n");
    write("points.csv", "0,0,0\n");
    const std::map<std::string, std::string> options{
        {"octree cube.off --method classic", "--method is for CSG trees"},
        {"octree cube.off --faceted", "--faceted is for CSG trees"},
        {"octree cube.off --skip-unsupported", "--skip-unsupported is for CSG trees"},
        {"octree cube.csg --open winding", "--open is for meshes"},
        {"convert cube.off a.stl --unit inch", "stl states no unit, and cube.off has none to convert from"},
        {"convert - a.stl --unit inch --from obj", "stl states no unit"},
        {"convert cube.oct a.off --unit inch", "off states no unit"},
        {"convert cube.off a.obj --encoding ascii", "obj does not"},
        {"convert cube.oct a.vtu --encoding ascii", "vtu does not"},
        {"convert cube.off a.obj --level 2", "--level is for BP-octrees"},
        {"distance cube.off points.csv --level 2", "--level is for BP-octrees"},
        {"convert cube.off cube.off", "cube.off: the output would overwrite the input"},
        {"convert cube.off", "the file to write is missing"},
        {"convert cube.off a.stl -o b.stl", "named twice"}};
    for (const auto& [arguments, sentence] : options) {
        const Ran ran = octavo(arguments);
        EXPECT_EQ(ran.exit_code, 2) << arguments;
        EXPECT_NE(ran.err.find(sentence), std::string::npos) << arguments << ": " << ran.err;
    }
    EXPECT_FALSE(std::filesystem::exists(path("a.stl")));
}

TEST_F(Options, AFileThatCannotBeOpenedIsNotJudgedByItsName) {
    ASSERT_EQ(octavo("shape cube -o cube.off").exit_code, 0);
    for (const char* arguments : {"check nowhere.csg", "repair nowhere.oct -o a.stl", "stats nowhere.off",
                                  "union cube.off nowhere.oct -o a.stl"}) {
        const Ran ran = octavo(arguments);
        EXPECT_EQ(ran.exit_code, 3) << arguments;
        EXPECT_NE(ran.err.find("cannot be opened"), std::string::npos) << ran.err;
    }
}

TEST_F(Options, ShellsCompleteTheWordsOfArgumentsAndFormats) {
    const auto completed = [&](const std::string& words, int at) {
        return shell("source <($octavo completion bash); COMP_WORDS=(" + words +
                     "); COMP_CWORD=" + std::to_string(at) + "; _octavo; echo ${COMPREPLY[*]}")
            .out;
    };
    EXPECT_EQ(completed("octavo shape cu", 2), "cube\n");
    EXPECT_EQ(completed("octavo completion f", 2), "fish\n");
    EXPECT_EQ(completed("octavo help dist", 2), "distance\n");
    EXPECT_EQ(completed("octavo convert a.stl b --to p", 5), "ply poly\n");
    EXPECT_EQ(completed("octavo convert a --from o", 4), "obj off oct\n");
    EXPECT_EQ(completed("octavo --thr", 1), "--threads\n");
    EXPECT_NE(octavo("completion zsh").out.find("'1:NAME:(cone cube "), std::string::npos);
    EXPECT_NE(octavo("completion fish").out.find("__fish_seen_subcommand_from shape' -f -a 'cone cube "),
              std::string::npos);
    EXPECT_EQ(octavo("completion bash").out.find("..."), std::string::npos);
}

TEST_F(Options, TheManualTellsCommonOptionsOnceAndWhatIsRequired) {
    const std::string man = octavo("man").out;
    std::size_t count = 0;
    for (std::size_t at = 0; (at = man.find("Print one JSON object", at)) != std::string::npos; ++at) ++count;
    EXPECT_EQ(count, 1U);
    EXPECT_NE(man.find(".SH COMMON OPTIONS"), std::string::npos);
    const std::size_t repair = man.find(".B octavo repair");
    EXPECT_NE(man.substr(repair, 120).find("\\-o"), std::string::npos) << man.substr(repair, 120);
    EXPECT_NE(man.find("repair ends with 0"), std::string::npos) << man.substr(man.find(".SH NOTES"));
}

TEST_F(Options, InputsAreInTheOrderOfTheCommandLine) {
    ASSERT_EQ(octavo("shape cube -o cube.off").exit_code, 0);
    ASSERT_EQ(octavo("build cube.off -o cube.bpo").exit_code, 0);
    ASSERT_EQ(octavo("octree cube.off --depth 2 -o cube.oct").exit_code, 0);
    write("points.csv", "0,0,0\n");
    for (const std::string arguments :
         {"contains cube.off points.csv", "contains cube.bpo points.csv", "contains cube.oct points.csv",
          "distance cube.off points.csv", "distance cube.bpo points.csv --level 0",
          "contains no.off points.csv", "contains cube.off no.csv", "distance cube.off no.csv"}) {
        std::istringstream words(arguments);
        std::string verb, model, points;
        words >> verb >> model >> points;
        EXPECT_EQ(octavo(arguments + " --json").json()["inputs"], (json{model, points})) << arguments;
    }
}

TEST_F(Options, RoundingHasOneNameAndIsNoWarning) {
    ASSERT_EQ(octavo("shape sphere --detail 3 -o ball.ply").exit_code, 0);
    write("points.csv", "0,0,0\n");
    for (const std::string arguments :
         {"check ball.ply", "repair ball.ply -o a.ply", "octree ball.ply", "build ball.ply",
          "contains ball.ply points.csv", "distance ball.ply points.csv", "convert ball.ply a.stl",
          "union ball.ply -o a.ply"}) {
        const json object = octavo(arguments + " --json").json();
        EXPECT_GT(object["result"]["largest_displacement"], 0) << arguments;
        EXPECT_EQ(object["result"].count("snap_displacement"), 0U) << arguments;
        EXPECT_EQ(object["warnings"].dump().find("rounded to the lattice"), std::string::npos) << arguments;
    }
    EXPECT_NE(octavo("contains ball.ply points.csv -o sides.csv").out.find("rounding   moved vertices"),
              std::string::npos);
}

}  // namespace
}  // namespace octavo::tests
