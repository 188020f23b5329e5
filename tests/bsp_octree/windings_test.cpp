// SPDX-License-Identifier: Apache-2.0
#include <random>

#include <octavo/boolean/evaluate.hpp>
#include <octavo/mesh/transform.hpp>

#include "bsp_octree/fingerprint.hpp"
#include "bsp_octree/solid_cases.hpp"
#include "effort.hpp"

// Surfaces that cross, cover and nest themselves: the solid is where they wind about at least once, exactly.

namespace octavo::bsp_octree {
namespace {

using boolean::Program;
using tests::Convex;
using tests::fine;
using tests::Grid;

/// Convex bodies as one surface, some of them inside out.
struct Heap {
    std::vector<Convex> bodies;
    std::vector<int> windings;  ///< inside of each
    mesh::Mesh mesh;

    Heap(std::mt19937& random, int side) {
        const int count = std::uniform_int_distribution<int>(2, 6)(random);
        std::vector<mesh::Mesh> meshes;
        for (int i = 0; i < count; ++i) {
            // Often the same body again, or its faces looking the other way.
            const bool again = i > 0 && random() % 4 == 0;
            bodies.push_back(again ? bodies.back() : tests::random_convex(random, side));
            windings.push_back(random() % 3 == 0 ? -1 : 1);
            const mesh::Mesh& body = bodies.back().mesh;
            meshes.push_back(windings.back() > 0 ? body : mesh::flipped(body));
        }
        mesh = tests::joined(meshes);
    }

    /// How often it winds about a point in eighths; none for a point in the plane of a face.
    std::optional<int> winding(const Grid& eighths) const {
        int sum = 0;
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            bool inside = true;
            for (const tests::HalfSpace& half : bodies[i].sides) {
                const int value = tests::dot(half.n, eighths) - 8 * half.d;
                if (value == 0) return {};
                inside = inside && value < 0;
            }
            sum += inside ? windings[i] : 0;
        }
        return sum;
    }
};

class Heaps : public testing::TestWithParam<std::tuple<int, std::uint32_t>> {};

TEST_P(Heaps, AreSolidWhereTheyWindAboutAPoint) {
    const auto [side, planes] = GetParam();
    int resolved = 0;
    for (int run = 0; run < 60 * tests::effort() && !HasFailure(); ++run) {
        std::mt19937 random(static_cast<unsigned>(run * 10 + side));
        const Heap heap(random, side);
        // Points of the lattice are those of the grid: all others would be lost if anything were rounded.
        const exact::Lattice lattice = tests::small_lattice(0);
        MeshOptions options = fine(planes);
        if (run % 5 == 4) options.octree.depth = 23;
        const Result<Built> built = build(heap.mesh, lattice, options);
        ASSERT_TRUE(built) << "run " << run << ": " << built.error().describe();
        resolved += built->report.resolved;
        const BspOctree& solid = built->octree;
        EXPECT_TRUE(tests::fingerprint_of(solid) ==
                    tests::fingerprint_of(std::span(&heap.mesh, 1), Program::union_of(1)))
            << "run " << run;
        std::uniform_int_distribution<int> number(-3, 8 * side + 3);
        for (int i = 0; i < 200; ++i) {
            const Grid at{number(random), number(random), number(random)};
            const std::optional<int> winding = heap.winding(at);
            if (!winding) continue;
            ASSERT_EQ(solid.classify({at[0] / 8.0, at[1] / 8.0, at[2] / 8.0}),
                      *winding > 0 ? bsp::Position::in : bsp::Position::out)
                << "run " << run << " at " << at[0] << ' ' << at[1] << ' ' << at[2] << " eighths";
        }
        const Result<ToMesh> mesh = to_mesh(solid);
        ASSERT_TRUE(mesh) << "run " << run;
        EXPECT_EQ(tests::manifold_defect(mesh->mesh), "") << "run " << run;
        EXPECT_TRUE(solid.subtract(solid)->is_empty());
        EXPECT_TRUE(solid.unite(solid.complement())->is_everything());
    }
    EXPECT_GT(resolved, 20);
}

INSTANTIATE_TEST_SUITE_P(Sizes, Heaps,
                         testing::Combine(testing::Values(2, 4), testing::Values(1U, 8U, 1000U)));

TEST(Windings, KeepSlitsThatAreThinnerThanALatticeUnit) {
    // Wedges that end in one far point cross a slab whose upper side is tilted by one unit: what is left of them above
    // it is thinner than a unit all along. A surface rounded to the lattice folds flat there, and loses the area of
    // both sides.
    constexpr double length = 4096;
    std::vector<mesh::Mesh> parts;
    mesh::Mesh slab = tests::box({0, 0, 0}, {64, 64, 8}).mesh;
    for (Vec3& vertex : slab.vertices)
        if (vertex.z > 0 && vertex.x > 0) vertex.z += 1;
    parts.push_back(slab);
    for (int i = 0; i < 16; ++i) {
        const double y = 2 + 3 * i;
        parts.push_back({{{1, y, 8}, {1, y + 1, 9}, {1, y + 2, 8}, {length, 32, 12}},
                         {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}},
                         {}});
        if (tests::volume_of(parts.back()) < 0) parts.back() = mesh::flipped(parts.back());
    }
    const mesh::Mesh mesh = tests::joined(parts);
    const exact::Lattice lattice = *exact::Lattice::from_parts(0, {-8, -8, -8});
    const Result<Built> built = build(mesh, lattice);
    ASSERT_TRUE(built);
    EXPECT_TRUE(built->report.resolved);
    EXPECT_TRUE(tests::fingerprint_of(built->octree) ==
                tests::fingerprint_of(std::span(&mesh, 1), Program::union_of(1)));
    const mesh::Measures exact = mesh::measure(boolean::unite(std::span(&mesh, 1))->mesh);
    EXPECT_NEAR(measure(built->octree).area, exact.area, 1e-9 * exact.area);
    EXPECT_NEAR(measure(built->octree).volume, exact.volume, 1e-9 * exact.volume);
}

}  // namespace
}  // namespace octavo::bsp_octree
