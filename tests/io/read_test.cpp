// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <fstream>
#include <iterator>

#include <fcntl.h>
#include <unistd.h>

#include "folder.hpp"
#include "from_text.hpp"
#include "models.hpp"

namespace octavo::io {
namespace {

void write_file(const std::string& path, std::string_view text) {
    std::ofstream(path, std::ios::binary).write(text.data(), static_cast<std::streamsize>(text.size()));
}
std::string file_text(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

TEST(ReadMesh, TellsTheFormatFromTheContent) {
    for (const char* format : {"stl", "obj", "ply", "off", "3mf"})
        for (const Encoding encoding : {Encoding::binary, Encoding::ascii}) {
            const std::string text = write_text(awkward_mesh(), format, encoding);
            EXPECT_EQ(must_read(text, "").format, format);
            EXPECT_EQ(must_read(text, "").mesh.triangles, awkward_mesh().triangles);
        }
    for (const char* text : {"hello", "PNG", "1 2 3\n"}) {
        const Result<ReadMesh> read = read_text(text, "");
        ASSERT_FALSE(read);
        EXPECT_EQ(read.error().code, ErrorCode::unsupported);
        EXPECT_THAT(read.error().sentence, testing::HasSubstr("stl, obj, ply, off, 3mf"));
    }
    EXPECT_EQ(read_text("", "").error().code, ErrorCode::bad_input);
}

TEST(ReadMesh, SkipsTheMarkOfUtf8) {
    for (const char* format : {"stl", "obj", "ply", "off"}) {
        const std::string text = "\xef\xbb\xbf" + write_text(awkward_mesh(), format, Encoding::ascii);
        EXPECT_EQ(must_read(text, "").mesh.triangles, awkward_mesh().triangles);
    }
    EXPECT_EQ(read_text("\xef\xbb\xbf", "").error().code, ErrorCode::bad_input);
}

/// Lets descriptor `number` be another file until the end of the block.
class Redirected {
  public:
    Redirected(int number, const std::string& path, int flags) : number_(number), saved_(::dup(number)) {
        const int file = ::open(path.c_str(), flags, 0666);
        ::dup2(file, number_);
        ::close(file);
    }
    ~Redirected() {
        ::dup2(saved_, number_);
        ::close(saved_);
    }

  private:
    int number_, saved_;
};

TEST(ReadMesh, TakesADashForStandardInputAndOutput) {
    const Folder folder;
    {
        const Redirected output(1, folder / "out", O_WRONLY | O_CREAT);
        ASSERT_TRUE(write_mesh("-", awkward_mesh(), {.format = "ply"}));
    }
    EXPECT_EQ(file_text(folder / "out"), write_text(awkward_mesh(), "ply"));
    const Redirected input(0, folder / "out", O_RDONLY);
    const Result<ReadMesh> read = read_mesh("-");
    ASSERT_TRUE(read) << read.error().describe();
    EXPECT_EQ(read->mesh.triangles, awkward_mesh().triangles);
}

TEST(ReadMesh, GoesByExtensionThenByContentUnlessTold) {
    const Folder folder;
    write_file(folder / "a.OFF", write_text(awkward_mesh(), "off"));
    write_file(folder / "b", write_text(awkward_mesh(), "ply"));
    write_file(folder / "c.stl", write_text(awkward_mesh(), "obj"));
    EXPECT_EQ(read_mesh(folder / "a.OFF")->format, "off");
    EXPECT_EQ(read_mesh(folder / "b")->format, "ply");
    EXPECT_FALSE(read_mesh(folder / "c.stl"));
    EXPECT_EQ(read_mesh(folder / "c.stl", {.format = "obj"})->format, "obj");
    EXPECT_EQ(read_mesh(folder / "c.stl", {.format = ".OBJ"})->format, "obj");
}

TEST(ReadMesh, SaysWhatTheSystemRefused) {
    const Folder folder;
    const Result<ReadMesh> missing = read_mesh(folder / "missing.stl");
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().code, ErrorCode::io);
    EXPECT_EQ(missing.error().place.file, folder / "missing.stl");
    EXPECT_THAT(missing.error().sentence, testing::HasSubstr("No such file"));
    EXPECT_EQ(read_mesh(folder / ".").error().code, ErrorCode::io);
    write_file(folder / "bad.obj", "v 1 2\n");
    EXPECT_EQ(read_mesh(folder / "bad.obj").error().describe().substr((folder / "").size()),
              "bad.obj:1:6: a vertex needs three numbers");
}

TEST(ReadMesh, StopsWhenCancelled) {
    std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (int i = 0; i < 100000; ++i) text += "f 1 2 3\n";
    std::atomic<bool> cancel = false;
    int reports = 0;
    Context context;
    context.cancel = &cancel;
    context.on_progress = [&](std::string_view, double done) {
        ++reports;
        EXPECT_GT(done, 0);
        EXPECT_LT(done, 1);
        cancel = true;
    };
    const Result<ReadMesh> read = read_mesh(bytes_of(text), {.format = "obj"}, context);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().code, ErrorCode::cancelled);
    EXPECT_EQ(reports, 1);
}

TEST(ReadMesh, ReadsTheOverlappingSpheres) {
    OCTAVO_NEEDS_MODEL("boolean-pairs/spheres");
    int files = 0;
    for (const auto& entry :
         std::filesystem::directory_iterator(tests::models_folder() / "boolean-pairs/spheres")) {
        const Result<ReadMesh> read = read_mesh(entry.path().string());
        ASSERT_TRUE(read) << read.error().describe();
        EXPECT_EQ(read->mesh.vertices.size(), 162u);
        EXPECT_EQ(read->mesh.triangles.size(), 320u);
        ++files;
    }
    EXPECT_EQ(files, 50);
}

TEST(WriteMesh, WritesAllFormatsByExtension) {
    const Folder folder;
    for (const char* name : {"m.stl", "m.obj", "m.PLY", "m.off", "m.3mf"}) {
        const Result<WriteReport> report = write_mesh(folder / name, awkward_mesh());
        ASSERT_TRUE(report) << report.error().describe();
        EXPECT_EQ(report->bytes, std::filesystem::file_size(folder / name));
        EXPECT_EQ(read_mesh(folder / name)->mesh.triangles, awkward_mesh().triangles);
    }
    EXPECT_EQ(folder.files(), 5u);
}

TEST(WriteMesh, ReplacesAFileOnlyWhenAllWentWell) {
    const Folder folder;
    write_file(folder / "m.stl", "precious");
    mesh::Mesh mesh = awkward_mesh();
    mesh.vertices[0].x = 1e300;
    EXPECT_FALSE(write_mesh(folder / "m.stl", mesh));
    EXPECT_EQ(file_text(folder / "m.stl"), "precious");
    EXPECT_EQ(folder.files(), 1u);
    EXPECT_TRUE(write_mesh(folder / "m.stl", awkward_mesh()));
    EXPECT_EQ(std::filesystem::file_size(folder / "m.stl"), 284u);
    EXPECT_EQ(folder.files(), 1u);
}

TEST(WriteMesh, KeepsPermissionsAndLinks) {
    const Folder folder;
    write_file(folder / "real.obj", "old");
    std::filesystem::permissions(folder / "real.obj", std::filesystem::perms(0640));
    std::filesystem::create_symlink("real.obj", folder / "link.obj");
    ASSERT_TRUE(write_mesh(folder / "link.obj", awkward_mesh()));
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.obj"));
    EXPECT_EQ(std::filesystem::status(folder / "real.obj").permissions(), std::filesystem::perms(0640));
    EXPECT_TRUE(read_mesh(folder / "real.obj"));
}

TEST(WriteMesh, RefusesUnknownFormatsAndLostFolders) {
    const Folder folder;
    for (const char* name : {"m.xyz", "m", "m."}) {
        const Result<WriteReport> report = write_mesh(folder / name, awkward_mesh());
        ASSERT_FALSE(report);
        EXPECT_EQ(report.error().code, ErrorCode::unsupported);
        EXPECT_THAT(report.error().sentence, testing::HasSubstr("stl, obj, ply, off, 3mf"));
    }
    EXPECT_EQ(write_mesh("-", awkward_mesh()).error().code, ErrorCode::unsupported);
    EXPECT_EQ(write_mesh(folder / "no/such/m.stl", awkward_mesh()).error().code, ErrorCode::io);
    EXPECT_EQ(folder.files(), 0u);
}

TEST(WriteMesh, TellsOfAFullDisk) {
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full here";
    const Result<WriteReport> report = write_mesh("/dev/full", awkward_mesh(), {.format = "obj"});
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().code, ErrorCode::io);
    EXPECT_THAT(report.error().sentence, testing::HasSubstr("No space"));
}

