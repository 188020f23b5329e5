// SPDX-License-Identifier: Apache-2.0
#include "models.hpp"

#include <algorithm>

#include <octavo/bsp_octree/bso_format.hpp>
#include <octavo/classic/closed_surface.hpp>
#include <octavo/exact/orient.hpp>
#include <octavo/io/read.hpp>
#include <octavo/io/write.hpp>
#include <octavo/mesh/snap.hpp>

#include "bsp_octree/solid_cases.hpp"
#include "effort.hpp"

// Every closed model that is there goes into a BSP-octree and comes back: the same volume as an integer, nothing that
// is not in both, all vertices those of the input and all facets in its planes, and a .bso file no larger than 1.5
// times its binary PLY.

namespace octavo::bsp_octree {
namespace {

/// Triangles of the largest model that is tried; with OCTAVO_TEST_EFFORT = 50 all are, which takes some ten minutes.
std::size_t most_triangles() { return 7000u * static_cast<std::size_t>(tests::effort()); }

std::vector<std::string> model_names() {
    std::vector<std::string> names;
    const std::filesystem::path root = tests::models_folder();
    for (const char* folder : {"classic", "mechanical"}) {
        if (!std::filesystem::exists(root / folder)) continue;
        for (const auto& entry : std::filesystem::directory_iterator(root / folder))
            names.push_back(folder + ("/" + entry.path().filename().string()));
    }
    std::sort(names.begin(), names.end());
    return names;
}

std::size_t bytes_of_ply(const mesh::Mesh& mesh) {
    const Result<io::WrittenBytes> written = io::write_mesh(mesh, {.format = "ply"});
    EXPECT_TRUE(written);
    return written ? written->bytes.size() : 0;
}

/// What separates inside from outside comes back as it was, however it was cut.
void expect_back(const std::string& name, const mesh::Mesh& mesh, const mesh::LatticeMesh& snapped,
                 const Built& built) {
    const Result<ToMesh> back = to_mesh(built.octree);
    ASSERT_TRUE(back) << name << ": " << back.error().describe();
    EXPECT_EQ(tests::manifold_defect(back->mesh), "") << name;
    const Result<mesh::Snapped> again = mesh::snap(back->mesh, snapped.lattice);
    ASSERT_TRUE(again) << name;
    EXPECT_EQ(again->report.moved_vertices, 0U) << name << ": vertices are vertices of the input";
    EXPECT_TRUE(mesh::exact_volume6(again->mesh) == mesh::exact_volume6(snapped)) << name;
    bsp::PlaneTable planes;
    const auto count_with = [&](const mesh::LatticeMesh& part) {
        for (const auto& [a, b, c] : part.triangles)
            if (!exact::collinear(part.points[a], part.points[b], part.points[c]))
                planes.add(part.points[a], part.points[b], part.points[c]);
        return planes.size();
    };
    const std::size_t of_input = count_with(snapped);
    EXPECT_EQ(count_with(again->mesh), of_input) << name << ": facets lie in planes of the input";
    const Result<Built> second = build(back->mesh, snapped.lattice, {}, {}, built.octree.shared_store());
    ASSERT_TRUE(second) << name;
    tests::expect_same(built.octree, second->octree, name);
    EXPECT_LE(2 * encode(built.octree).size(), 3 * bytes_of_ply(mesh)) << name;
}

TEST(Models, ComeBackExactly) {
    const std::vector<std::string> names = model_names();
    if (names.empty()) GTEST_SKIP() << "there are no models on this machine (set OCTAVO_MODELS)";
    int tried = 0;
    for (const std::string& name : names) {
        Result<io::ReadMesh> read = io::read_mesh((tests::models_folder() / name).string());
        if (!read || read->mesh.triangles.size() > most_triangles()) continue;
        const Result<mesh::Snapped> snapped = mesh::snap(read->mesh);
        ASSERT_TRUE(snapped) << name;
        if (!classic::open_edges(snapped->mesh).empty()) continue;
        const Result<Built> built = build(read->mesh, snapped->mesh.lattice);
        ASSERT_TRUE(built) << name << ": " << built.error().describe();
        if (built->report.resolved) continue;
        expect_back(name, read->mesh, snapped->mesh, *built);
        ++tried;
    }
    EXPECT_GE(tried, 5);
    RecordProperty("models", tried);
    std::printf("%d closed models came back\n", tried);
}

}  // namespace
}  // namespace octavo::bsp_octree
