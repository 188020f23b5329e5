// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <filesystem>
#include <string>

#include "cli/program.hpp"

// Vertices that no facet uses are no part of a solid: no verb may tell a file with them from one without.

namespace octavo::tests {
namespace {

/// A box away from the world's origin, whose sides are no multiples of anything; `unused` are lines "v x y z" that go
/// before the eight vertices, and so move all indices.
std::string box_as_obj(const std::string& unused, std::size_t count) {
    std::string text = unused;
    for (int corner = 0; corner < 8; ++corner)
        text += std::string("v ") + (corner & 1 ? "500005.3" : "500000") +
                (corner & 2 ? " 4000005.3" : " 4000000") + (corner & 4 ? " 105.3\n" : " 100\n");
    for (const auto& [a, b, c, d] : {std::array<std::size_t, 4>{1, 3, 4, 2},
                                     {5, 6, 8, 7},
                                     {1, 2, 6, 5},
                                     {3, 7, 8, 4},
                                     {1, 5, 7, 3},
                                     {2, 4, 8, 6}})
        text += "f " + std::to_string(a + count) + " " + std::to_string(b + count) + " " +
                std::to_string(c + count) + " " + std::to_string(d + count) + "\n";
    return text;
}

class UnusedVertices : public ProgramTest {
  protected:
    void SetUp() override {
        ProgramTest::SetUp();
        write("clean.obj", box_as_obj("", 0));
        write("origin.obj", box_as_obj("v 0 0 0\n", 1));
        write("far.obj", box_as_obj("v 1e9 0 0\nv 0 -1e300 0\n", 2));
        write("points.csv", "500005.31,4000002,102\n500005.29,4000002,102\n500000,4000000,100\n");
        write("path.csv", "500000,4000000,100\n500005,4000002,103\n");
        ASSERT_EQ(octavo("shape cube -o tool.stl").exit_code, 0);
    }

    /// What the command prints, and what it writes to its last argument, when MODEL is put in.
    struct Told {
        int exit_code;
        std::string out, written;
        friend bool operator==(const Told&, const Told&) = default;
    };
    Told tell(std::string command, const std::string& model) {
        for (std::size_t at; (at = command.find("MODEL")) != std::string::npos;)
            command.replace(at, 5, model);
        const Ran ran = octavo(command + " -q");
        EXPECT_EQ(ran.exit_code, 0) << command << '\n' << ran.err;
        const std::size_t at = command.find(" out.");
        if (at == std::string::npos) return {ran.exit_code, ran.out, ""};
        const std::string file = command.substr(at + 1);
        Told told{ran.exit_code, ran.out, read(file)};
        EXPECT_FALSE(told.written.empty()) << command;
        std::filesystem::remove(path(file));
        return told;
    }
};

TEST_F(UnusedVertices, ChangeNoAnswer) {
    for (const char* command : {
             "contains MODEL points.csv",
             "distance MODEL points.csv",
             "union MODEL -o out.stl",
             "union MODEL tool.stl -o out.off",
             "difference MODEL tool.stl -o out.off",
             "intersection MODEL MODEL -o out.off",
             "xor MODEL tool.stl -o out.off",
             "eval A A=MODEL -o out.off",
             "mill MODEL --tool tool.stl --path path.csv -o out.off",
             "mill tool.stl --tool MODEL --path path.csv -o out.off",
             "octree MODEL --depth 6 -o out.oct",
             "build MODEL -o out.bpo",
             "bsp MODEL -o out.bso",
             "hexmesh MODEL -p 0.5 -o out.vtu",
             "hexmesh MODEL -p 1 --fit -o out.vtu",
             "render MODEL --size 200x150 -o out.png",
             "render MODEL --size 200x150 --cut x:0.5 -o out.svg",
             "repair MODEL -o out.off",
             "convert MODEL out.stl",
         }) {
        const Told clean = tell(command, "clean.obj");
        EXPECT_EQ(tell(command, "origin.obj"), clean) << command;
        EXPECT_EQ(tell(command, "far.obj"), clean) << command;
    }
}

TEST_F(UnusedVertices, AreReportedByCheckAndLeaveTheMeasuresAlone) {
    const nlohmann::json clean = octavo("info clean.obj --json").json()["result"];
    for (const char* model : {"origin.obj", "far.obj"}) {
        const nlohmann::json facts = octavo(std::string("info ") + model + " --json").json()["result"];
        for (const char* fact : {"volume", "area", "bounds"}) {
            ASSERT_TRUE(clean.contains(fact)) << clean.dump(1);
            EXPECT_EQ(facts[fact], clean[fact]) << model;
        }
        const Ran check = octavo(std::string("check ") + model);
        EXPECT_EQ(check.exit_code, 0);
        EXPECT_NE((check.out + check.err).find("used by no facet"), std::string::npos)
            << check.out << check.err;
    }
}

TEST_F(UnusedVertices, OfPolyhedraInCsgTreesChangeNothing) {
    const auto tree = [](const std::string& more) {
        return "intersection() { cube(size = [4, 4, 4], center = false);\n"
               "polyhedron(points = [[0,0,0],[3.1,0,0],[0,3.1,0],[0,0,3.1]" +
               more + "], faces = [[0,1,2],[0,3,1],[0,2,3],[1,3,2]], convexity = 1); }\n";
    };
    write("clean.csg", tree(""));
    write("far.csg", tree(",[1e7,0,0]"));
    for (const char* command :
         {"octree MODEL --depth 6 -o out.oct", "eval MODEL -o out.off", "contains MODEL points.csv"})
        EXPECT_EQ(tell(command, "far.csg"), tell(command, "clean.csg")) << command;
}

}  // namespace
}  // namespace octavo::tests
