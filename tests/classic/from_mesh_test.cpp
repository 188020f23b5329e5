// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include <classic/rational.hpp>
#include <classic/solids.hpp>
#include <gtest/gtest.h>
#include <models.hpp>

#include <octavo/classic/facet.hpp>
#include <octavo/classic/from_mesh.hpp>
#include <octavo/io/read.hpp>
#include <octavo/mesh/snap.hpp>
#include <octavo/octree/cell.hpp>
#include <octavo/octree/linear_octree.hpp>

#include "effort.hpp"

namespace octavo::classic {
namespace {

using octree::Cell;
using octree::CellKey;
using octree::Color;
using octree::OctreeStats;

Context with_threads(int threads) {
    Context context;
    context.threads = threads;
    return context;
}

/// Every cell of the last level has the colour that clipping and ray casting in unlimited numbers give it.
void expect_colors_of_the_oracle(const mesh::LatticeMesh& mesh, const octree::Octree& octree, unsigned seed) {
    const int denominator = 1009;
    const tests::ScaledSurface surface(mesh, denominator);
    std::mt19937 random(seed);
    const octree::LinearOctree leaves = *octree::LinearOctree::from(octree);
    const std::uint64_t count = 1ULL << (3 * octree.depth());
    for (std::uint64_t i = 0; i < count; ++i) {
        const CellKey key =
            CellKey::from_code(i << (3 * (octree::max_level - octree.depth())), octree.depth());
        const Cell cell = Cell::of(key);
        bool met = false;
        for (const mesh::Triangle& t : mesh.triangles) {
            const std::array<exact::Point, 3> p{mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]};
            // A facet without area bounds nothing.
            met = met || (tests::meets_open_box(p, cell.low, cell.high()) &&
                          !facets_of({{}, {p[0], p[1], p[2]}, {{0, 1, 2}}})->empty());
        }
        const Color color = leaves.color(leaves.locate(cell.low));
        ASSERT_EQ(color == Color::gray, met) << "seed " << seed << " cell " << key.bits();
        if (met) continue;
        const auto within = [&](std::int32_t low) {
            const auto part = static_cast<std::int64_t>(random() % (denominator - 1)) + 1;
            return tests::Integer(std::int64_t{low} * denominator + part * cell.side());
        };
        const tests::Place place =
            tests::place_of(surface, {within(cell.low.x), within(cell.low.y), within(cell.low.z)});
        ASSERT_EQ(color == Color::black, place.winding > 0) << "seed " << seed << " cell " << key.bits();
    }
}

TEST(BuildFromMesh, ColorsEveryCellAsRationalRaysDoOnDegenerateOverlappingSolids) {
    std::array<std::uint64_t, 3> leaves{};
    for (unsigned seed = 0; seed < 60u * static_cast<unsigned>(tests::effort()); ++seed) {
        // Corners in the walls of cells for even seeds (pitch ≥ a cell), off them for odd ones.
        tests::GridPoints points(seed, seed % 2 ? 13 : 1 << (seed / 2 % 4));
        const mesh::LatticeMesh bag = tests::random_bag(points);
        const Result<Built> built = build(bag, {.depth = 1 + static_cast<int>(seed % 3)}, with_threads(1));
        if (facets_of(bag)->empty()) {
            EXPECT_EQ(built.error().code, ErrorCode::not_a_solid) << "seed " << seed;
            continue;
        }
        ASSERT_TRUE(built) << built.error().describe();
        expect_colors_of_the_oracle(bag, built->octree, seed);
        const OctreeStats stats = built->octree.stats();
        leaves[0] += stats.white, leaves[1] += stats.black, leaves[2] += stats.gray;
    }
    for (const std::uint64_t count : leaves) EXPECT_GT(count, 50u) << "every colour must have been tried";
}

TEST(BuildFromMesh, GivesABoxAlignedWithCellsNoGrayCellsAtAll) {
    const std::int32_t s = octree::cell_side(4);
    const mesh::LatticeMesh cube = tests::box({3 * s, 5 * s, s}, {8 * s, 11 * s, 16 * s - 1});
    const OctreeStats stats = build(cube, {.depth = 4})->octree.stats();
    // The top side lies one unit below a wall; the others lie in walls.
    EXPECT_EQ(stats.levels[4].gray, 5u * 6u);
    EXPECT_EQ(stats.gray, 5u * 6u);
    const octree::LatticeVolume black = octree::LatticeVolume{5 * 6 * 14} * octree::cell_volume(4);
    EXPECT_TRUE(stats.black_volume == black);
}

TEST(BuildFromMesh, CountsOnlyWindingNumbersAboveZeroAsInside) {
    const auto cell_at = [](const mesh::LatticeMesh& mesh, exact::Point p) {
        const octree::Octree octree = build(mesh, {.depth = 3})->octree;
        Color found = Color::gray;
        octree.for_each_leaf([&](CellKey key, Color color) {
            if (key.contains(p)) found = color;
        });
        return found;
    };
    const std::int32_t s = octree::cell_side(3);
    const exact::Point middle{4 * s, 4 * s, 4 * s};
    const mesh::LatticeMesh outer = tests::box({s, s, s}, {7 * s, 7 * s, 7 * s});
    const mesh::LatticeMesh inner = tests::box({3 * s, 3 * s, 3 * s}, {6 * s, 6 * s, 6 * s});
    mesh::LatticeMesh hollow = outer, nested = outer;
    tests::append(hollow, tests::reversed(inner));
    tests::append(nested, inner);
    EXPECT_EQ(cell_at(outer, middle), Color::black);
    EXPECT_EQ(cell_at(hollow, middle), Color::white);
    EXPECT_EQ(cell_at(nested, middle), Color::black);
    EXPECT_EQ(cell_at(tests::reversed(outer), middle), Color::white) << "inside out bounds nothing";
}

TEST(BuildFromMesh, EnclosesTheExactVolumeEverTighter) {
    const mesh::LatticeMesh ball = tests::sphere({33000001, 33333333, 33500007}, 30000000, 4);
    const tests::Wide six = tests::six_volumes(ball);
    octree::LatticeVolume last_gap = ~octree::LatticeVolume{0};
    for (int depth = 1; depth <= 8; ++depth) {
        const OctreeStats stats = build(ball, {.depth = depth})->octree.stats();
        EXPECT_TRUE(6 * static_cast<tests::Wide>(stats.black_volume) <= six);
        EXPECT_TRUE(six <= 6 * static_cast<tests::Wide>(stats.black_volume + stats.gray_volume));
        EXPECT_TRUE(stats.gray_volume < last_gap);
        last_gap = stats.gray_volume;
    }
    EXPECT_LT(static_cast<double>(last_gap) * 6, 0.1 * static_cast<double>(six));
}

TEST(BuildFromMesh, GivesTheSameBytesForAnyNumberOfThreads) {
    mesh::LatticeMesh two = tests::sphere({33000001, 33333333, 33500007}, 30000000, 5);
    tests::append(two, tests::sphere({40000000, 33333333, 33500007}, 25000000, 4));
    const octree::Octree serial = build(two, {.depth = 7}, with_threads(1))->octree;
    for (const int threads : {0, 2, 3})
        EXPECT_EQ(build(two, {.depth = 7}, with_threads(threads))->octree, serial);
}

TEST(BuildFromMesh, RefusesOpenSurfacesByNameAndClosesThemOnRequest) {
    mesh::LatticeMesh cube = tests::box({1000, 1000, 1000}, {60000000, 60000000, 60000000});
    const octree::Octree whole = build(cube, {.depth = 5})->octree;
    cube.triangles.erase(cube.triangles.begin() + 2, cube.triangles.begin() + 4);  // the top
    const Result<Built> refused = build(cube, {.depth = 5});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::not_a_solid);
    EXPECT_FALSE(refused.error().place.faces.empty());

