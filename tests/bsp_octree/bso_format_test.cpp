// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <atomic>
#include <random>

#include <octavo/bsp_octree/bso_file.hpp>
#include <octavo/bsp_octree/bso_format.hpp>
#include <octavo/mesh/shapes.hpp>

#include "bsp_octree/bso_bytes.hpp"
#include "bsp_octree/solid_cases.hpp"
#include "effort.hpp"
#include "io/folder.hpp"

namespace octavo::bsp_octree {
namespace {

using Bytes = tests::FileBytes;

/// A solid whose file has several blocks.
const BspOctree& rough_ball() {
    static const BspOctree ball = tests::octree_of(mesh::displaced_sphere(14));
    return ball;
}

/// Delivers bytes in pieces of `step` at most, and counts them.
struct Pipe {
    Bytes bytes;
    std::size_t step, delivered = 0;

    ByteSource source() {
        return [this](std::span<std::uint8_t> room) -> Result<std::size_t> {
            const std::size_t given = std::min({step, room.size(), bytes.size() - delivered});
            std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(delivered), given, room.begin());
            delivered += given;
            return given;
        };
    }
};

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

TEST(BsoFormat, IsReadFromThePieceThatAPipeDelivers) {
    const Bytes bytes = encode(rough_ball());
    ASSERT_GT(bytes.size(), 2 * tests::bso_block_bytes);
    for (const std::size_t step : {1, 3, 4096, 1 << 20}) {
        Pipe pipe{bytes, step};
        const Result<BspOctree> back = decode(pipe.source());
        ASSERT_TRUE(back) << step << ": " << back.error().describe();
        EXPECT_EQ(encode(*back), bytes) << step;
    }
}

TEST(BsoFormat, IsRefusedAsSoonAsABlockIsWrong) {
    const Bytes bytes = encode(rough_ball());
    constexpr std::size_t first = tests::bso_header_bytes + 4, second = first + tests::bso_block_bytes + 8;
    const struct {
        std::size_t flipped, refused_at, least_read, most_read;
    } cases[] = {{30, 52, 56, 56},                                // the header
                 {second + 500, second, second, second + 20000},  // within a block
                 {second - 2, first, second, second},             // its checksum
                 {second + 3, second, second + 4, second + 4}};   // its length
    for (const auto& [flipped, refused_at, least_read, most_read] : cases) {
        Pipe pipe{bytes, 1};
        pipe.bytes[flipped] ^= 64;
        const Result<BspOctree> back = decode(pipe.source());
        ASSERT_FALSE(back) << flipped;
        EXPECT_EQ(back.error().code, ErrorCode::bad_input) << flipped;
        EXPECT_EQ(back.error().place.byte, refused_at) << flipped << ' ' << back.error().describe();
        EXPECT_GE(pipe.delivered, least_read) << flipped;
        EXPECT_LE(pipe.delivered, most_read) << flipped << ": what comes after is not waited for";
    }
}

TEST(BsoFormat, NoticesBlocksThatAreMissingOrExchanged) {
    const Bytes bytes = encode(rough_ball());
    constexpr std::ptrdiff_t first = tests::bso_header_bytes + 4, block = tests::bso_block_bytes + 8;
    Bytes missing = bytes;
    missing.erase(missing.begin() + first, missing.begin() + first + block);
    EXPECT_EQ(decode(missing).error().place.byte, static_cast<std::uint64_t>(first));
    Bytes exchanged = bytes;
    std::swap_ranges(exchanged.begin() + first, exchanged.begin() + first + block,
                     exchanged.begin() + first + block);
    EXPECT_EQ(decode(exchanged).error().place.byte, static_cast<std::uint64_t>(first));
}

TEST(BsoFormat, PassesOnWhatStopsTheSource) {
    Pipe pipe{encode(rough_ball()), 100};
    const Result<BspOctree> broken = decode([&](std::span<std::uint8_t> room) -> Result<std::size_t> {
        if (pipe.delivered > 20000) return Error{ErrorCode::io, "the line is dead", {}};
        return pipe.source()(room);
    });
    EXPECT_EQ(broken.error().code, ErrorCode::io);
    std::atomic<bool> cancel{false};
    Context context;
    context.cancel = &cancel;
    Pipe again{pipe.bytes, 100};
    const Result<BspOctree> stopped = decode(
        [&](std::span<std::uint8_t> room) {
            cancel = again.delivered > 20000;
            return again.source()(room);
        },
        context);
    EXPECT_EQ(stopped.error().code, ErrorCode::cancelled);
}

TEST(BsoFormat, RefusesEveryTruncation) {
    const Bytes bytes =
        encode(*tests::octree_of(mesh::icosphere(3, 2)).subtract(tests::octree_of(mesh::cube(3))));
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        const Result<BspOctree> part = decode(std::span(bytes).first(size));
        ASSERT_FALSE(part) << size;
        // What is no file at all does not begin like one; else the end is what is named.
        EXPECT_EQ(part.error().place.byte, size < 8 ? 0 : size) << part.error().describe();
    }
    const tests::BsoParts whole = tests::bso_parts(bytes);
    for (std::size_t size = 0; size < whole.bits.size(); ++size) {
        tests::BsoParts part = whole;
        part.bits.resize(size);
        EXPECT_FALSE(decode(tests::bso_file(part))) << size << " with good checksums";
    }
    tests::BsoParts more = whole;
    more.bits.push_back(0);
    EXPECT_FALSE(decode(tests::bso_file(more)));
    Bytes longer = bytes;
    longer.push_back(0);
    EXPECT_EQ(decode(longer).error().place.byte, bytes.size());
}

