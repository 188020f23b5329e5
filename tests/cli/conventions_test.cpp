// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "cli/program.hpp"

// What holds for every verb: streams, exit codes, --json, and that nothing is lost when something goes wrong.

namespace octavo::tests {
namespace {

using Conventions = ProgramTest;

TEST_F(Conventions, HelpAndVersionSucceed) {
    const Ran help = octavo("--help");
    EXPECT_EQ(help.exit_code, 0);
    EXPECT_NE(help.out.find("Exit codes"), std::string::npos);
    const Ran version = octavo("--version");
    EXPECT_EQ(version.exit_code, 0);
    EXPECT_EQ(version.out.rfind("octavo ", 0), 0U);
}

TEST_F(Conventions, AWrongCommandLineIsExitCode2WithAHintAndEmptyStdout) {
    for (const char* arguments : {"",
                                  "frobnicate",
                                  "info",
                                  "info a.off --no-such-option",
                                  "octree a.off --depth 22",
                                  "octree a.off --depth x",
                                  "octree a.off --precision nan",
                                  "octree a.off --precision 0",
                                  "shape dodo -o a.stl",
                                  "render a.off -o a.png --size 9",
                                  "render a.off -o a.png --cut w",
                                  "render a.off -o a.png --size 0x0",
                                  "render a.off -o a.png --perspective 180",
                                  "render a.off -o a.png --elevation 91",
                                  "render a.off -o a.bmp",
                                  "convert a.off a.xyz",
                                  "convert a.off a",
                                  "convert a.off -",
                                  "convert a.off a.oct",
                                  "octree a.off -o a.stl",
                                  "contains a.off p.csv -o a.stl",
                                  "contains a.off p.csv --to xls",
                                  "contains - -",
                                  "union - - -o a.stl",
                                  "mill - --tool - --path p.csv -o a.stl",
                                  "mill a.off --tool b.off --path p.csv -o a.xyz",
                                  "bsp a.off -o a.xyz",
                                  "repair a.off -o a.doc",
                                  "union a.off b.off -o a.png",
                                  "shape sphere --detail 99999 -o a.stl",
                                  "shape cube --detail 2 -o a.stl",
                                  "shape torus --detail -1 -o a.stl",
                                  "info a.off --format doc",
                                  "info a.off --threads 5000",
                                  "convert a.off a.3mf --unit parsec",
                                  "union a.off b.off",
                                  "check a.off b.off"}) {
        const Ran ran = octavo(arguments);
        EXPECT_EQ(ran.exit_code, 2) << arguments;
        EXPECT_EQ(ran.out, "") << arguments;
        EXPECT_NE(ran.err.find("Try: octavo"), std::string::npos) << arguments;
    }
}

TEST_F(Conventions, AnUnknownVerbIsNamed) {
    EXPECT_NE(octavo("frobnicate a.off").err.find("there is no verb frobnicate"), std::string::npos);
}

TEST_F(Conventions, WhatIsWrongWithAnOptionIsSaidWithItsNameAndItsLimits) {
    const std::map<std::string, std::vector<std::string>> words{
        {"octree a.off --depth 22", {"--depth", "0 to 21", "not 22"}},
        {"render a.off -o a.png --size 0x0", {"--size", "1 to 16384", "not 0x0"}},
        {"render a.off -o a.png --perspective 180", {"--perspective", "0 to 120", "not 180"}},
        {"shape torus --detail 99999 -o a.stl", {"--detail", "3 to 5000", "99999"}},
        {"shape cube --detail 2 -o a.stl", {"--detail", "cube"}},
        {"octree a.off --open maybe", {"--open", "reject or winding", "not maybe"}},
        {"convert a.off a.xyz", {"a.xyz", "stl, obj, ply, off, 3mf, poly or smesh"}},
        {"contains - -", {"stdin"}},
        {"info a.off --jsno", {"--jsno", "did you mean --json?"}},
        {"shape spheer -o a.stl", {"spheer", "did you mean sphere?"}},
        {"inof a.off", {"inof", "did you mean info?"}},
        {"octree a.off --depth 5 --depth 6", {"--depth is given 2 times, and takes one value"}},
        {"check a.off b.off", {"check takes no further argument b.off"}},
        {"octree a.off 2 --dpth 3", {"octree has no option --dpth", "did you mean --depth?"}},
        {"octree a.off --depth", {"--depth needs a value: N"}}};
    for (const auto& [arguments, expected] : words)
        for (const std::string& word : expected)
            EXPECT_NE(octavo(arguments).err.find(word), std::string::npos) << arguments << ": " << word;
}

TEST_F(Conventions, AWrongCommandLineIsAlsoTheJsonObject) {
    for (const char* arguments : {"info --json", "frobnicate --json", "octree a.off --depth 22 --json",
                                  "shape cube --detail 7 -o a.stl --json", "info a.off --bogus --json"}) {
        const Ran ran = octavo(arguments);
        EXPECT_EQ(ran.exit_code, 2) << arguments;
        const nlohmann::json json = ran.json();
        ASSERT_TRUE(json.is_object()) << arguments << ran.out;
        EXPECT_EQ(json["error"]["code"], "usage") << arguments;
        EXPECT_FALSE(json["error"]["message"].get<std::string>().empty());
    }
    EXPECT_EQ(octavo("info --json").json()["command"], "info");
}

TEST_F(Conventions, DataAndTheJsonObjectDoNotShareStdout) {
    ASSERT_EQ(octavo("shape cube -o cube.off").exit_code, 0);
    write("points.csv", "0,0,0\n");
    for (const char* arguments :
         {"convert cube.off - --to obj --json", "octree cube.off -o - --json",
          "contains cube.off points.csv -o - --json", "shape cube -o - --to stl --json",
          "mill cube.off --tool cube.off --path points.csv -o - --to stl --json",
          "bsp cube.off -o - --json"}) {
        const Ran ran = octavo(arguments);
        EXPECT_EQ(ran.exit_code, 2) << arguments;
        ASSERT_TRUE(ran.json().is_object()) << arguments;
        EXPECT_NE(ran.json()["error"]["message"].get<std::string>().find("name a file"), std::string::npos);
    }
}

TEST_F(Conventions, HelpTellsDefaultsAndChoicesAndFormats) {
    const std::string octree = octavo("octree --help").out;
    for (const char* words : {"default 8", "reject|winding", "top-down|classic", "Usage: octavo octree FILE"})
        EXPECT_NE(octree.find(words), std::string::npos) << words << "\n" << octree;
    EXPECT_EQ(octree.find("INT in"), std::string::npos);
    EXPECT_NE(octavo("render --help").out.find("default 1200x900"), std::string::npos);
    EXPECT_NE(octavo("convert --help").out.find("stl, obj, ply, off, 3mf, poly or smesh"), std::string::npos);
    for (const char* format : {"stl", "obj", "ply", "off", "3mf", "csg", "oct", "bpo", "bso", "vtu", "htg",
                               "npy", "png", "svg", "pdf"})
        for (const char* text : {"--help", "man"})
            EXPECT_NE(octavo(text).out.find(format), std::string::npos) << format << " in " << text;
    for (const char* format : {".csg", ".oct", ".bpo", ".bso"})
        EXPECT_NE(octavo("info --help").out.find(format), std::string::npos) << format;
    EXPECT_EQ(octree.find("\n\n\n"), std::string::npos) << octree;
    EXPECT_NE(octree.find("\n\nCommon options:"), std::string::npos) << octree;
}

TEST_F(Conventions, WhatHelpSaysOfTheNumberOfOperandsIsTrue) {
    ASSERT_EQ(octavo("shape cube -o a.off").exit_code, 0);
    for (const std::string verb : {"union", "intersection", "difference", "xor"}) {
        EXPECT_NE(octavo(verb + " --help").out.find("one or more"), std::string::npos) << verb;
        EXPECT_EQ(octavo(verb + " a.off -o b.off").exit_code, 0) << verb;
        EXPECT_EQ(octavo(verb + " -o b.off").exit_code, 2) << verb;
    }
}

TEST_F(Conventions, ABadFileIsExitCode3WithTheFileAndTheLine) {
    write("bad.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 one 0\n3 0 1 2\n");
    const Ran ran = octavo("info bad.off");
    EXPECT_EQ(ran.exit_code, 3);
    EXPECT_EQ(ran.out, "");
    EXPECT_NE(ran.err.find("bad.off:5"), std::string::npos) << ran.err;
}

TEST_F(Conventions, AMissingFileIsExitCode3) {
    const Ran ran = octavo("info nowhere.stl");
    EXPECT_EQ(ran.exit_code, 3);
    EXPECT_NE(ran.err.find("nowhere.stl"), std::string::npos);
}

TEST_F(Conventions, JsonIsOneObjectWithTheCommonKeysAlsoWhenItFails) {
    const Ran ran = octavo("shape cube -o cube.stl --json");
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    const nlohmann::json json = ran.json();
    for (const char* key : {"octavo", "command", "result", "timings", "warnings"})
        EXPECT_TRUE(json.contains(key)) << key;
    EXPECT_EQ(json["command"], "shape");
    EXPECT_TRUE(json["warnings"].is_array());

    const Ran failed = octavo("info nowhere.stl --json");
    EXPECT_EQ(failed.exit_code, 3);
    const nlohmann::json error = failed.json();
    ASSERT_TRUE(error.is_object()) << failed.out;
    EXPECT_EQ(error["error"]["file"], "nowhere.stl");
    EXPECT_FALSE(error.contains("result"));
}

TEST_F(Conventions, WhatStdoutDidNotTakeIsToldHoweverLongItIs) {
    ASSERT_EQ(octavo("shape cube -o cube.off").exit_code, 0);
    for (const char* arguments : {"check cube.off --json", "man", "completion bash", "--help", "check --help",
                                  "--version", "shape knot -o - --to ply"}) {
        const Ran ran = shell(std::string("$octavo ") + arguments + " > /dev/full");
        EXPECT_EQ(ran.exit_code, 3) << arguments;
        EXPECT_NE(ran.err, "") << arguments;
    }
}

TEST_F(Conventions, WhatStderrDoesNotTakeChangesNothing) {
    ASSERT_EQ(octavo("shape cube -o cube.off").exit_code, 0);
    write("points.xyz", "0 0 0\nnan 0 0\n");
    for (const char* redirection : {"2>&-", "2>/dev/full"}) {
        EXPECT_EQ(shell(std::string("$octavo info nowhere.stl ") + redirection).exit_code, 3) << redirection;
        EXPECT_EQ(shell(std::string("$octavo bogus ") + redirection).exit_code, 2) << redirection;
        const Ran warned =
            shell(std::string("$octavo contains cube.off points.xyz --json --progress plain ") + redirection);
        EXPECT_TRUE(warned.json().is_object()) << redirection << warned.out;
    }
}

TEST_F(Conventions, AMessageNeverGoesIntoAFileThatIsOpenedInStderrsPlace) {
    ASSERT_EQ(octavo("shape cube -o cube.off").exit_code, 0);
    ASSERT_EQ(octavo("convert cube.off quiet.obj").exit_code, 0);
    ASSERT_EQ(shell("$octavo convert cube.off closed.obj --progress plain <&- >&- 2>&-").exit_code, 3)
        << "its summary had no place";
    EXPECT_EQ(read("closed.obj"), read("quiet.obj"));
}

TEST_F(Conventions, MeshesGoThroughPipes) {
    const Ran ran =
        shell("$octavo shape cube -o cube.off -q && cat cube.off | $octavo convert - - --from off --to obj");
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_EQ(ran.out.find("octavo"), std::string::npos) << "only the file itself may go to stdout";
    EXPECT_NE(ran.out.find("\nf "), std::string::npos);
}

TEST_F(Conventions, AnInputIsNeverOverwritten) {
    ASSERT_EQ(octavo("shape cube -o cube.off").exit_code, 0);
    const std::string before = read("cube.off");
    EXPECT_EQ(octavo("convert cube.off ./cube.off").exit_code, 2);
    EXPECT_EQ(read("cube.off"), before);
}

TEST_F(Conventions, NeitherIsAFileThatAnInputRefersToNorAnotherOutput) {
    ASSERT_EQ(octavo("shape cube -o cube.off").exit_code, 0);
    write("part.csg", "import(file = \"cube.off\");");
    write("part.poly", "0 3 0 0\n4 0\n1 0\n3 0 2 1\n1 0\n3 0 1 3\n1 0\n3 1 2 3\n1 0\n3 2 0 3\n0\n");
    write("part.node", "4 3 0 0\n0 0 0 0\n1 6 0 0\n2 0 6 0\n3 0 0 6\n");
    write("both.csg", "import(file = \"part.poly\");");
    const std::map<std::string, std::string> before{{"cube.off", read("cube.off")},
                                                    {"part.node", read("part.node")}};
    ASSERT_EQ(octavo("info part.poly").exit_code, 0);
    for (const char* arguments :
         {"eval part.csg -o cube.off", "convert part.csg cube.off", "octree part.csg -o cube.off --to oct",
          "hexmesh part.csg -o cube.off --to octree", "union part.csg part.csg -o cube.off",
          "convert part.poly part.node --to off", "convert both.csg part.node --to off",
          "hexmesh cube.off --level 2 --picture a.png -o ./a.png --to vtu"}) {
        const Ran ran = octavo(arguments);
        EXPECT_EQ(ran.exit_code, 2) << arguments << ran.err;
        EXPECT_NE(ran.err.find("would overwrite"), std::string::npos) << ran.err;
        for (const auto& [name, content] : before) EXPECT_EQ(read(name), content) << arguments;
        EXPECT_FALSE(std::filesystem::exists(path("a.png"))) << arguments;
    }
}

TEST_F(Conventions, OutputsGoWhereLinksLeadAndMayHaveTheLongestNames) {
    ASSERT_EQ(octavo("shape cube -o cube.off").exit_code, 0);
    std::filesystem::create_directory(path("elsewhere"));
    std::filesystem::create_symlink("elsewhere/new.off", path("link.off"));
    EXPECT_EQ(octavo("convert cube.off link.off").exit_code, 0);
    EXPECT_TRUE(std::filesystem::is_symlink(path("link.off")));
    EXPECT_EQ(read("elsewhere/new.off"), read("cube.off"));
    std::filesystem::create_symlink("round.off", path("round.off"));
    EXPECT_EQ(octavo("convert cube.off round.off").exit_code, 3);
    EXPECT_TRUE(std::filesystem::is_symlink(path("round.off")));
    // Of two bytes a letter, and of one.
    std::string umlauts = "a";
    for (int i = 0; i < 125; ++i) umlauts += "ä";
    for (const std::string& name : {umlauts + ".off", std::string(251, 'a') + ".off"}) {
        const Ran ran = octavo("convert cube.off " + name);
        EXPECT_EQ(ran.exit_code, 0) << ran.err;
        EXPECT_EQ(read(name), read("cube.off"));
    }
}

TEST_F(Conventions, NamesOfFilesAreNoCommandsToTheTerminal) {
    const Ran missing = shell("$octavo info $'a\\e[2Jb\\n\\xc2\\x9bc\\xff.stl'");
    EXPECT_EQ(missing.exit_code, 3);
    EXPECT_NE(missing.err.find("a\\x1b[2Jb\\n\\xc2\\x9bc\\xff.stl: cannot be opened"), std::string::npos)
        << missing.err;
    EXPECT_NE(shell("$octavo $'in\\efo'").err.find("in\\x1bfo"), std::string::npos);
    const Ran told = shell("$octavo shape cube -o $'\\e]0;ä.off'");
    EXPECT_NE(told.out.find("\\x1b]0;ä.off: cube"), std::string::npos) << told.out;
}

TEST_F(Conventions, AFailureLeavesNoFileBehind) {
    write("bad.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n");
    EXPECT_EQ(octavo("convert bad.off out.stl").exit_code, 3);
    EXPECT_EQ(octavo("octree bad.off -o out.oct").exit_code, 3);
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path("")))
        names.insert(entry.path().filename());
    EXPECT_EQ(names, (std::set<std::string>{".err", ".out", "bad.off"}));
}

