// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include <octavo/bp_octree/bit_stream.hpp>
#include <octavo/bp_octree/bpo_format.hpp>
#include <octavo/bp_octree/bpo_layout.hpp>
#include <octavo/bp_octree/build.hpp>
#include <octavo/bp_octree/certify.hpp>
#include <octavo/bp_octree/geometry_codec.hpp>
#include <octavo/bp_octree/leaf_lists.hpp>

#include "bp_octree/sign_bpo.hpp"
#include "bp_octree/solids.hpp"
#include "effort.hpp"

namespace octavo::bp_octree {
namespace {

using PointTriangle = std::array<exact::Point, 3>;

/// Triangles by their points, each in the least of its three rotations: what must survive.
std::multiset<PointTriangle> triangle_set(std::span<const exact::Point> points,
                                          std::span<const mesh::Triangle> triangles) {
    std::multiset<PointTriangle> set;
    for (const mesh::Triangle& t : triangles) {
        const exact::Point a = points[t[0]], b = points[t[1]], c = points[t[2]];
        set.insert(std::min({PointTriangle{a, b, c}, PointTriangle{b, c, a}, PointTriangle{c, a, b}}));
    }
    return set;
}

BpOctree sample_tree(int depth = 4, std::size_t leaf_triangles = 8) {
    BuildOptions options;
    options.leaf_triangles = leaf_triangles;
    auto tree = build(tests::on_lattice(tests::bumpy_sphere(depth)), options);
    EXPECT_TRUE(tree.has_value());
    return std::move(tree).value();
}

TEST(BitStream, NumbersComeBack) {
    std::mt19937 random(1);
    std::vector<std::pair<std::uint32_t, int>> numbers;
    BitWriter writer;
    for (int i = 0; i < 5000; ++i) {
        const int k = static_cast<int>(random() % 33);
        const std::uint32_t value = k == 32 ? random() : random() & ((1U << k) - 1);
        numbers.emplace_back(value, k);
        writer.put(value, k);
        writer.put_rice(value, k % 28);
    }
    const std::vector<std::uint8_t> bytes = std::move(writer).take();
    BitReader reader(bytes);
    for (const auto& [value, k] : numbers) {
        ASSERT_EQ(reader.get(k), value);
        ASSERT_EQ(reader.get_rice(k % 28), value);
    }
    EXPECT_TRUE(reader.finished());
    reader.get(32);
    EXPECT_TRUE(reader.overrun());
    for (const std::int32_t v : {0, -1, 1, INT32_MAX, INT32_MIN}) EXPECT_EQ(unzigzag(zigzag(v)), v);
}

TEST(GeometryCodec, SurfacesComeBackInFewBits) {
    const mesh::LatticeMesh mesh = tests::on_lattice(tests::bumpy_sphere(6));
    const CodedGeometry coded = encode_geometry(mesh.points, mesh.triangles);
    const auto decoded = decode_geometry(coded.bytes, mesh.triangles.size());
    ASSERT_TRUE(decoded.has_value());
    EXPECT_EQ(decoded->points.size(), mesh.points.size());
    EXPECT_EQ(triangle_set(decoded->points, decoded->triangles), triangle_set(mesh.points, mesh.triangles));
    for (std::size_t i = 0; i < coded.order.size(); ++i) {
        const std::vector<mesh::Triangle> before{mesh.triangles[coded.order[i]]},
            after{decoded->triangles[i]};
        ASSERT_EQ(triangle_set(mesh.points, before), triangle_set(decoded->points, after));
    }
    EXPECT_LT(coded.bytes.size(), 5 * mesh.triangles.size());
}

TEST(GeometryCodec, AnyTrianglesComeBack) {
    std::mt19937 random(2);
    for (int i = 0; i < 200; ++i) {
        // From tangles of few points, with edges of many triangles and repeated corners, to loose triangles.
        std::vector<exact::Point> points(3 + random() % 30);
        for (exact::Point& p : points) {
            const auto coordinate = [&] {
                return static_cast<std::int32_t>(random() % exact::universe_side);
            };
            p = {coordinate(), coordinate(), coordinate()};
        }
        std::vector<mesh::Triangle> triangles(random() % 60);
        for (mesh::Triangle& t : triangles)
            for (std::uint32_t& corner : t) corner = static_cast<std::uint32_t>(random() % points.size());
        const CodedGeometry coded = encode_geometry(points, triangles);
        const auto decoded = decode_geometry(coded.bytes, triangles.size());
        ASSERT_TRUE(decoded.has_value());
        ASSERT_EQ(triangle_set(decoded->points, decoded->triangles), triangle_set(points, triangles));
    }
}

TEST(Bpo, ATreeComesBack) {
    const BpOctree tree = sample_tree(5);
    const std::vector<std::uint8_t> bytes = encode(tree);
    EXPECT_TRUE(looks_like_bpo(bytes));
    auto back = decode(bytes);
    ASSERT_TRUE(back.has_value()) << back.error().sentence;
    EXPECT_EQ(back->nodes, tree.nodes);
    EXPECT_EQ(back->level_begin, tree.level_begin);
    EXPECT_EQ(back->link, tree.link);
    EXPECT_EQ(back->plane_begin, tree.plane_begin);
    EXPECT_EQ(back->planes, tree.planes);
    EXPECT_EQ(back->leaf_begin, tree.leaf_begin);
    EXPECT_EQ(back->leaf_winding, tree.leaf_winding);
    EXPECT_EQ(back->levels, tree.levels);
    EXPECT_EQ(back->frame, tree.frame);
    EXPECT_EQ(back->mesh.lattice, tree.mesh.lattice);
    EXPECT_EQ(back->solid_volume, tree.solid_volume);
    EXPECT_EQ(triangle_set(back->mesh.points, back->mesh.triangles),
              triangle_set(tree.mesh.points, tree.mesh.triangles));
    EXPECT_TRUE(certify(*back).has_value());
}

TEST(Bpo, OpenSurfacesAndSingleCellsComeBack) {
    for (const bool open : {false, true}) {
        mesh::Mesh mesh = open ? tests::bumpy_sphere(4) : tests::box({0, 0, 0}, {1, 2, 3});
        if (open) mesh.triangles.resize(mesh.triangles.size() / 2);
        auto tree = build(tests::on_lattice(mesh));
        ASSERT_TRUE(tree.has_value());
        auto back = decode(encode(*tree));
        ASSERT_TRUE(back.has_value()) << back.error().sentence;
        EXPECT_EQ(back->is_solid, !open);
        EXPECT_EQ(back->nodes, tree->nodes);
        EXPECT_TRUE(certify(*back).has_value());
    }
}

TEST(Bpo, TheBeginningOfAFileGivesItsCompleteLevels) {
    const BpOctree tree = sample_tree(5);
    const std::vector<std::uint8_t> bytes = encode(tree);
    const auto sizes = bytes_to_level(bytes);
    ASSERT_TRUE(sizes.has_value());
    ASSERT_EQ(sizes->size(), tree.levels.size());
    for (std::size_t level = 0; level < sizes->size(); ++level) {
        for (const std::uint64_t spare : {0, 1}) {
            auto part = decode_beginning(std::span(bytes).first((*sizes)[level] + spare));
            ASSERT_TRUE(part.has_value());
            ASSERT_EQ(part->levels.size(), level + 1);
            ASSERT_TRUE(std::equal(part->planes.begin(), part->planes.end(), tree.planes.begin()));
        }
        auto less = decode_beginning(std::span(bytes).first((*sizes)[level] - 1));
        ASSERT_EQ(less.has_value(), level > 0);
        if (less) {
            ASSERT_EQ(less->levels.size(), level);
        }
        DecodeOptions options;
        options.levels = static_cast<int>(level);
        auto chosen = decode(bytes, options);
        ASSERT_TRUE(chosen.has_value());
        ASSERT_EQ(chosen->levels.size(), level + 1);
    }
}

TEST(Bpo, EveryShorterFileIsRefused) {
    const std::vector<std::uint8_t> bytes = encode(sample_tree(3));
    for (std::size_t size = 0; size < bytes.size(); size += size < 300 ? 1 : 97) {
        auto tree = decode(std::span(bytes).first(size));
        ASSERT_FALSE(tree.has_value());
        ASSERT_EQ(tree.error().code, ErrorCode::bad_input);
    }
}

TEST(Bpo, EveryFlippedBitIsNoticed) {
    const std::vector<std::uint8_t> bytes = encode(sample_tree(3));
    std::mt19937 random(3);
    for (int i = 0; i < 600; ++i) {
        std::vector<std::uint8_t> damaged = bytes;
        damaged[i < 300 ? static_cast<std::size_t>(i) : random() % bytes.size()] ^=
            static_cast<std::uint8_t>(1U << random() % 8);
        ASSERT_FALSE(decode(damaged).has_value()) << i;
    }
}

TEST(Bpo, ATriangleBesideTheRootIsRefused) {
    BpOctree tree = sample_tree(3);
    ASSERT_TRUE(fill_leaf_lists(tree, {}).has_value());
    // As wide as the root, just above it: it meets none of the octants, though their walls part it.
    const CellBox root = tree.frame.box(octree::Cell::root());
    const std::int32_t west = (root.low[0] + 1) / 2, east = root.high[0] / 2, south = (root.low[1] + 1) / 2,
                       north = root.high[1] / 2, above = (root.high[2] + 1) / 2;
    const auto first = static_cast<mesh::VertexIndex>(tree.mesh.points.size());
    tree.mesh.points.insert(tree.mesh.points.end(),
                            {{west, south, above}, {east, south, above}, {west, north, above}});
    tree.mesh.triangles.push_back({first, first + 1, first + 2});
    const Status filled = fill_leaf_lists(tree, {});
    ASSERT_FALSE(filled.has_value());
    EXPECT_EQ(filled.error().code, ErrorCode::bad_input);
}

TEST(Bpo, LiesWithGoodChecksumsNeverCrashAndWhatIsAcceptedCanBeCertified) {
    const BpOctree tree = sample_tree(3);
    const std::vector<std::uint8_t> bytes = encode(tree);
    std::vector<std::uint8_t> same = bytes;
    tests::sign_bpo(same);
    ASSERT_EQ(same, bytes);
    std::mt19937 random(4);
    int refused = 0, uncertified = 0;
    const int lies = 400 * tests::effort();
    for (int i = 0; i < lies; ++i) {
        std::vector<std::uint8_t> lie = bytes;
        for (unsigned k = 0; k <= random() % 3; ++k)
            lie[i % 2 ? random() % bytes.size() : random() % 700] = static_cast<std::uint8_t>(random());
        tests::sign_bpo(lie);
        auto back = decode(lie);
        if (!back)
            ++refused;
        else
            uncertified += !certify(*back).has_value();
    }
    EXPECT_GT(refused, lies / 3);
    EXPECT_GT(uncertified, lies / 100);
}

}  // namespace
}  // namespace octavo::bp_octree