    const Result<Built> closed = build(cube, {.depth = 5, .open = OpenPolicy::winding});
    ASSERT_TRUE(closed);
    EXPECT_EQ(closed->octree, whole) << "a flat hole is closed flat";
    EXPECT_EQ(closed->report.closing_facets, 4u);
    EXPECT_EQ(closed->report.open_facets, refused.error().place.faces);
}

TEST(BuildFromMesh, RefusesAClosedSurfaceOfWhichNoFacetHasArea) {
    mesh::Mesh needle;
    needle.vertices = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}};
    needle.triangles = {{0, 1, 2}, {2, 1, 0}};
    for (const OpenPolicy open : {OpenPolicy::reject, OpenPolicy::winding}) {
        const Result<Built> refused = build(needle, {.open = open});
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().code, ErrorCode::not_a_solid);
        EXPECT_EQ(refused.error().place.faces, std::vector<std::uint32_t>{0});
    }
    mesh::LatticeMesh cube = tests::box({1000, 1000, 1000}, {60000000, 60000000, 60000000});
    cube.triangles.push_back({0, 1, 1});
    const Result<Built> built = build(cube, {.depth = 3});
    ASSERT_TRUE(built);
    EXPECT_EQ(built->report.facets_without_area, 1u);
}

TEST(BuildFromMesh, HandlesEmptyMeshesEveryDepthAndBadDepths) {
    EXPECT_EQ(build(mesh::LatticeMesh{}, {.depth = 5})->octree.stats().white, 1u);
    const mesh::LatticeMesh small =
        tests::tetrahedron({exact::Point{5, 5, 5}, exact::Point{700, 9, 5}, exact::Point{8, 800, 30},
                            exact::Point{100, 200, 900}});
    EXPECT_EQ(build(small, {.depth = 0})->octree.stats().gray, 1u);
    const Result<Built> deep = build(small, {.depth = octree::max_level});
    EXPECT_TRUE(deep->octree.validate());
    EXPECT_EQ(deep->octree.stats().deepest, octree::max_level);
    const tests::Wide six = tests::six_volumes(small);
    EXPECT_TRUE(6 * static_cast<tests::Wide>(deep->octree.stats().black_volume) <= six);
    EXPECT_TRUE(six <= 6 * static_cast<tests::Wide>(deep->octree.stats().black_volume +
                                                    deep->octree.stats().gray_volume));
    EXPECT_FALSE(build(small, {.depth = 22}));
    EXPECT_FALSE(build(small, {.depth = -1}));
    mesh::LatticeMesh bad = small;
    bad.triangles[2][1] = 99;
    EXPECT_EQ(build(bad).error().code, ErrorCode::bad_input);
}

