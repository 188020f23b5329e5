// SPDX-License-Identifier: Apache-2.0
#include <set>
#include <vector>

#include "cli/program.hpp"

// Files that lie, end early, or are something else: exit code 3, a sentence that names the file and the place in it,
// and nothing written.

namespace octavo::tests {
namespace {

class BadFiles : public ProgramTest {
  protected:
    std::set<std::string> names() const {
        std::set<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(path("")))
            if (entry.path().filename().string()[0] != '.') names.insert(entry.path().filename());
        return names;
    }

    /// Every verb that could read `file` must refuse it.
    void expect_refused(const std::string& file, const std::string& content, const std::string& place) {
        write(file, content);
        const std::set<std::string> before = names();
        for (const std::string& command : {"info " + file, "check " + file, "convert " + file + " out.stl",
                                           "octree " + file + " -o out.oct", "render " + file + " -o out.png",
                                           "union " + file + " " + file + " -o out.ply"}) {
            const Ran ran = octavo(command);
            EXPECT_EQ(ran.exit_code, 3) << command << "\n" << ran.out << ran.err;
            EXPECT_NE(ran.err.find(place), std::string::npos) << command << "\n" << ran.err;
            EXPECT_EQ(names(), before) << command;
        }
    }
};

std::string binary(std::initializer_list<std::uint32_t> words) {
    std::string bytes;
    for (const std::uint32_t word : words) bytes.append(reinterpret_cast<const char*>(&word), 4);
    return bytes;
}

TEST_F(BadFiles, TextWithAWrongWordNamesTheLine) {
    expect_refused("a.off", "OFF\n3 1 0\n0 0 0\n1 0 zero\n0 1 0\n3 0 1 2\n", "a.off:4");
    expect_refused("b.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", "b.obj:4");
    expect_refused("c.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 0\n", "c.obj:4");
    expect_refused(
        "d.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n",
        "d.ply:13");
    expect_refused("f.poly", "4 3\n1 0 0 0\n2 6 0 0\n3 0 6 0\n4 0 1 6\n1\n1\n4 1 2 3 4\n", "f.poly:7");
    expect_refused("g.smesh", "3 3\n1 0 0 0\n2 6 0 0\n3 0 6 0\n1\n3 1 2 4\n", "g.smesh:6");
    expect_refused("e.stl", "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 nan\n",
                   "e.stl:5");
}

TEST_F(BadFiles, CountsThatTheFileCannotHoldAreRefusedAtOnce) {
    expect_refused("a.off", "OFF\n4000000000 4000000000 0\n0 0 0\n", "a.off:");
    expect_refused("b.ply",
                   "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\n"
                   "property float y\nproperty float z\nelement face 4000000000\n"
                   "property list uint int vertex_indices\nend_header\n1234",
                   "b.ply:");
    expect_refused("c.stl", std::string(80, 'x') + binary({0xffffffffU}), "c.stl:");
    expect_refused("d.ply",
                   "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\n"
                   "property float y\nproperty float z\nelement face 1\n"
                   "property list uint int vertex_indices\nend_header\n" +
                       binary({0, 0, 0, 0x3f800000, 0, 0, 0, 0x3f800000, 0, 0xffffffffU, 0, 1, 2}),
                   "d.ply:");
}

TEST_F(BadFiles, EmptyFilesFoldersAndForbiddenOnesAreNamed) {
    for (const char* name : {"a.stl", "a.obj", "a.ply", "a.off", "a.3mf", "a.poly", "a.smesh", "a.glb", "a"})
        expect_refused(name, "", name);
    std::filesystem::create_directory(path("folder.stl"));
    EXPECT_NE(octavo("info folder.stl").err.find("folder.stl"), std::string::npos);
    EXPECT_EQ(octavo("info folder.stl").exit_code, 3);
    ASSERT_EQ(octavo("shape cube -o cube.off").exit_code, 0);
    for (const char* command : {"convert cube.off folder.stl", "convert cube.off nowhere/cube.stl",
                                "render cube.off -o nowhere/a.png", "octree cube.off -o nowhere/a.oct"}) {
        const Ran ran = octavo(command);
        EXPECT_EQ(ran.exit_code, 3) << command;
        EXPECT_NE(ran.err.find("error"), std::string::npos);
    }
    if (geteuid() == 0) return;  // root may read everything
    std::filesystem::permissions(path("cube.off"), std::filesystem::perms::none);
    EXPECT_EQ(octavo("info cube.off").exit_code, 3);
}

TEST_F(BadFiles, AWrongExtensionIsABadFile) {
    ASSERT_EQ(octavo("shape cube -o cube.off").exit_code, 0);
    const std::string off = read("cube.off");
    for (const char* name : {"a.stl", "a.ply", "a.3mf", "a.oct", "a.csg"}) {
        write(name, off);
        for (const char* verb : {"info ", "octree "}) {
            const Ran ran = octavo(verb + std::string(name));
            EXPECT_EQ(ran.exit_code, 3) << verb << name;
            EXPECT_NE(ran.err.find(name), std::string::npos) << ran.err;
        }
    }
    EXPECT_EQ(octavo("stats a.oct").exit_code, 3);
    EXPECT_EQ(octavo("contains cube.off a.ply").exit_code, 3);
}

/// Whatever is cut off: an answer or exit code 3, never a crash, never half a file.
TEST_F(BadFiles, FilesThatEndEarlyNeverCrashAnything) {
    ASSERT_EQ(octavo("shape tetrahedron -o t.stl").exit_code, 0);
    ASSERT_EQ(octavo("octree t.stl --depth 3 -o t.oct").exit_code, 0);
    ASSERT_EQ(octavo("convert t.stl t2.stl --encoding ascii").exit_code, 0);
    ASSERT_EQ(octavo("convert t.stl t2.ply --encoding ascii").exit_code, 0);
    for (const char* name : {"t.obj", "t.ply", "t.off", "t.3mf", "t.poly"})
        ASSERT_EQ(octavo(std::string("convert t.stl ") + name).exit_code, 0);
    write("t.csg", "union() {\n  cube(size = [1, 2, 3]);\n  sphere(r = 2, $fn = 8);\n}\n");
    for (const char* name :
         {"t.stl", "t2.stl", "t.obj", "t.ply", "t2.ply", "t.off", "t.3mf", "t.poly", "t.oct", "t.csg"}) {
        const std::string whole = read(name);
        const std::string cut = "cut" + std::filesystem::path(name).extension().string();
        int refused = 0;
        for (std::size_t part = 1; part <= 12; ++part) {
            write(cut, whole.substr(0, whole.size() * part / 13));
            const Ran ran = octavo("convert " + cut + " out.off");
            EXPECT_TRUE(ran.exit_code == 0 || ran.exit_code == 3) << name << " " << part << ran.err;
            EXPECT_EQ(std::filesystem::exists(path("out.off")), ran.exit_code == 0);
            if (ran.exit_code == 3) {
                ++refused;
                EXPECT_NE(ran.err.find(cut), std::string::npos) << ran.err;
            }
            std::filesystem::remove(path("out.off"));
        }
        EXPECT_GE(refused, 4) << name;
    }
}

TEST_F(BadFiles, BytesTurnedOverNeverCrashAnything) {
    ASSERT_EQ(octavo("shape tetrahedron -o t.stl").exit_code, 0);
    ASSERT_EQ(octavo("octree t.stl --depth 3 -o t.oct").exit_code, 0);
    for (const char* name : {"t.ply", "t.off", "t.3mf"})
        ASSERT_EQ(octavo(std::string("convert t.stl ") + name).exit_code, 0);
    std::uint32_t random = 7;
    for (const char* name : {"t.stl", "t.ply", "t.off", "t.3mf", "t.oct"}) {
        const std::string whole = read(name);
        for (int round = 0; round < 12; ++round) {
            std::string spoiled = whole;
            for (int k = 0; k < 3; ++k) {
                random = random * 1664525U + 1013904223U;
                spoiled[(random >> 8) % whole.size()] = static_cast<char>(random >> 24);
            }
            const std::string file = "spoiled" + std::filesystem::path(name).extension().string();
            write(file, spoiled);
            const int code = octavo("info " + file).exit_code;
            EXPECT_TRUE(code == 0 || code == 3 || code == 4) << name << " " << round << ": " << code;
        }
        // The octree's checksum lets no change through.
        if (std::string(name) == "t.oct") {
            EXPECT_EQ(octavo("stats spoiled.oct").exit_code, 3);
        }
    }
}

TEST_F(BadFiles, BadPointsNameTheLine) {
    ASSERT_EQ(octavo("shape cube -o cube.off").exit_code, 0);
    write("points.csv", "x,y,z\n0,0,0\n1,2\n");
    const Ran ran = octavo("contains cube.off points.csv -o sides.csv");
    EXPECT_EQ(ran.exit_code, 3);
    EXPECT_NE(ran.err.find("points.csv:3"), std::string::npos) << ran.err;
    EXPECT_FALSE(std::filesystem::exists(path("sides.csv")));
    write("lying.npy", std::string("\x93NUMPY\x01\x00", 8) + std::string("\xff\xff", 2) + "{'descr': '<f8'");
    EXPECT_EQ(octavo("contains cube.off lying.npy").exit_code, 3);
}

}  // namespace
}  // namespace octavo::tests