TEST(BsoFormat, RefusesTreesThatSeparateNothing) {
    for (const bsp::Label label : {bsp::Label::out, bsp::Label::in}) {
        const auto store = std::make_shared<Store>();
        const bsp::PlaneId plane = store->planes.add({1, 1, 99}, {9, 1, 99}, {1, 9, 99}).plane();
        store->nodes.push_back({plane, bsp::Child::leaf(label), bsp::Child::leaf(label)});
        const NodeRef root = store->add_leaf(0);
        const Result<BspOctree> read = decode(encode(BspOctree(tests::small_lattice(), {}, store, root)));
        ASSERT_FALSE(read);
        EXPECT_EQ(read.error().code, ErrorCode::bad_input);
        EXPECT_NE(read.error().sentence.find("all over"), std::string::npos) << read.error().sentence;
    }
}

TEST(BsoFormat, RefusesOtherVersions) {
    Bytes bytes = encode(tests::octree_of(mesh::cube()));
    bytes[8] = 1;
    const Result<BspOctree> old = decode(bytes);
    ASSERT_FALSE(old);
    EXPECT_EQ(old.error().code, ErrorCode::unsupported);
    EXPECT_EQ(old.error().place.byte, 8U);
}

TEST(BsoFormat, RefusesOptionsThatNoTreeCanHave) {
    // With no plane in a leaf, the first set operation would subdivide to the last level.
    const tests::BsoParts truth = tests::bso_parts(encode(tests::octree_of(mesh::cube())));
    const struct {
        std::size_t at;
        std::uint8_t value;
        bool is_wrong;
    } cases[] = {{44, 0, true},   {44, 1, false}, {45, 4, true},
                 {47, 255, true}, {40, 27, true}, {48, 2, true}};
    for (const auto& [at, value, is_wrong] : cases) {
        tests::BsoParts lie = truth;
        lie.header[at] = value;
        const Result<BspOctree> read = decode(tests::bso_file(lie));
        ASSERT_EQ(!read, is_wrong) << at << ' ' << int{value};
        if (is_wrong) {
            EXPECT_EQ(read.error().place.byte, at / 4 * 4) << read.error().describe();
        }
    }
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
    // With right checksums, flipped bits may give another tree, but never a crash, and what is refused says where.
    const tests::BsoParts truth = tests::bso_parts(
        encode(*tests::octree_of(mesh::icosphere(3, 2)).subtract(tests::octree_of(mesh::cube(3)))));
    std::mt19937 random(1);
    int accepted = 0;
    for (int run = 0; run < 3000 * tests::effort(); ++run) {
        tests::BsoParts lie = truth;
        const std::size_t all = 8 * (lie.header.size() + lie.bits.size());
        for (int i = std::uniform_int_distribution<int>(1, 4)(random); i > 0; --i) {
            const auto bit = std::uniform_int_distribution<std::size_t>(0, all - 1)(random);
            const std::size_t byte = bit / 8;
            std::uint8_t& at =
                byte < lie.header.size() ? lie.header[byte] : lie.bits[byte - lie.header.size()];
            at = static_cast<std::uint8_t>(at ^ 1U << bit % 8);
        }
        const Bytes file = tests::bso_file(lie);
        const Result<BspOctree> read = decode(file);
        accepted += read.has_value();
        if (!read)
            EXPECT_LE(read.error().place.byte, file.size());
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