TEST(WriteMesh, RefusesCoordinatesThatAreNotFinite) {
    mesh::Mesh mesh = awkward_mesh();
    mesh.vertices[1].y = std::nan("");
    for (const char* format : {"stl", "obj", "ply", "off", "3mf"}) {
        const WriteOptions options{.format = format};
        EXPECT_EQ(write_mesh(mesh, options).error().code, ErrorCode::limit);
    }
}

TEST(WriteMesh, WritesAnEmptySolidThatIsReadAgain) {
    for (const char* format : {"stl", "obj", "ply", "off", "3mf", "poly", "smesh"}) {
        const ReadMesh read = must_read(write_text({}, format), format);
        EXPECT_TRUE(read.mesh.vertices.empty() && read.mesh.triangles.empty()) << format;
        EXPECT_THAT(read.warnings, testing::ElementsAre("the file has no facets: the solid is empty"))
            << format;
        EXPECT_EQ(write_text(read.mesh, format), write_text({}, format));
    }
    EXPECT_TRUE(must_read(write_text({}, "stl", Encoding::ascii), "stl").mesh.triangles.empty());
    EXPECT_TRUE(must_read("solid empty\nendsolid empty\n", "stl").mesh.triangles.empty());
    EXPECT_TRUE(read_polygons(bytes_of("OFF\n0 0 0\n"), {.format = "off"})->mesh.corners.empty());
}

TEST(ReadMesh, TakesNoFileOfVerticesAloneOrOfAnotherKindForAnEmptySolid) {
    EXPECT_EQ(read_text("OFF\n1 0 0\n0 0 0\n", "off").error().sentence, "has no facets, only 1 vertex");
    EXPECT_EQ(read_text("v 0 0 0\nv 1 0 0\n", "obj").error().sentence, "has no facets, only 2 vertices");
    EXPECT_FALSE(read_text("<html>\n<body>not found</body>\n", "obj"));
    EXPECT_FALSE(read_text("", "obj"));
}

TEST(ReadMesh, CountsOneAsOne) {
    const std::string triangle = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    EXPECT_THAT(must_read(triangle + "x", "off").warnings,
                testing::ElementsAre("1 byte after the last announced face is ignored"));
    EXPECT_THAT(must_read("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2\ncurv 0 1 1 2\n", "obj").warnings,
                testing::UnorderedElementsAre("1 free-form curve or surface is left out",
                                              "1 face of fewer than three corners is left out"));
}

}  // namespace
}  // namespace octavo::io
