// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include <octavo/hexmesh/to_polyhedra.hpp>
#include <octavo/io/openfoam.hpp>

#include "hexmesh/folder.hpp"
#include "hexmesh/written_meshes.hpp"

// Meshes as polyhedra, and as the OpenFOAM cases that checkMesh takes.

namespace octavo::hexmesh {
namespace {

namespace fs = std::filesystem;

TEST(ToPolyhedra, ClosesEveryCellAndKeepsTheVolume) {
    const Built built = graded_mesh();
    EXPECT_GT(built.mesh.edge_hanging.size(), 100u);
    EXPECT_GT(built.mesh.face_hanging.size(), 100u);
    const mesh::PolyhedralMesh mesh = to_polyhedra(built.mesh);
    ASSERT_EQ(mesh.cells, built.mesh.cells.size());

    // Per cell: how often each edge is run along in each direction, and the volume under its faces.
    std::vector<std::map<std::pair<std::uint32_t, std::uint32_t>, int>> edges(mesh.cells);
    std::vector<double> volume(mesh.cells, 0);
    for (std::size_t face = 0; face < mesh.owner.size(); ++face) {
        const std::uint32_t begin = mesh.face_begin[face], end = mesh.face_begin[face + 1];
        const auto point = [&](std::uint32_t i) { return mesh.points[mesh.face_points[i]]; };
        double six = 0;
        for (std::uint32_t i = begin + 2; i < end; ++i)
            six += dot(point(begin), cross(point(i - 1), point(i)));
        const auto run = [&](std::uint32_t cell, int direction) {
            volume[cell] += direction * six / 6;
            for (std::uint32_t i = begin; i < end; ++i) {
                const std::uint32_t a = mesh.face_points[i],
                                    b = mesh.face_points[i + 1 == end ? begin : i + 1];
                ASSERT_NE(a, b);
                edges[cell][{std::min(a, b), std::max(a, b)}] += a < b ? direction : -direction;
            }
        };
        run(mesh.owner[face], 1);
        if (face < mesh.neighbour.size()) {
            ASSERT_LT(mesh.owner[face], mesh.neighbour[face]);
            run(mesh.neighbour[face], -1);
        }
    }
    for (std::uint32_t cell = 0; cell < mesh.cells; ++cell) {
        for (const auto& [ends, balance] : edges[cell])
            ASSERT_EQ(balance, 0) << "cell " << cell << " is open";
        const double side = built.mesh.lattice.unit() * built.mesh.cells[cell].side();
        ASSERT_NEAR(volume[cell] / (side * side * side), 1, 1e-9);
    }
    for (std::size_t face = 1; face < mesh.neighbour.size(); ++face)
        ASSERT_LT(std::pair(mesh.owner[face - 1], mesh.neighbour[face - 1]),
                  std::pair(mesh.owner[face], mesh.neighbour[face]));
    std::uint32_t next = static_cast<std::uint32_t>(mesh.neighbour.size());
    for (const auto& patch : mesh.patches) {
        EXPECT_EQ(patch.first_face, next);
        next += patch.faces;
    }
    EXPECT_EQ(next, mesh.owner.size());
    EXPECT_EQ(mesh.patches.size(), 2u);
    std::size_t in_zones = 0;
    for (const auto& zone : mesh.zones) in_zones += zone.cells.size();
    EXPECT_EQ(in_zones, mesh.cells);
    EXPECT_EQ(mesh.zones.size(), 3u);
}

/// What OpenFOAM's checkMesh says about a case, as it was written.
std::string check_mesh(const Folder& folder) {
    const std::string command =
        "WM_PROJECT_DIR=\"${WM_PROJECT_DIR:-/usr/share/openfoam}\" checkMesh -case '" + folder.string() +
        "' -allTopology > '" + (folder / "log").string() + "' 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0);
    return text_of(folder / "log");
}

TEST(WriteOpenFoam, IsAcceptedByCheckMesh) {
    if (!is_installed("checkMesh")) GTEST_SKIP() << "OpenFOAM's checkMesh is not installed";
    const Folder folder;
    const std::string names[] = {"first part", "second"};
    ASSERT_TRUE(io::write_openfoam(folder.string(), to_polyhedra(graded_mesh().mesh, names)));
    const std::string log = check_mesh(folder);
    EXPECT_NE(log.find("Mesh OK."), std::string::npos) << log;
    EXPECT_NE(log.find("first_part"), std::string::npos) << log;
}

TEST(WriteOpenFoam, IsAcceptedByCheckMeshWithAFittedLayer) {
    if (!is_installed("checkMesh")) GTEST_SKIP() << "OpenFOAM's checkMesh is not installed";
    const Folder folder;
    ASSERT_TRUE(io::write_openfoam(folder.string(), to_polyhedra(fitted_ball().mesh)));
    const std::string log = check_mesh(folder);
    EXPECT_NE(log.find("Mesh OK."), std::string::npos) << log;
}

TEST(WriteOpenFoam, LeavesNothingBehindWhenItIsCancelled) {
    const Folder folder;
    const std::atomic<bool> cancel = true;
    EXPECT_FALSE(io::write_openfoam(folder.string(), to_polyhedra(graded_mesh().mesh),
                                    {.on_progress = {}, .cancel = &cancel}));
    EXPECT_TRUE(fs::is_empty(folder.string()));
    // Folders on the way are removed only when they were made for this.
    fs::create_directories(folder / "kept/constant");
    for (const char* path : {"kept", "new/case"})
        EXPECT_FALSE(io::write_openfoam((folder / path).string(), to_polyhedra(graded_mesh().mesh),
                                        {.on_progress = {}, .cancel = &cancel}));
    EXPECT_TRUE(fs::is_empty(folder / "kept/constant"));
    EXPECT_FALSE(fs::exists(folder / "new"));
}

TEST(WriteOpenFoam, ReplacesAnEarlierMeshAndKeepsWhatOthersPutThere) {
    const Folder folder;
    fs::create_directories(folder / "constant/polyMesh/sets");
    fs::create_directories(folder / "system");
    for (const char* mine : {"constant/polyMesh/blockMeshDict", "constant/transportProperties",
                             "system/controlDict", "constant/polyMesh/sets/walls"})
        std::ofstream(folder / mine) << "mine";
    for (const char* old : {"owner", "points.gz", "cellLevel"})
        std::ofstream(folder / "constant/polyMesh" / old) << "old";
    const mesh::PolyhedralMesh mesh = to_polyhedra(graded_mesh().mesh);
    const std::atomic<bool> cancel = true;
    EXPECT_FALSE(io::write_openfoam(folder.string(), mesh, {.on_progress = {}, .cancel = &cancel}));
    EXPECT_EQ(text_of(folder / "constant/polyMesh/owner"), "old") << "until there is another";
    EXPECT_EQ(std::distance(fs::directory_iterator(folder / "system"), {}), 1);
    const Result<io::WriteReport> written = io::write_openfoam(folder.string(), mesh);
    ASSERT_TRUE(written);
    EXPECT_NE(text_of(folder / "constant/polyMesh/owner"), "old");
    EXPECT_FALSE(fs::exists(folder / "constant/polyMesh/points.gz"));
    for (const char* mine : {"constant/polyMesh/blockMeshDict", "constant/transportProperties",
                             "system/controlDict", "constant/polyMesh/sets/walls"})
        EXPECT_EQ(text_of(folder / mine), "mine") << mine;
    ASSERT_EQ(written->warnings.size(), 1u);
    EXPECT_NE(written->warnings[0].find("blockMeshDict, sets"), std::string::npos) << written->warnings[0];
    EXPECT_TRUE(fs::exists(folder / "system/fvSchemes"));
    EXPECT_EQ(std::distance(fs::directory_iterator(folder / "constant"), {}), 2) << "nothing is left over";
    // What is there may be a link, which is replaced, not followed.
    fs::rename(folder / "constant/polyMesh", folder / "elsewhere");
    fs::create_directory_symlink(folder / "elsewhere", folder / "constant/polyMesh");
    ASSERT_TRUE(io::write_openfoam(folder.string(), mesh));
    EXPECT_FALSE(fs::is_symlink(folder / "constant/polyMesh"));
    EXPECT_TRUE(fs::exists(folder / "elsewhere/owner"));
}

}  // namespace
}  // namespace octavo::hexmesh
