// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include <octavo/hexmesh/to_polyhedra.hpp>
#include <octavo/io/abaqus.hpp>
#include <octavo/mesh/hex_sides.hpp>

#include "hexmesh/folder.hpp"
#include "hexmesh/written_meshes.hpp"

// Abaqus files: numbers as CalculiX reads them, sets of nodes, and constraints that CalculiX solves with.

namespace octavo::hexmesh {
namespace {

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

}  // namespace
}  // namespace octavo::hexmesh
