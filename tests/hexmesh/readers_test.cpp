// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include <octavo/hexmesh/build.hpp>
#include <octavo/hexmesh/conforming.hpp>
#include <octavo/hexmesh/to_octree.hpp>
#include <octavo/io/abaqus.hpp>
#include <octavo/io/gmsh.hpp>
#include <octavo/io/hex_mesh_vtu.hpp>
#include <octavo/io/mfem.hpp>
#include <octavo/mesh/hex_sides.hpp>
#include <octavo/mesh/shapes.hpp>

#include "hexmesh/folder.hpp"

// Files of hexahedral meshes, read again by programs that are not ours: meshio for Abaqus, Gmsh and VTU, MFEM itself
// (PyMFEM) for its format. Tests skip where a reader is not installed; OCTAVO_PYTHON names a Python that has them.

namespace octavo::hexmesh {
namespace {

/// A Python that can import the module, or "".
std::string python_with(const std::string& module) {
    const char* const chosen = std::getenv("OCTAVO_PYTHON");
    for (const std::string& python :
         {std::string(chosen ? chosen : ""), std::string("python3"), std::string("/usr/bin/python3")})
        if (!python.empty() &&
            std::system((python + " -c 'import " + module + "' > /dev/null 2>&1").c_str()) == 0)
            return python;
    return {};
}

/// What a script prints about a file.
std::string answer(const std::string& python, const Folder& folder, const std::string& file,
                   const std::string& script) {
    std::ofstream((folder / "script.py").string()) << script;
    const std::string command = python + " '" + (folder / "script.py").string() + "' '" +
                                (folder / file).string() + "' > '" + (folder / "out").string() + "' 2>&1";
    const int status = std::system(command.c_str());
    std::ifstream out((folder / "out").string());
    std::stringstream text;
    text << out.rdbuf();
    EXPECT_EQ(status, 0) << text.str();
    return text.str();
}

double volume_of(const mesh::HexMesh& mesh) {
    double volume = 0;
    for (const octree::CellKey cell : mesh.cells) volume += std::pow(mesh.lattice.unit() * cell.side(), 3);
    return volume;
}

/// Two balls that overlap, with hanging nodes.
Built two_balls() {
    mesh::Mesh second = mesh::icosphere(1, 8);
    for (Vec3& vertex : second.vertices) vertex.x += 1.3;
    const std::vector<mesh::Mesh> solids{mesh::icosphere(1, 8), second};
    Result<Built> built = build(solids, {.precision = 0.13});
    EXPECT_TRUE(built);
    EXPECT_GT(built->mesh.hanging_nodes(), 100u);
    return std::move(*built);
}

// Cells, points, the volume by tetrahedra round a diagonal, and the names of groups.
constexpr const char* meshio_script = R"(
import sys, meshio, numpy
m = meshio.read(sys.argv[1])
h = numpy.concatenate([c.data for c in m.cells if c.type == 'hexahedron'])
p = m.points[h]
v = 0
for a, b in ((1, 2), (2, 3), (3, 7), (7, 4), (4, 5), (5, 1)):
    v += numpy.einsum('ij,ij->i', p[:, a] - p[:, 0], numpy.cross(p[:, b] - p[:, 0], p[:, 6] - p[:, 0])) / 6
quads = sum(len(c.data) for c in m.cells if c.type == 'quad')
names = sorted(n for n in set(list(m.field_data) + list(m.cell_sets)) if not n.startswith('gmsh:'))
print(len(h), len(m.points), len(numpy.unique(h)), repr(float(v.sum())), bool((v > 0).all()), quads, '|'.join(names))
)";

struct Seen {
    std::size_t cells = 0, points = 0, used = 0, quads = 0;
    double volume = 0;
    std::string positive, names;
};

Seen seen_by_meshio(const std::string& python, const Folder& folder, const std::string& file) {
    std::stringstream text(answer(python, folder, file, meshio_script));
    Seen seen;
    text >> seen.cells >> seen.points >> seen.used >> seen.volume >> seen.positive >> seen.quads >>
        seen.names;
    return seen;
}

TEST(Meshio, ReadsAbaqusAndVtuFiles) {
    const std::string python = python_with("meshio");
    if (python.empty()) GTEST_SKIP() << "meshio is not installed";
    const Built built = two_balls();
    const Folder folder;
    ASSERT_TRUE(io::write_abaqus((folder / "m.inp").string(), built.mesh));
    std::vector<double> quality(built.mesh.cell_count(), 1);
    const io::CellData more{"quality", quality};
    ASSERT_TRUE(io::write_vtu((folder / "m.vtu").string(), built.mesh, std::span(&more, 1)));
    for (const char* file : {"m.inp", "m.vtu"}) {
        const Seen seen = seen_by_meshio(python, folder, file);
        EXPECT_EQ(seen.cells, built.mesh.cell_count()) << file;
        EXPECT_EQ(seen.points, built.mesh.node_count()) << file;
        EXPECT_EQ(seen.used, built.mesh.node_count()) << file;
        EXPECT_EQ(seen.positive, "True") << file;
        EXPECT_NEAR(seen.volume / volume_of(built.mesh), 1, 1e-12) << file;
    }
    const Seen abaqus = seen_by_meshio(python, folder, "m.inp");
    for (const char* set : {"SOLID_0", "SOLID_1", "SOLID_0_AND_SOLID_1"})
        EXPECT_NE(abaqus.names.find(set), std::string::npos) << abaqus.names;
}

TEST(Meshio, ReadsGmshFiles) {
    const std::string python = python_with("meshio");
    if (python.empty()) GTEST_SKIP() << "meshio is not installed";
    const mesh::Mesh solid = mesh::icosphere(1, 8);
    Options options{.precision = 0.2};
    options.boxes = {{{{0.3, 0, 0}, {0.5, 0.2, 0.2}}, 0.06}};
    const Result<Built> built = build_conforming(std::span(&solid, 1), options);
    ASSERT_TRUE(built);
    const Folder folder;
    const std::string names[] = {"ball"};
    ASSERT_TRUE(io::write_gmsh((folder / "m.msh").string(), built->mesh, names));
    const Seen seen = seen_by_meshio(python, folder, "m.msh");
    EXPECT_EQ(seen.cells, built->mesh.cell_count());
    EXPECT_EQ(seen.points, built->mesh.node_count());
    EXPECT_EQ(seen.quads, mesh::boundary_sides(built->mesh).sides.size());
    EXPECT_EQ(seen.positive, "True");
    EXPECT_EQ(seen.names, "ball");

    const Built hanging = two_balls();
    const auto refused = io::write_gmsh((folder / "n.msh").string(), hanging.mesh);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::unsupported);
}

