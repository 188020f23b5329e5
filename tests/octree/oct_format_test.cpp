// SPDX-License-Identifier: Apache-2.0
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <octavo/octree/oct_format.hpp>

namespace octavo::octree {
namespace {

using Bytes = std::vector<std::uint8_t>;

Octree octree_of(const std::vector<Node>& nodes, int depth) {
    DfCode code;
    for (const Node node : nodes) code.append(node);
    return {*exact::Lattice::from_parts(-20, {-5, 7, std::int64_t{1} << 40}), depth, code};
}

void grow(std::mt19937& random, std::vector<Node>& nodes, int depth) {
    const bool split = depth > 0 && random() % 4 != 0;
    nodes.push_back(split ? Node::split : static_cast<Node>(random() % 3));
    for (int i = 0; split && i < 8; ++i) grow(random, nodes, depth - 1);
}

Octree random_octree(unsigned seed) {
    std::mt19937 random(seed);
    std::vector<Node> nodes;
    grow(random, nodes, 4);
    return octree_of(nodes, 4);
}

// Writes the checksum as a plain loop computes it, so that what lies behind it gets tested.
Bytes with_checksum(Bytes bytes) {
    for (std::size_t i = 20; i < 24; ++i) bytes[i] = 0;
    std::uint32_t crc = 0xFFFFFFFFU;
    for (const std::uint8_t byte : bytes) {
        crc ^= byte;
        for (int bit = 0; bit < 8; ++bit) crc = crc & 1 ? crc >> 1 ^ 0xEDB88320U : crc >> 1;
    }
    crc = ~crc;
    for (std::size_t i = 0; i < 4; ++i) bytes[20 + i] = static_cast<std::uint8_t>(crc >> (8 * i));
    return bytes;
}

TEST(OctFormat, GivesBackTheSameOctreeAndTheSameBytes) {
    for (unsigned seed = 0; seed < 50; ++seed) {
        const Octree octree = random_octree(seed);
        const Bytes bytes = encode(octree);
        const Result<Octree> back = decode(bytes);
        ASSERT_TRUE(back) << back.error().describe();
        EXPECT_EQ(*back, octree);
        EXPECT_EQ(encode(*back), bytes);
        EXPECT_EQ(with_checksum(bytes), bytes);
        EXPECT_LE(bytes.size(), 64 + octree.code().size() / 4 + 1);
    }
}

TEST(OctFormat, WritesTheExampleOfItsDocumentation) {
    const Bytes bytes = encode(octree_of({Node::split, Node::black, Node::white, Node::white, Node::white,
                                          Node::white, Node::white, Node::white, Node::white},
                                         1));
    EXPECT_EQ(Bytes(bytes.begin(), bytes.begin() + 20),
              (Bytes{0x89, 'O', 'C', 'T', 13, 10, 26, 10, 1, 0, 0, 0, 1, 0, 0, 0, 0xEC, 0xFF, 0xFF, 0xFF}));
    EXPECT_EQ(Bytes(bytes.begin() + 24, bytes.begin() + 32),
              (Bytes{0xFB, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF}));
    EXPECT_EQ(Bytes(bytes.begin() + 48, bytes.begin() + 56), (Bytes{9, 0, 0, 0, 0, 0, 0, 0}));
    EXPECT_EQ(Bytes(bytes.begin() + 64, bytes.end()), (Bytes{7, 0, 0}));
}

TEST(OctFormat, RefusesEveryTruncationAndEveryTrailingByte) {
    const Bytes bytes = encode(random_octree(3));
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        const Bytes cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
        ASSERT_FALSE(decode(cut)) << size;
        if (size >= 64) {
            ASSERT_FALSE(decode(with_checksum(cut))) << size;
        }
    }
    Bytes longer = bytes;
    longer.push_back(0);
    EXPECT_FALSE(decode(longer));
    EXPECT_FALSE(decode(with_checksum(longer)));
}

TEST(OctFormat, NoticesEveryFlippedBit) {
    const Bytes bytes = encode(random_octree(5));
    for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
        Bytes damaged = bytes;
        damaged[bit / 8] ^= static_cast<std::uint8_t>(1 << bit % 8);
        ASSERT_FALSE(decode(damaged)) << bit;
    }
}

TEST(OctFormat, RefusesLyingHeadersWhoseChecksumAgrees) {
    const Bytes bytes = encode(random_octree(6));
    const auto refused = [&](std::size_t at, Bytes values) {
        Bytes changed = bytes;
        std::copy(values.begin(), values.end(), changed.begin() + static_cast<std::ptrdiff_t>(at));
        return !decode(with_checksum(changed));
    };
    EXPECT_TRUE(refused(8, {2})) << "version";
    EXPECT_TRUE(refused(12, {22})) << "depth";
    EXPECT_TRUE(refused(12, {1})) << "depth less than the tree's";
    EXPECT_TRUE(refused(15, {0x80})) << "depth";
    EXPECT_TRUE(refused(19, {0x7F})) << "exponent";
    EXPECT_TRUE(refused(31, {0x40})) << "origin";
    EXPECT_TRUE(refused(48, {0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF})) << "node count";
    EXPECT_TRUE(refused(60, {1})) << "reserved";
    Bytes trailing = encode(octree_of({Node::black}, 0));
    trailing.back() |= 4;
    EXPECT_FALSE(decode(with_checksum(trailing))) << "unused bits";
    EXPECT_EQ(decode(with_checksum([&] {
                  Bytes newer = bytes;
                  newer[8] = 2;
                  return newer;
              }()))
                  .error()
                  .code,
              ErrorCode::unsupported);
}

TEST(OctFormat, SurvivesRandomBytesBehindAGoodHeader) {
    std::mt19937 random(11);
    const Bytes bytes = encode(random_octree(7));
    int accepted = 0;
    for (int round = 0; round < 2000; ++round) {
        Bytes noisy = bytes;
        for (int change = 0; change < 3; ++change)
            noisy[64 + random() % (noisy.size() - 64)] = static_cast<std::uint8_t>(random());
        const Result<Octree> octree = decode(with_checksum(noisy));
        if (!octree) continue;
        ++accepted;
        ASSERT_TRUE(octree->validate());
        ASSERT_EQ(encode(*octree), with_checksum(noisy));
    }
    EXPECT_GT(accepted, 0);
}

}  // namespace
}  // namespace octavo::octree