TEST(BuildFromMesh, FillsTheUniverseWhenTheSolidDoes) {
    // Surfaces in the low sides of the universe: the reference of the root is inside at once.
    const std::int32_t last = exact::universe_side - 1;
    const octree::Octree octree = build(tests::box({0, 0, 0}, {last, last, last}), {.depth = 3})->octree;
    const OctreeStats stats = octree.stats();
    EXPECT_EQ(stats.gray, 512u - 343u);
    EXPECT_EQ(stats.white, 0u);
}

/// Bounds of six times a volume.
struct SixVolumes {
    tests::Wide lower = 0, upper = 0;
};

SixVolumes six_volume_bounds(const mesh::LatticeMesh& mesh, int depth) {
    const OctreeStats stats = build(mesh, {.depth = depth})->octree.stats();
    return {6 * static_cast<tests::Wide>(stats.black_volume),
            6 * static_cast<tests::Wide>(stats.black_volume + stats.gray_volume)};
}

/// Bounds of the integral of the winding number, which is the signed volume of any closed surface: the volumes where
/// it is at least 1, 2, 3 … minus those where it is at most −1, −2, −3 … A box around all, inside out, lowers it by 1.
SixVolumes six_integral_bounds(const mesh::LatticeMesh& mesh, int depth) {
    constexpr std::int32_t last = exact::universe_side - 1;
    const mesh::LatticeMesh lowering = tests::reversed(tests::box({0, 0, 0}, {last, last, last}));
    SixVolumes sum;
    mesh::LatticeMesh above = mesh, below = tests::reversed(mesh);
    for (int threshold = 1; threshold <= 8; ++threshold) {
        const SixVolumes positive = six_volume_bounds(above, depth),
                         negative = six_volume_bounds(below, depth);
        sum.lower += positive.lower - negative.upper;
        sum.upper += positive.upper - negative.lower;
        tests::append(above, lowering);
        tests::append(below, lowering);
    }
    return sum;
}

