// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstring>

#include <gtest/gtest.h>

#include <octavo/bp_octree/bpo_format.hpp>
#include <octavo/bp_octree/bpo_reader.hpp>
#include <octavo/bp_octree/bpo_view.hpp>
#include <octavo/bp_octree/build.hpp>

#include "bp_octree/solids.hpp"

namespace octavo::bp_octree {
namespace {

/// What a server would see: bytes that are asked for in ranges.
class Server final : public io::ByteSource {
  public:
    struct Log {
        std::size_t requests = 0;
        std::uint64_t bytes = 0;
    };
    Server(std::vector<std::uint8_t> bytes, Log& log) : bytes_(std::move(bytes)), log_(log) {}

    std::uint64_t size() const override { return bytes_.size(); }
    const std::string& name() const override { return name_; }
    Result<io::ByteRange> read(std::uint64_t offset, std::size_t size) override {
        if (offset > bytes_.size() || size > bytes_.size() - offset)
            return Error{ErrorCode::bad_input, "the range is not there", {}};
        ++log_.requests;
        log_.bytes += size;
        io::ByteBlock block(size);
        std::memcpy(block.data(), bytes_.data() + offset, size);
        return io::ByteRange(std::move(block));
    }

  private:
    std::vector<std::uint8_t> bytes_;
    Log& log_;
    std::string name_ = "https://example.org/solid.bpo";
};

/// Large enough for chunks of envelopes beside each other on several levels.
const BpOctree& sample_tree() {
    static const BpOctree tree = [] {
        BuildOptions options;
        options.leaf_triangles = 6;
        options.depth = 7;
        options.quality = Quality::fast;
        options.least_gain = 1e-2;
        return std::move(build(tests::on_lattice(tests::bumpy_sphere(5)), options)).value();
    }();
    return tree;
}
const std::vector<std::uint8_t>& sample_file() {
    static const std::vector<std::uint8_t> bytes = encode(sample_tree());
    return bytes;
}

BpoReader open(Server::Log& log, std::size_t size = sample_file().size()) {
    const auto begin = sample_file().begin();
    auto reader = BpoReader::open(
        std::make_unique<Server>(std::vector(begin, begin + static_cast<std::ptrdiff_t>(size)), log));
    EXPECT_TRUE(reader.has_value());
    return std::move(reader).value();
}

TEST(BpoReader, LevelsAreOneRequestForTheirBytes) {
    const auto to_level = bytes_to_level(sample_file());
    ASSERT_TRUE(to_level.has_value());
    for (int level = 0; level <= sample_tree().deepest(); ++level) {
        Server::Log log;
        BpoReader reader = open(log);
        EXPECT_EQ(reader.bytes_to_level(), *to_level);
        EXPECT_EQ(log.requests, 1U);
        const std::uint64_t before = log.bytes;
        const auto tree = reader.read_levels(level);
        ASSERT_TRUE(tree.has_value());
        const auto expected = decode(sample_file(), {.levels = level});
        ASSERT_TRUE(expected.has_value());
        EXPECT_EQ(tree->nodes, expected->nodes);
        EXPECT_EQ(tree->planes, expected->planes);
        EXPECT_EQ(log.requests, 2U);
        EXPECT_EQ(log.bytes - before, (*to_level)[static_cast<std::size_t>(level)]);
        EXPECT_EQ(reader.bytes_read(), log.bytes);
    }
}

TEST(BpoReader, AllOfAFileIsTheTree) {
    Server::Log log;
    BpoReader reader = open(log);
    EXPECT_FALSE(reader.is_partial());
    const BpoArrived arrived = reader.arrived();
    EXPECT_EQ(arrived.bytes, sample_file().size());
    EXPECT_EQ(arrived.levels, sample_tree().deepest() + 1);
    EXPECT_EQ(arrived.leaves, sample_tree().leaf_count());
    EXPECT_EQ(arrived.triangles, sample_tree().mesh.triangles.size());
    const auto tree = reader.read_all();
    ASSERT_TRUE(tree.has_value());
    EXPECT_EQ(tree->nodes, sample_tree().nodes);
    EXPECT_EQ(tree->mesh.triangles.size(), sample_tree().mesh.triangles.size());
}

TEST(BpoReader, ADownloadThatBrokeOffTellsWhatArrived) {
    const auto to_level = *bytes_to_level(sample_file());
    Server::Log log;
    std::uint64_t triangles = 0;
    bool saw_some_triangles = false;
    for (std::size_t size = to_level[0]; size < sample_file().size(); size += 997) {
        BpoReader reader = open(log, size);
        EXPECT_TRUE(reader.is_partial());
        const BpoArrived arrived = reader.arrived();
        EXPECT_EQ(arrived.bytes, size);
        const auto levels = static_cast<int>(
            std::count_if(to_level.begin(), to_level.end(), [&](std::uint64_t end) { return end <= size; }));
        EXPECT_EQ(arrived.levels, levels);
        EXPECT_GE(arrived.triangles, triangles);
        EXPECT_LT(arrived.triangles, sample_tree().mesh.triangles.size());
        triangles = arrived.triangles;
        saw_some_triangles |= triangles > 0;
        const auto tree = reader.read_levels(max_depth);
        ASSERT_TRUE(tree.has_value());
        EXPECT_EQ(tree->deepest() + 1, levels);
        EXPECT_FALSE(reader.read_all().has_value());
    }
    EXPECT_TRUE(saw_some_triangles);
    BpoReader none = open(log, to_level[0] - 1);
    EXPECT_EQ(none.arrived().levels, 0);
    const auto tree = none.read_levels(0);
    ASSERT_FALSE(tree.has_value());
    EXPECT_EQ(tree.error().place.file, "https://example.org/solid.bpo");
}

TEST(BpoView, ALevelEverywhereIsThatLevel) {
    for (int level = 0; level <= sample_tree().deepest(); ++level) {
        Server::Log log;
        BpoReader reader = open(log);
        const auto view =
            read_view(reader, [&](const octree::Cell& cell, const Box3&) { return cell.level < level; });
        ASSERT_TRUE(view.has_value()) << view.error().sentence;
        const auto expected = decode(sample_file(), {.levels = level});
        ASSERT_TRUE(expected.has_value());
        EXPECT_EQ(view->nodes, expected->nodes);
        EXPECT_EQ(view->link, expected->link);
        EXPECT_EQ(view->plane_begin, expected->plane_begin);
        EXPECT_EQ(view->planes, expected->planes);
        EXPECT_EQ(view->level_begin, expected->level_begin);
        ASSERT_EQ(view->levels.size(), expected->levels.size());
        const double volume = expected->levels.back().volume;
        EXPECT_NEAR(view->levels.back().volume, volume, 1e-9 * volume);
        // Levels follow each other in the file, so each is one request.
        EXPECT_LE(log.requests, 2U + static_cast<std::size_t>(level));
    }
}

TEST(BpoView, DetailInOnePlaceNeedsFewBytesAndContainsTheSolid) {
    Server::Log all_log, log;
    BpoReader all_reader = open(all_log), reader = open(log);
    const auto everywhere = [](const octree::Cell&, const Box3&) { return true; };
    const auto fine = read_view(all_reader, everywhere);
    const Vec3 eye = sample_tree().mesh.lattice.to_world(sample_tree().mesh.points[0]);
    // As finely as seen from the eye: cells at most half as wide as they are far.
    const auto near = read_view(reader, [&](const octree::Cell&, const Box3& box) {
        Vec3 away;
        for (int axis = 0; axis < 3; ++axis)
            away[axis] = std::max({box.low[axis] - eye[axis], eye[axis] - box.high[axis], 0.0});
        return length(box.extents()) > 0.5 * length(away);
    });
    ASSERT_TRUE(fine.has_value());
    ASSERT_TRUE(near.has_value());
    EXPECT_EQ(near->deepest(), fine->deepest());
    EXPECT_LT(near->nodes.size(), fine->nodes.size() / 4);
    EXPECT_LT(log.bytes, all_log.bytes);
    EXPECT_GT(near->levels.back().volume, fine->levels.back().volume);
    EXPECT_LT(near->levels.back().volume, sample_tree().levels[1].volume);
    // Asked again, nothing is read again.
    const std::size_t requests = log.requests;
    EXPECT_TRUE(
        read_view(reader, [](const octree::Cell& cell, const Box3&) { return cell.level < 2; }).has_value());
    EXPECT_EQ(log.requests, requests);
}

TEST(BpoView, WhatHasNotArrivedIsAnErrorAndTheRestIsThere) {
    const auto to_level = *bytes_to_level(sample_file());
    Server::Log log;
    BpoReader reader = open(log, to_level[2]);
    const auto down_to = [](int level) {
        return [level](const octree::Cell& cell, const Box3&) { return cell.level < level; };
    };
    EXPECT_TRUE(read_view(reader, down_to(2)).has_value());
    const auto missing = read_view(reader, down_to(3));
    ASSERT_FALSE(missing.has_value());
    EXPECT_EQ(missing.error().code, ErrorCode::bad_input);
}

}  // namespace
}  // namespace octavo::bp_octree
