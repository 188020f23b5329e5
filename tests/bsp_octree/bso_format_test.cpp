// SPDX-License-Identifier: Apache-2.0
#include <random>

#include <octavo/bsp_octree/bso_file.hpp>
#include <octavo/bsp_octree/bso_format.hpp>
#include <octavo/mesh/shapes.hpp>

#include "bsp_octree/solid_cases.hpp"
#include "effort.hpp"
#include "io/folder.hpp"

namespace octavo::bsp_octree {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Sets the checksum right again, so that what is behind it is tested.
void seal(Bytes& bytes) {
    for (std::size_t i = 16; i < 20; ++i) bytes[i] = 0;
    std::uint32_t crc = 0xFFFFFFFFU;
    for (const std::uint8_t byte : bytes) {
        crc ^= byte;
        for (int bit = 0; bit < 8; ++bit) crc = crc & 1 ? crc >> 1 ^ 0xEDB88320U : crc >> 1;
    }
    for (std::size_t i = 0; i < 4; ++i) bytes[16 + i] = static_cast<std::uint8_t>(~crc >> (8 * i));
}

TEST(BsoFormat, BringsSolidsBack) {
    const BspOctree ball = tests::octree_of(mesh::icosphere(3, 8)), gear = tests::octree_of(mesh::gear());
    const BspOctree cube = tests::octree_of(mesh::cube(4), tests::fine(1));
    for (const BspOctree& solid :
         {ball, gear, cube, *gear.subtract(ball), *ball.unite(cube)->subtract(gear), ball.complement(),
          BspOctree(tests::small_lattice()), BspOctree(tests::small_lattice()).complement()}) {
        const Bytes bytes = encode(solid);
        const Result<BspOctree> back = decode(bytes);
        ASSERT_TRUE(back) << back.error().describe();
        EXPECT_EQ(encode(*back), bytes) << "the same solid gives the same bytes";
        const Stats before = solid.stats(), after = back->stats();
        EXPECT_EQ(after.bsp_nodes, before.bsp_nodes);
        EXPECT_EQ(after.planes, before.planes);
        EXPECT_EQ(back->store().planes.size(), before.planes) << "planes that nothing uses stay behind";
        EXPECT_EQ(back->options().planes, solid.options().planes);
        // Exactly the same points, and still good for operations.
        tests::expect_same(solid, *back, "read back");
        tests::expect_same(*solid.subtract(cube), *back->subtract(cube), "an operation on what was read");
    }
}

TEST(BsoFormat, IsSmallerThanABinaryPly) {
    const mesh::Mesh ball = mesh::displaced_sphere(20);
    const Result<Built> built = build(ball);
    ASSERT_TRUE(built);
    const std::size_t ply_bytes = 12 * ball.vertices.size() + 13 * ball.triangles.size();
    EXPECT_LT(encode(built->octree).size(), ply_bytes * 3 / 2);
}

TEST(BsoFormat, RefusesEveryTruncation) {
    const Bytes bytes =
        encode(*tests::octree_of(mesh::icosphere(3, 2)).subtract(tests::octree_of(mesh::cube(3))));
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        Bytes part(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
        EXPECT_FALSE(decode(part)) << size;
        if (size < 64) continue;
        seal(part);
        EXPECT_FALSE(decode(part)) << size << " with a good checksum";
    }
    Bytes more = bytes;
    more.push_back(0);
    seal(more);
    EXPECT_FALSE(decode(more));
}

TEST(BsoFormat, NoticesEveryFlippedBit) {
    const Bytes bytes = encode(tests::octree_of(mesh::icosphere(3, 2)));
    for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
        Bytes flipped = bytes;
        flipped[bit / 8] = static_cast<std::uint8_t>(flipped[bit / 8] ^ 1U << bit % 8);
        ASSERT_FALSE(decode(flipped)) << "bit " << bit;
    }
}

TEST(BsoFormat, SurvivesLies) {
    // With a right checksum, flipped bits may give another tree, but never a crash, and what is refused says where.
    const Bytes bytes =
        encode(*tests::octree_of(mesh::icosphere(3, 2)).subtract(tests::octree_of(mesh::cube(3))));
    std::mt19937 random(1);
    int accepted = 0;
    for (int run = 0; run < 3000 * tests::effort(); ++run) {
        Bytes lie = bytes;
        for (int i = std::uniform_int_distribution<int>(1, 4)(random); i > 0; --i) {
            const auto bit = std::uniform_int_distribution<std::size_t>(0, 8 * bytes.size() - 1)(random);
            lie[bit / 8] = static_cast<std::uint8_t>(lie[bit / 8] ^ 1U << bit % 8);
        }
        seal(lie);
        const Result<BspOctree> read = decode(lie);
        accepted += read.has_value();
        if (!read)
            EXPECT_NE(read.error().place.byte, Place::no_byte);
        else
            static_cast<void>(to_mesh(*read));  // a mesh or an error
    }
    EXPECT_LT(accepted, 3000 * tests::effort());
}

TEST(BsoFile, IsWrittenAndRead) {
    const io::Folder folder;
    const std::string path = folder / "ball.bso";
    const BspOctree ball = tests::octree_of(mesh::icosphere(3, 4));
    ASSERT_TRUE(write_bso(path, ball));
    const Result<BspOctree> read = read_bso(path);
    ASSERT_TRUE(read);
    tests::expect_same(ball, *read, "file");
    const Result<BspOctree> missing = read_bso(folder / "none.bso");
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().code, ErrorCode::io);
}

}  // namespace
}  // namespace octavo::bsp_octree