enum class Verdict { enclosed, enclosed_as_integral, refused };

/// interior ≤ true volume ≤ interior + surface, exactly. Where the signed volume is not the volume, because shells
/// overlap or run inside out, the integral of the winding number is enclosed instead.
Verdict expect_volume_bounds(const std::filesystem::path& path, int depth) {
    const Result<io::ReadMesh> read = io::read_mesh(path.string());
    EXPECT_TRUE(read) << path << read.error().describe();
    const Result<mesh::Snapped> snapped = mesh::snap(read->mesh);
    EXPECT_TRUE(snapped) << path << snapped.error().describe();
    const Result<Built> built = build(snapped->mesh, {.depth = depth});
    if (!built) {
        EXPECT_EQ(built.error().code, ErrorCode::not_a_solid) << path;
        EXPECT_FALSE(built.error().place.faces.empty()) << path;
        return Verdict::refused;
    }
    const tests::Wide six = tests::six_volumes(snapped->mesh);
    const SixVolumes simple = six_volume_bounds(snapped->mesh, depth);
    if (simple.lower <= six && six <= simple.upper) return Verdict::enclosed;
    const SixVolumes integral = six_integral_bounds(snapped->mesh, depth);
    EXPECT_TRUE(integral.lower <= six && six <= integral.upper) << path;
    return Verdict::enclosed_as_integral;
}

TEST(BuildFromMesh, EnclosesTheVolumeOfRealModels) {
    for (const char* name :
         {"classic/homer.off", "classic/spot.obj", "mechanical/hilbert-cube.obj", "mechanical/part.off",
          "mechanical/wing-nut.obj", "classic/bunny-closed-100k.ply"}) {
        OCTAVO_NEEDS_MODEL(name);
        EXPECT_EQ(expect_volume_bounds(tests::models_folder() / name, 7), Verdict::enclosed) << name;
    }
    for (const char* name : {"defective/spheres-intersecting.off", "classic/horse-97k.ply"}) {
        OCTAVO_NEEDS_MODEL(name);
        EXPECT_EQ(expect_volume_bounds(tests::models_folder() / name, 7), Verdict::enclosed_as_integral)
            << name;
    }
    OCTAVO_NEEDS_MODEL("defective/pig-open.off");
    EXPECT_EQ(expect_volume_bounds(tests::models_folder() / "defective/pig-open.off", 7), Verdict::refused);
}

TEST(BuildFromMesh, EnclosesTheVolumeOfEveryModelThereIsAtDepthNine) {
    if (tests::effort() < 10) GTEST_SKIP() << "set OCTAVO_TEST_EFFORT to 10 or more";
    OCTAVO_NEEDS_MODEL("classic");
    std::array<int, 3> verdicts{};
    for (const auto& entry : std::filesystem::recursive_directory_iterator(tests::models_folder())) {
        const std::string extension = entry.path().extension().string();
        if (extension == ".ply" || extension == ".obj" || extension == ".off" || extension == ".stl")
            ++verdicts[static_cast<std::size_t>(expect_volume_bounds(entry.path(), 9))];
    }
    std::cout << verdicts[0] << " volumes enclosed, " << verdicts[1] << " integrals enclosed, " << verdicts[2]
              << " open surfaces refused\n";
    EXPECT_GT(verdicts[0], 0);
}

}  // namespace
}  // namespace octavo::classic