TEST_F(Conventions, QuietPrintsNothingOnSuccess) {
    const Ran ran = octavo("shape cube -o cube.stl --quiet");
    EXPECT_EQ(ran.exit_code, 0);
    EXPECT_EQ(ran.out + ran.err, "");
}

TEST_F(Conventions, ColourFollowsTheEnvironment) {
    EXPECT_NE(shell("FORCE_COLOR=1 $octavo info nowhere.stl").err.find("\x1b["), std::string::npos);
    EXPECT_EQ(shell("NO_COLOR=1 FORCE_COLOR=1 $octavo info nowhere.stl").err.find("\x1b["),
              std::string::npos);
    EXPECT_EQ(shell("$octavo info nowhere.stl").err.find("\x1b["), std::string::npos)
        << "stderr is no terminal";
}

TEST_F(Conventions, SignalsEndLongWorkAndLeaveNothing) {
    ASSERT_EQ(octavo("shape rock --detail 200 -o rock.ply").exit_code, 0);
    for (const auto& [signal, code] : {std::pair{"INT", 130}, {"TERM", 143}, {"HUP", 129}}) {
        // The first line of progress shows that the work has begun.
        const Ran ran = shell(
            "$octavo octree rock.ply --depth 13 -o out.oct --threads 1 --progress plain 2>progress & "
            "worker=$!;"
            "for i in $(seq 400); do [ -s progress ] && break; sleep 0.05; done;"
            "kill -" +
            std::string(signal) +
            " $worker; wait $worker; code=$?; cat progress >&2; rm progress; exit $code");
        EXPECT_EQ(ran.exit_code, code);
        EXPECT_NE(ran.err.find("cancelled"), std::string::npos) << ran.err;
        EXPECT_EQ(shell("ls").out, "rock.ply\n");
    }
}

