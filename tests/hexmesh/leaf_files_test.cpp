// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include <octavo/io/leaf_list.hpp>
#include <octavo/io/p8est.hpp>

#include "hexmesh/folder.hpp"
#include "hexmesh/written_meshes.hpp"

// Files of leaves, for codes that make the octree again.

namespace octavo::hexmesh {
namespace {

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
