// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

#include <octavo/hexmesh/build.hpp>
#include <octavo/hexmesh/conforming.hpp>
#include <octavo/hexmesh/fit.hpp>
#include <octavo/hexmesh/to_polyhedra.hpp>
#include <octavo/io/abaqus.hpp>
#include <octavo/io/gmsh.hpp>
#include <octavo/io/leaf_list.hpp>
#include <octavo/io/openfoam.hpp>
#include <octavo/io/p8est.hpp>
#include <octavo/mesh/hex_sides.hpp>
#include <octavo/mesh/shapes.hpp>

#include "hexmesh/folder.hpp"

namespace octavo::hexmesh {
namespace {

namespace fs = std::filesystem;

bool is_installed(const std::string& program) {
    return std::system(("command -v " + program + " > /dev/null 2>&1").c_str()) == 0;
}

std::string text_of(const fs::path& path) {
    std::ifstream file(path);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

/// Two spheres of different sizes of cell, and a box that is finer still: levels, hanging nodes and half-covered sides.
Built graded_mesh() {
    mesh::Mesh second = mesh::icosphere(1, 8);
    for (Vec3& vertex : second.vertices) vertex.x += 1.3;
    const std::vector<mesh::Mesh> solids{mesh::icosphere(1, 8), second};
    Options options{.precision = 0.25};
    options.solids = {{.solid = 1, .surface = 0.125}};
    options.boxes = {{{{-1, -1, -1}, {-0.4, 0.1, 0.1}}, 0.0625}};
    Result<Built> built = build(solids, options);
    EXPECT_TRUE(built);
    return std::move(*built);
}

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

/// What OpenFOAM's checkMesh says about a case.
std::string check_mesh(const Folder& folder) {
    fs::create_directory(folder / "system");
    std::ofstream(folder / "system/controlDict")
        << "FoamFile { version 2.0; format ascii; class dictionary; object controlDict; }\n"
           "application checkMesh; startFrom startTime; startTime 0; stopAt endTime; endTime 1; deltaT 1;\n"
           "writeControl timeStep; writeInterval 1;\n";
    for (const char* name : {"fvSchemes", "fvSolution"})
        std::ofstream(folder / "system" / name)
            << "FoamFile { version 2.0; format ascii; class dictionary; object " << name << "; }\n"
            << "ddtSchemes {} gradSchemes {} divSchemes {} laplacianSchemes {} interpolationSchemes {} "
               "snGradSchemes {}\n";
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

/// A ball with cells of two sizes on its surface, drawn to it over a layer.
Built fitted_ball() {
    const mesh::Mesh solid = mesh::icosphere(1, 8);
    Options options{.precision = 0.25, .layers = 1, .keep = Keep::manifold};
    options.boxes = {{{{-2, -2, -2}, {2, 2, 0.1}}, 0.125}};
    Result<Built> built = build(std::span(&solid, 1), options);
    EXPECT_TRUE(built);
    const std::size_t hanging = built->mesh.edge_hanging.size();
    const Result<FitReport> fitted = fit(built->mesh, std::span(&solid, 1));
    EXPECT_TRUE(fitted && fitted->has_buffer_layer);
    EXPECT_GT(built->mesh.edge_hanging.size(), hanging + 10) << "large cells of the layer meet smaller ones";
    return std::move(*built);
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

TEST(WriteOpenFoam, ReplacesAnEarlierMeshAsAWhole) {
    const Folder folder;
    fs::create_directories(folder / "constant/polyMesh/sets");
    std::ofstream(folder / "constant/polyMesh/stale") << "old";
    std::ofstream(folder / "constant/transportProperties") << "kept";
    const mesh::PolyhedralMesh mesh = to_polyhedra(graded_mesh().mesh);
    const std::atomic<bool> cancel = true;
    EXPECT_FALSE(io::write_openfoam(folder.string(), mesh, {.on_progress = {}, .cancel = &cancel}));
    EXPECT_TRUE(fs::exists(folder / "constant/polyMesh/stale")) << "until there is another";
    ASSERT_TRUE(io::write_openfoam(folder.string(), mesh));
    EXPECT_TRUE(fs::exists(folder / "constant/polyMesh/owner"));
    EXPECT_FALSE(fs::exists(folder / "constant/polyMesh/stale"));
    EXPECT_EQ(std::distance(fs::directory_iterator(folder / "constant"), {}), 2) << "nothing is left over";
    // What is there may be a link, which is replaced, not followed.
    fs::rename(folder / "constant/polyMesh", folder / "elsewhere");
    fs::create_directory_symlink(folder / "elsewhere", folder / "constant/polyMesh");
    ASSERT_TRUE(io::write_openfoam(folder.string(), mesh));
    EXPECT_FALSE(fs::is_symlink(folder / "constant/polyMesh"));
    EXPECT_TRUE(fs::exists(folder / "elsewhere/owner"));
}

TEST(WriteAbaqus, HasNoNumberLongerThanCalculixReads) {
    const mesh::Mesh solid = mesh::displaced_sphere(6);
    const Result<Built> built = build(std::span(&solid, 1), {.level = 5});
    ASSERT_TRUE(built);
    mesh::HexMesh mesh = built->mesh;
    mesh.lattice = *exact::Lattice::from_parts(-60, {-1234567890123, 7, 4444444444441});
    const Folder folder;
    ASSERT_TRUE(io::write_abaqus((folder / "m.inp").string(), mesh));
    std::ifstream file(folder / "m.inp");
    std::size_t longest = 0;
    bool data = false;
    for (std::string line; std::getline(file, line);) {
        if (line[0] == '*') {
            data = line.rfind("*NODE,", 0) == 0;
            continue;
        }
        std::stringstream fields(line);
        for (std::string field; data && std::getline(fields, field, ',');)
            longest = std::max(longest, field.size());
    }
    EXPECT_LE(longest, 20u);
    EXPECT_GE(longest, 19u) << "the test must reach the limit";
    mesh.constraints_are_direct = false;
    const auto refused = io::write_abaqus((folder / "n.inp").string(), mesh);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::unsupported);
}

/// What comes after `word` in the lines of a text that have it, without what follows the name.
std::vector<std::string> names_after(const std::string& word, const std::string& text) {
    std::vector<std::string> names;
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
        const std::size_t begin = at + word.size();
        names.push_back(text.substr(begin, text.find_first_of(",\n", begin) - begin));
    }
    return names;
}

std::size_t distinct(const std::vector<std::string>& names) {
    return std::set<std::string>(names.begin(), names.end()).size();
}

/// Boxes in a row, of which neighbours overlap, and one beside them, with cells outside.
mesh::HexMesh row_of_boxes() {
    const std::vector<mesh::Mesh> solids{mesh::box({0, 0, 0}, {2, 1, 1}), mesh::box({1, 0, 0}, {3, 1, 1}),
                                         mesh::box({4, 0, 0}, {5, 1, 1})};
    const Result<Built> built = build(solids, {.precision = 0.5, .keep = Keep::all});
    EXPECT_TRUE(built);
    return built->mesh;
}

/// Names that a format spells alike, or as it calls overlaps or the outside.
const std::vector<std::vector<std::string>> names_alike{
    {"a", "b", "a_and_b"},
    {"a", "b", "a+b"},
    {"a-b", "a_b", "a b"},
    {"outside", "7up", "S7UP"},
    {std::string(90, 'x') + "1", std::string(90, 'x') + "2", "c"}};

TEST(WriteAbaqus, GivesNoTwoMaterialsOneName) {
    const mesh::HexMesh mesh = row_of_boxes();
    for (const std::vector<std::string>& names : names_alike) {
        const Folder folder;
        ASSERT_TRUE(io::write_abaqus((folder / "m.inp").string(), mesh, {.names = names}));
        const std::string text = text_of(folder / "m.inp");
        const std::vector<std::string> sets = names_after("ELSET=", text);
        EXPECT_EQ(sets.size(), 5u);
        EXPECT_EQ(distinct(sets), 5u) << names[0];
        for (const std::string& surface : names_after("ELEMENT, NAME=", text)) {
            EXPECT_EQ(surface.rfind("SURFACE_OF_", 0), 0u);
            EXPECT_LE(surface.size(), 80u);
            EXPECT_EQ(std::count(sets.begin(), sets.end(), surface.substr(11)), 1) << surface;
        }
    }
}

TEST(WriteGmsh, GivesNoTwoGroupsOneName) {
    const std::vector<mesh::Mesh> solids{mesh::box({0, 0, 0}, {2, 1, 1}), mesh::box({1, 0, 0}, {3, 1, 1}),
                                         mesh::box({4, 0, 0}, {5, 1, 1})};
    const Result<Built> built = build_conforming(solids, {.precision = 0.5});
    ASSERT_TRUE(built);
    const Folder folder;
    const std::string names[] = {"a\"", "a_", "a_+a__2"};
    ASSERT_TRUE(io::write_gmsh((folder / "m.msh").string(), built->mesh, names));
    const std::vector<std::string> volumes = names_after("\n3 ", text_of(folder / "m.msh"));
    EXPECT_EQ(volumes,
              (std::vector<std::string>{"1 \"a_\"", "2 \"a_+a__2_2\"", "3 \"a__2\"", "4 \"a_+a__2\""}));
}

TEST(WriteOpenFoam, GivesNoTwoZonesOrPatchesOneName) {
    const mesh::HexMesh mesh = row_of_boxes();
    for (const std::vector<std::string>& names : names_alike) {
        const Folder folder;
        ASSERT_TRUE(io::write_openfoam(folder.string(), to_polyhedra(mesh, names)));
        for (const auto& [file, after_name] : {std::pair("cellZones", "\n{\n    type cellZone"),
                                               std::pair("boundary", "\n    {\n        type ")}) {
            const std::string text = text_of(folder / "constant/polyMesh" / file);
            std::vector<std::string> found;
            for (std::size_t at = text.find(after_name); at != std::string::npos;
                 at = text.find(after_name, at + 1)) {
                const std::size_t begin = text.find_last_of(" \n", at - 1) + 1;
                found.push_back(text.substr(begin, at - begin));
            }
            EXPECT_EQ(distinct(found), found.size()) << file << names[0];
            EXPECT_GE(found.size(), std::string(file) == "boundary" ? 1u : 5u);
        }
    }
}

TEST(WriteAbaqus, PutsNodesInTheEndSetsThatAreThereButForRounding) {
    const mesh::Mesh solid = mesh::box({0.1, 0.2, 0.3}, {1.1, 1.2, 1.3});
    Result<Built> built = build(std::span(&solid, 1), {.precision = 0.125, .largest = 0.125});
    ASSERT_TRUE(built);
    mesh::HexMesh mesh = built->mesh;
    std::size_t at_end = 0;
    std::vector<Vec3> positions;
    Box3 bounds;
    for (mesh::NodeIndex node = 0; node < mesh.node_count(); ++node) bounds.add(mesh.position(node));
    for (mesh::NodeIndex node = 0; node < mesh.node_count(); ++node) {
        Vec3& p = positions.emplace_back(mesh.position(node));
        if (p.x == bounds.low.x) p.x += at_end++ % 3 == 0 ? 1.6e-9 : 0;
    }
    mesh.positions = positions;
    const Folder folder;
    ASSERT_TRUE(io::write_abaqus((folder / "m.inp").string(), mesh));
    const std::string text = text_of(folder / "m.inp");
    const std::size_t begin = text.find("NSET=XMIN\n") + 10, end = text.find('*', begin);
    EXPECT_EQ(static_cast<std::size_t>(std::count(text.begin() + static_cast<std::ptrdiff_t>(begin),
                                                  text.begin() + static_cast<std::ptrdiff_t>(end), '\n')),
              at_end);
    EXPECT_GT(at_end, 50u);
}

/// The nodes that hold the boundary of a mesh.
std::set<mesh::NodeIndex> boundary_nodes(const mesh::HexMesh& mesh) {
    std::set<mesh::NodeIndex> boundary;
    const mesh::PolyhedralMesh polyhedra = to_polyhedra(mesh);
    for (std::size_t face = polyhedra.neighbour.size(); face < polyhedra.owner.size(); ++face)
        for (std::uint32_t i = polyhedra.face_begin[face]; i < polyhedra.face_begin[face + 1]; ++i)
            boundary.insert(polyhedra.face_points[i]);
    // A hanging node is held by its masters, which need not lie on the boundary themselves.
    const auto hold_masters = [&](const auto& all) {
        for (const auto& hanging : all)
            if (boundary.erase(hanging.node)) boundary.insert(hanging.masters.begin(), hanging.masters.end());
    };
    hold_masters(mesh.edge_hanging);
    hold_masters(mesh.face_hanging);
    return boundary;
}

/// The displacements that CalculiX finds when these nodes follow a linear field, per node.
std::map<mesh::NodeIndex, Vec3> solve_patch_test(const mesh::HexMesh& mesh,
                                                 const std::set<mesh::NodeIndex>& boundary,
                                                 const Affine& field) {
    std::string tail = "*MATERIAL,NAME=STEEL\n*ELASTIC\n210000.,0.3\n";
    std::set<std::string> sets;
    for (const auto& set : mesh.sets)
        if (!set.inside.empty() || !set.boundary.empty()) sets.insert("SOLID_0");
    for (const std::string& set : sets) tail += "*SOLID SECTION,ELSET=" + set + ",MATERIAL=STEEL\n";
    tail += "*STEP\n*STATIC\n*BOUNDARY\n";
    std::array<char, 80> line;
    for (const mesh::NodeIndex node : boundary) {
        if (node >= mesh.node_count()) continue;
        const Vec3 u = field(mesh.position(node));
        for (int axis = 0; axis < 3; ++axis) {
            std::snprintf(line.data(), line.size(), "%u,%d,%d,%.12g\n", node + 1, axis + 1, axis + 1,
                          u[axis]);
            tail += line.data();
        }
    }
    tail += "*NODE PRINT,NSET=ALL\nU\n*END STEP\n";
    const Folder folder;
    EXPECT_TRUE(io::write_abaqus((folder / "patch.inp").string(), mesh, {.tail = tail}));
    const std::string command = "cd '" + folder.string() + "' && OMP_NUM_THREADS=1 ccx patch > log 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << text_of(folder / "log");
    std::map<mesh::NodeIndex, Vec3> found;
    std::ifstream file(folder / "patch.dat");
    for (std::string text; std::getline(file, text);) {
        std::stringstream fields(text);
        unsigned node = 0;
        Vec3 u;
        if (fields >> node >> u.x >> u.y >> u.z) found[node - 1] = u;
    }
    return found;
}

TEST(WriteAbaqus, PassesThePatchTestInCalculix) {
    if (!is_installed("ccx")) GTEST_SKIP() << "CalculiX (ccx) is not installed";
    const mesh::Mesh solid = mesh::icosphere(1, 8);
    Options options{.precision = 0.25};
    options.boxes = {{{{-1, -1, -1}, {0.1, 0.1, 0.1}}, 0.0625}};
    const Result<Built> built = build(std::span(&solid, 1), options);
    ASSERT_TRUE(built);
    ASSERT_GT(built->mesh.hanging_nodes(), 100u);
    // The file holds seven digits. Coordinates are multiples of 1/16, so these displacements have no more, and where a
    // component is zero the file shows errors down to 1e-300.
    Affine field;
    field.m = {{{0, 1e-3, 2e-3, 0}, {3e-3, 0, -1e-3, 0}, {1e-3, 4e-3, 0, 0}}};
    const std::set<mesh::NodeIndex> boundary = boundary_nodes(built->mesh);
    const auto found = solve_patch_test(built->mesh, boundary, field);
    ASSERT_EQ(found.size(), built->mesh.nodes.size());
    double worst = 0, worst_at_zero = 0;
    int zeros = 0;
    for (const auto& [node, u] : found) {
        const Vec3 expected = field(built->mesh.position(node));
        for (int axis = 0; axis < 3; ++axis) {
            const double error = std::fabs(u[axis] - expected[axis]);
            worst = std::max(worst, error);
            if (expected[axis] != 0) continue;
            ++zeros;
            worst_at_zero = std::max(worst_at_zero, error);
        }
    }
    constexpr double largest_displacement = 5e-3;
    EXPECT_LE(worst, 1e-9 * largest_displacement);
    EXPECT_LE(worst_at_zero, 1e-12 * largest_displacement);
    EXPECT_GT(zeros, 50);

    // Without the equations the same test fails, so it can fail.
    mesh::HexMesh cracked = built->mesh;
    cracked.edge_hanging.clear();
    cracked.face_hanging.clear();
    double crack = 0;
    for (const auto& [node, u] : solve_patch_test(cracked, boundary, field))
        crack = std::max(crack, length(u - field(cracked.position(node))));
    EXPECT_GT(crack, 1e-6);
}

TEST(WriteAbaqus, PassesThePatchTestOnAFittedMeshWithALayer) {
    if (!is_installed("ccx")) GTEST_SKIP() << "CalculiX (ccx) is not installed";
    const Built built = fitted_ball();
    const mesh::HexMesh& mesh = built.mesh;
    std::set<mesh::NodeIndex> boundary;
    for (const mesh::HexSide& side : mesh::boundary_sides(mesh).sides)
        boundary.insert(side.corners.begin(), side.corners.end());
    for (const auto& h : mesh.edge_hanging)
        if (boundary.erase(h.node)) boundary.insert(h.masters.begin(), h.masters.end());
    Affine field;
    field.m = {{{0, 1e-3, 2e-3, 0}, {3e-3, 0, -1e-3, 0}, {1e-3, 4e-3, 0, 0}}};
    const auto worst = [&](const mesh::HexMesh& solved) {
        const auto found = solve_patch_test(solved, boundary, field);
        EXPECT_EQ(found.size(), mesh.node_count());
        double error = 0;
        for (const auto& [node, u] : found) error = std::max(error, length(u - field(mesh.position(node))));
        return error;
    };
    // The file holds seven digits of displacements up to 5e-3.
    EXPECT_LE(worst(mesh), 1e-9);
    mesh::HexMesh cracked = mesh;
    cracked.edge_hanging.clear();
    EXPECT_GT(worst(cracked), 1e-6);
}

TEST(WriteLeafList, HasOneLineACell) {
    const Built built = graded_mesh();
    const Folder folder;
    ASSERT_TRUE(io::write_leaf_list((folder / "leaves.csv").string(), built.mesh));
    std::ifstream file(folder / "leaves.csv");
    std::size_t cell = 0;
    double side = 0;
    Vec3 origin;
    for (std::string line; std::getline(file, line);) {
        std::stringstream fields(line);
        std::string hash, word;
        if (line[0] == '#') {
            fields >> hash >> word;
            if (word == "side") fields >> side;
            if (word == "origin") fields >> origin.x >> origin.y >> origin.z;
            continue;
        }
        if (line[0] == 'x') continue;
        std::array<double, 5> value{};
        char comma = 0;
        for (double& v : value) fields >> v >> comma;
        const double step = side / std::exp2(value[3]);
        const Vec3 low = origin + Vec3{value[0] * step, value[1] * step, value[2] * step};
        ASSERT_EQ(low, built.mesh.position(built.mesh.corners[cell][0]));
        ASSERT_EQ(value[4], built.mesh.set_of_cell[cell]);
        ++cell;
    }
    EXPECT_EQ(cell, built.mesh.cells.size());
}

TEST(WriteP8est, HasTheFieldsThatP4estReads) {
    const mesh::Mesh solid =
        mesh::cube(2);  // tests/p4est has p4est read such files; this test needs no p4est
    Options options{.precision = 0.5, .largest = 0.5};
    options.boxes = {{{{0, 0, 0}, {0.5, 0.5, 0.5}}, 0.25}};
    const Result<Built> built = build(std::span(&solid, 1), options);
    ASSERT_TRUE(built);
    const Folder folder;
    for (const int root_level : {19, 30}) {
        const auto written =
            io::write_p8est((folder / "m.p8est").string(), built->mesh, {.root_level = root_level});
        ASSERT_TRUE(written);
        const std::string file = text_of(folder / "m.p8est");
        constexpr std::size_t header = 384 + 64, record = 20;
        const auto word = [&](std::size_t at) {
            std::int32_t value = 0;
            std::memcpy(&value, file.data() + at, sizeof value);
            return value;
        };
        EXPECT_EQ(file.substr(0, 6), std::string("p8est\0", 6));
        const auto leaves = static_cast<std::size_t>(word(header - 8));
        ASSERT_EQ(file.size(), header + record * leaves);
        double filled = 0;
        std::size_t cells = 0;
        for (std::size_t leaf = 0; leaf < leaves; ++leaf) {
            const std::size_t at = header + record * leaf;
            const std::int32_t level = word(at + 12), side = 1 << (root_level - level);
            for (std::size_t axis = 0; axis < 3; ++axis) ASSERT_EQ(word(at + 4 * axis) % side, 0);
            filled += std::pow(0.125, level);
            if (word(at + 16) == -1) continue;
            ASSERT_EQ(level, built->mesh.cells[cells].level());
            ASSERT_EQ(word(at + 16), built->mesh.set_of_cell[cells++]);
        }
        EXPECT_EQ(filled, 1) << "a complete tree";
        EXPECT_EQ(cells, built->mesh.cells.size());
    }
    mesh::HexMesh deep;
    deep.cells = {octree::CellKey::at({1, 1, 1}, 19)};
    deep.corners.resize(1), deep.sets.resize(1), deep.set_of_cell.resize(1);
    const auto refused = io::write_p8est((folder / "d.p8est").string(), deep);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::limit);
    EXPECT_TRUE(io::write_p8est((folder / "d.p8est").string(), deep, {.root_level = 30}));
}

}  // namespace
}  // namespace octavo::hexmesh