TEST_F(Conventions, SignalsEndWaitingForPipes) {
    ASSERT_EQ(octavo("shape rock --detail 100 -o rock.ply").exit_code, 0);
    ASSERT_EQ(octavo("shape cube -o cube.off").exit_code, 0);
    for (const std::string command :
         {"info empty.off", "info alone.off", "info - <>empty.off", "stats - <>empty.off",
          "contains cube.off empty.off --points-format csv", "hexmesh cube.off --level 2 --values empty.off",
          "convert cube.off alone.off", "convert rock.ply full.ply", "convert rock.ply - --to ply >full.ply",
          "render cube.off -o full.ply --to png", "man >full.ply", "convert rock.ply kept.ply >full.ply"}) {
        // Somebody has the pipes open, but for one, and does nothing. Whoever sleeps for a while waits.
        const Ran ran = shell(
            "mkfifo empty.off alone.off full.ply; sleep 60 <>empty.off & empty=$!;"
            "sleep 60 <>full.ply & full=$!; cat /dev/zero >full.ply & filler=$!; sleep 0.1; $octavo " +
            command +
            " & worker=$!; asleep=0; for i in $(seq 500); do"
            "  [ \"$(cut -d ' ' -f 3 /proc/$worker/stat)\" = S ] && asleep=$((asleep + 1)) || asleep=0;"
            "  [ $asleep = 5 ] && break; sleep 0.02; done;"
            "kill -INT $worker; wait $worker; code=$?; kill $empty $full $filler; rm *.off full.ply;"
            "exit $code");
        EXPECT_EQ(ran.exit_code, 130) << command << ran.err;
        EXPECT_NE(ran.err.find("cancelled"), std::string::npos) << command << ran.err;
        ASSERT_EQ(octavo("shape cube -o cube.off").exit_code, 0);
    }
}

