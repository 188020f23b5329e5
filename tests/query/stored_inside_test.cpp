// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>

#include <gtest/gtest.h>
#include <unistd.h>

#include <octavo/bp_octree/bpo_file.hpp>
#include <octavo/bp_octree/build.hpp>
#include <octavo/query/stored_inside.hpp>

#include "bp_octree/solids.hpp"

namespace octavo::query {
namespace {

/// A file that is removed at the end.
class StoredInsideTest : public testing::Test {
  protected:
    void TearDown() override { std::filesystem::remove(path_); }

    void store(const mesh::LatticeMesh& mesh, std::size_t leaf_triangles) {
        bp_octree::BuildOptions options;
        options.leaf_triangles = leaf_triangles;
        options.quality = bp_octree::Quality::fast;
        auto tree = bp_octree::build(mesh, options);
        ASSERT_TRUE(tree.has_value());
        bytes_ = bp_octree::encode(*tree);
        ASSERT_TRUE(bp_octree::write_bpo(path_, bytes_).has_value());
    }
    void rewrite(std::span<const std::uint8_t> bytes) const {
        std::ofstream(path_, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    }

    std::string path_ =
        (std::filesystem::temp_directory_path() / ("octavo-stored-" + std::to_string(getpid()) + ".bpo"))
            .string();
    std::vector<std::uint8_t> bytes_;
};

/// Vertices, points on edges and facets, half-integers where walls of cells lie, and anywhere.
std::vector<Vec3> telling_points(const mesh::LatticeMesh& mesh, std::size_t count) {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> unit(0, 1);
    const auto& origin = mesh.lattice.origin();
    const auto world = [&](Vec3 p) {
        for (int axis = 0; axis < 3; ++axis)
            p[axis] =
                (static_cast<double>(origin[static_cast<std::size_t>(axis)]) + p[axis]) * mesh.lattice.unit();
        return p;
    };
    const auto vertex = [&](mesh::VertexIndex i) {
        const exact::Point p = mesh.points[i];
        return Vec3{static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)};
    };
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < count; ++i) {
        const mesh::Triangle& t = mesh.triangles[random() % mesh.triangles.size()];
        const Vec3 a = vertex(t[0]), b = vertex(t[1]), c = vertex(t[2]);
        points.push_back(world(a));
        points.push_back(world(0.5 * (a + b)));
        points.push_back(world(0.25 * (a + b) + 0.5 * c));
        points.push_back(world(a + Vec3{0.5, 0, -0.5}));
        points.push_back(world(0.5 * (a + b) + Vec3{1e-6 * unit(random), -1e-6 * unit(random), 0}));
        const double side = exact::universe_side;
        points.push_back(world({1.1 * side * unit(random), side * unit(random), side * unit(random)}));
    }
    return points;
}

TEST_F(StoredInsideTest, AnswersAsTheInsideQueryDoes) {
    mesh::Mesh overlapping = tests::box({0, 0, 0}, {4, 4, 4});
    tests::add_box(overlapping, {4, 4, 0}, {8, 8, 4});
    tests::add_box(overlapping, {1, 1, 1}, {6, 3, 3});
    for (const mesh::LatticeMesh& mesh :
         {tests::on_lattice(tests::bumpy_sphere(5)), tests::on_lattice(overlapping)}) {
        store(mesh, 8);
        auto stored = StoredInside::open(path_);
        ASSERT_TRUE(stored.has_value()) << stored.error().sentence;
        auto query = InsideQuery::build(mesh);
        ASSERT_TRUE(query.has_value());
        std::array<int, 3> seen{};
        for (const Vec3& point : telling_points(mesh, 400)) {
            const auto side = (*stored)(point);
            ASSERT_TRUE(side.has_value()) << side.error().sentence;
            ASSERT_EQ(*side, (*query)(point)) << point.x << ' ' << point.y << ' ' << point.z;
            ++seen[static_cast<std::size_t>(static_cast<int>(*side) + 1)];
        }
        for (const int count : seen) EXPECT_GT(count, 100);
        const double infinity = std::numeric_limits<double>::infinity();
        EXPECT_EQ(*(*stored)({infinity, 0, 0}), Side::outside);
        EXPECT_EQ(*(*stored)({std::nan(""), 0, 0}), Side::outside);
    }
}

TEST_F(StoredInsideTest, IsOnWhatIsLeftOfABodyThatCollapsed) {
    mesh::Mesh mesh = tests::box({0, 0, 0}, {40, 40, 40});
    const auto first = static_cast<mesh::VertexIndex>(mesh.vertices.size());
    for (const double t : {0.0, 1.0, 2.0, 5.0}) mesh.vertices.push_back({50 + 3 * t, 60 - t, 10 + 2 * t});
    for (const mesh::Triangle& t : {mesh::Triangle{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}})
        mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    store(tests::on_lattice(mesh), 2);
    auto stored = StoredInside::open(path_);
    ASSERT_TRUE(stored.has_value());
    for (const double t : {0.0, 0.5, 1.75, 5.0, 5.5})
        EXPECT_EQ((*stored)({50 + 3 * t, 60 - t, 10 + 2 * t}).value(), t <= 5 ? Side::on : Side::outside)
            << t;
}

TEST_F(StoredInsideTest, ReadsNoMoreThanItNeedsAndNoticesWhatIsDamagedThere) {
    const mesh::LatticeMesh mesh = tests::on_lattice(tests::bumpy_sphere(5));
    store(mesh, 8);
    // The triangles come last; a place that is white at once needs none of them.
    std::vector<std::uint8_t> damaged = bytes_;
    damaged.back() ^= 0xff;
    rewrite(damaged);
    auto stored = StoredInside::open(path_);
    ASSERT_TRUE(stored.has_value());
    EXPECT_TRUE((*stored)({100, 0, 0}).has_value());
    bool noticed = false;
    for (const Vec3& point : telling_points(mesh, 50)) {
        const auto side = (*stored)(point);
        noticed |= !side.has_value();
        if (!side) {
            EXPECT_EQ(side.error().code, ErrorCode::bad_input);
        }
    }
    EXPECT_TRUE(noticed);

    for (const std::size_t size :
         {std::size_t{0}, std::size_t{7}, std::size_t{191}, std::size_t{400}, bytes_.size() / 2}) {
        rewrite(std::span(bytes_).first(size));
        auto cut = StoredInside::open(path_);
        // Half a file has its index; places whose chunks are there are answered.
        if (size < 1000) {
            EXPECT_FALSE(cut.has_value());
        } else {
            ASSERT_TRUE(cut.has_value());
            EXPECT_TRUE((*cut)({100, 0, 0}).has_value());
        }
    }
}

TEST_F(StoredInsideTest, RefusesOpenSurfacesAndMissingFiles) {
    mesh::Mesh open = tests::bumpy_sphere(2);
    open.triangles.pop_back();
    store(tests::on_lattice(open), 8);
    EXPECT_EQ(StoredInside::open(path_).error().code, ErrorCode::not_a_solid);
    EXPECT_EQ(StoredInside::open(path_ + "-not-there").error().code, ErrorCode::io);
}

}  // namespace
}  // namespace octavo::query