// True degrees of freedom, and whether a linear function is reproduced across hanging vertices: its values at those
// that do not hang, prolonged by MFEM's own constraints, must be its values everywhere.
constexpr const char* mfem_script = R"(
import sys, mfem.ser as mfem, numpy
mesh = mfem.Mesh(sys.argv[1])
fec = mfem.H1_FECollection(1, 3)
space = mfem.FiniteElementSpace(mesh, fec)
x = mfem.GridFunction(space)
for i in range(mesh.GetNV()):
    p = mesh.GetVertexArray(i)
    x[i] = 2 * p[0] - 3 * p[1] + 5 * p[2] + 1
exact = x.GetDataArray().copy()
true = mfem.Vector()
x.GetTrueDofs(true)
x.SetFromTrueDofs(true)
error = float(numpy.abs(x.GetDataArray() - exact).max())
volume = sum(mesh.GetElementVolume(i) for i in range(mesh.GetNE()))
print(mesh.GetNE(), mesh.GetNV(), space.GetTrueVSize(), repr(volume), repr(error), mesh.attributes.Size())
)";

TEST(Mfem, ReadsItsFilesAndMakesTheSameConstraints) {
    const std::string python = python_with("mfem.ser");
    if (python.empty()) GTEST_SKIP() << "PyMFEM (pip install mfem) is not installed";
    const Built built = two_balls();
    const Folder folder;
    const auto written = io::write_mfem((folder / "m.mesh").string(), built.mesh);
    ASSERT_TRUE(written) << written.error().describe();
    std::stringstream text(answer(python, folder, "m.mesh", mfem_script));
    std::size_t elements = 0, vertices = 0, freedoms = 0, attributes = 0;
    double volume = 0, error = 1;
    text >> elements >> vertices >> freedoms >> volume >> error >> attributes;
    EXPECT_EQ(elements, built.mesh.cell_count());
    EXPECT_EQ(vertices, built.mesh.node_count());
    EXPECT_EQ(freedoms, built.mesh.node_count() - built.mesh.hanging_nodes());
    EXPECT_NEAR(volume / volume_of(built.mesh), 1, 1e-12);
    EXPECT_LT(error, 1e-13);
    EXPECT_EQ(attributes, 3u);
}

TEST(WriteMfem, RefusesSidesThatAreCoveredInPart) {
    const mesh::Mesh solid = mesh::icosphere(1, 8);
    Options options{.precision = 0.25};
    options.boxes = {{{{-1, -1, -1}, {0.1, 0.1, 0.1}}, 0.0625}};
    const Result<Built> built = build(std::span(&solid, 1), options);
    ASSERT_TRUE(built);
    const Folder folder;
    const auto refused = io::write_mfem((folder / "m.mesh").string(), built->mesh);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::unsupported);
    options.keep = Keep::all;
    const Result<Built> whole = build(std::span(&solid, 1), options);
    ASSERT_TRUE(whole);
    EXPECT_TRUE(io::write_mfem((folder / "m.mesh").string(), whole->mesh));
}

TEST(ToOctree, HasACellForEachLeaf) {
    const Built built = two_balls();
    const octree::Octree tree = to_octree(built.mesh);
    std::size_t next = 0;
    tree.for_each_leaf([&](octree::CellKey key, octree::Color color) {
        if (next < built.mesh.cells.size() && key == built.mesh.cells[next]) {
            const mesh::SolidSet& set = built.mesh.set_of(static_cast<mesh::CellIndex>(next++));
            EXPECT_EQ(color, set.boundary.empty() ? octree::Color::black : octree::Color::gray);
        } else {
            EXPECT_EQ(color, octree::Color::white);
        }
    });
    EXPECT_EQ(next, built.mesh.cells.size());
}

}  // namespace
}  // namespace octavo::hexmesh