TEST_F(Conventions, MoreThreadsThanCoresAreNoWarning) {
    ASSERT_EQ(octavo("shape rock --detail 60 -o rock.ply").exit_code, 0);
    const Ran ran = octavo("octree rock.ply --depth 7 --threads 200");
    EXPECT_EQ(ran.exit_code, 0);
    EXPECT_EQ(ran.err, "");
}

TEST_F(Conventions, ManPageAndCompletionKnowEveryVerb) {
    const std::string man = octavo("man").out, completion = octavo("completion bash").out;
    std::istringstream help(octavo("--help").out);
    int verbs = 0;
    for (std::string line; std::getline(help, line);) {
        std::string name;
        if (line.rfind("  ", 0) != 0 || !(std::istringstream(line) >> name) || name[0] == '-') continue;
        ++verbs;
        EXPECT_NE(man.find("octavo " + name), std::string::npos) << name;
        EXPECT_NE(completion.find(name), std::string::npos) << name;
    }
    EXPECT_GE(verbs, 8);
    EXPECT_EQ(shell("$octavo man | man --warnings -l - 2>&1 >/dev/null").out, "");
    // In the C locale, which bare machines have, troff knows no other characters.
    EXPECT_TRUE(
        std::all_of(man.begin(), man.end(), [](char c) { return static_cast<unsigned char>(c) < 128; }));
    EXPECT_EQ(shell("$octavo completion bash | bash -n").exit_code, 0);
}

TEST_F(Conventions, BashCompletesVerbsOptionsAndChoices) {
    const auto completed = [&](const std::string& words, int at) {
        return shell("source <($octavo completion bash); COMP_WORDS=(" + words +
                     "); COMP_CWORD=" + std::to_string(at) + "; _octavo; echo ${COMPREPLY[*]}")
            .out;
    };
    EXPECT_EQ(completed("octavo oct", 1), "octree\n");
    EXPECT_EQ(completed("octavo octree --dep", 2), "--depth\n");
    EXPECT_EQ(completed("octavo octree --open w", 3), "winding\n");
    EXPECT_EQ(completed("octavo octree --he", 2), "--help\n") << "once";
}

TEST_F(Conventions, ZshAndFishCompletionAreForTheseShells) {
    for (const char* name : {"zsh", "fish"}) {
        const std::string script = octavo(std::string("completion ") + name).out;
        for (const char* word : {"octree", "depth", "reject winding", "Print errors only"})
            EXPECT_NE(script.find(word), std::string::npos) << name << " " << word;
        // Where the shell is installed, it must accept the script.
        EXPECT_EQ(shell(std::string("$octavo completion ") + name + " > script; ! command -v " + name +
                        " || " + name + " -n script")
                      .exit_code,
                  0);
    }
}

}  // namespace
}  // namespace octavo::tests
