// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <octavo/bsp_octree/build.hpp>
#include <octavo/mesh/shapes.hpp>
#include <octavo/render/eye.hpp>
#include <octavo/render/patches.hpp>

#include "render/views.hpp"

namespace octavo::render {
namespace {

/// How far from the viewer a ray through `target` meets the plane of a patch; the ray starts at the eye, or in the
/// plane through the target across the line of sight.
struct Ray {
    Vec3 from, along;

    static Ray through(const Camera& camera, Vec3 target) {
        if (!camera.is_perspective()) return {target, camera.forward()};
        return {camera.eye(), target - camera.eye()};
    }
    double meets(const Patches& patches, const Patch& patch) const {
        return dot(patch.normal, patches.corners[patch.begin] - from) / dot(patch.normal, along);
    }
};

/// Whether a picture point lies in a patch, and not just at its border.
bool is_inside(const Patches& patches, const Patch& patch, const Camera& camera, Vec3 p) {
    double least = 1e300, most = -1e300;
    const std::span<const Vec3> ring = patches.corners_of(patch);
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec3 a = camera.project(ring[i]), b = camera.project(ring[i + 1 == ring.size() ? 0 : i + 1]);
        const double size = std::hypot(b.x - a.x, b.y - a.y);
        if (size < 1e-9) continue;
        const double side = ((b.x - a.x) * (p.y - a.y) - (p.x - a.x) * (b.y - a.y)) / size;
        least = std::min(least, side), most = std::max(most, side);
    }
    return least > 1e-5 || most < -1e-5;
}

/// At points of the picture where patches lie one behind the other, they are sorted by distance. Returns how often they
/// do.
std::size_t expect_sorted(const Patches& patches, const Camera& camera, const std::string& what) {
    std::size_t pairs = 0;
    for (std::size_t i = 0; i < patches.patches.size(); i += 1 + patches.patches.size() / 60) {
        Vec3 middle;
        for (const Vec3& corner : patches.corners_of(patches.patches[i]))
            middle = middle + 1.0 / patches.patches[i].count * corner;
        const Vec3 p = camera.project(middle);
        const Ray ray = Ray::through(camera, middle);
        double before = -1e300;
        for (const Patch& patch : patches.patches) {
            if (!is_inside(patches, patch, camera, p)) continue;
            const double distance = ray.meets(patches, patch);
            EXPECT_GE(distance, before - 1e-6) << what;
            pairs += before > -1e300;
            before = distance;
        }
    }
    return pairs;
}

TEST(Order, OfAnyFacetsIsFromTheFrontToTheBack) {
    std::size_t pairs = 0;
    for (const std::uint64_t seed : {1, 2})
        for (const View& view : tests::all_views()) {
            const Scene scene = tests::random_facets(seed == 1 ? 12 : 100, seed);
            const Camera camera = tests::camera_for(scene, view, 400, 300);
            const Result<Patches> patches = patches_of(scene, camera);
            ASSERT_TRUE(patches);
            pairs += expect_sorted(*patches, camera, "seed " + std::to_string(seed));
        }
    EXPECT_GT(pairs, 1000U);
}

TEST(Order, OfABspOctreeIsFromTheFrontToTheBack) {
    const mesh::Mesh solid = mesh::gear();
    const Result<bsp_octree::Built> built = bsp_octree::build(solid);
    ASSERT_TRUE(built);
    for (const View& view : tests::few_views()) {
        const Camera camera = tests::camera_for(scene_of(solid), view, 400, 300);
        const Result<Patches> patches = patches_of(built->octree, camera);
        ASSERT_TRUE(patches);
        EXPECT_GT(expect_sorted(*patches, camera, "gear"), 10U);
    }
}

TEST(Order, CutsFacetsThatHideOneAnotherInACircle) {
    // Three bars, each over the next: without a cut there is no order.
    Scene scene;
    const auto bar = [&](Vec3 from, Vec3 to, Vec3 width) {
        scene.facets.push_back({{from, from + width, to + width}});
        scene.facets.push_back({{from, to + width, to}});
    };
    bar({-2, -1, 0}, {2, -1, 1}, {0, 0.4, 0});
    bar({1, -2, 0}, {-0.6, 2, 1}, {0.4, 0, 0});
    bar({1.2, 2, 0}, {-1, -2, 1}, {0.4, 0, 0});
    const Camera camera = tests::camera_for(scene, {0, 90, 0, 0.04}, 400, 300);
    const Result<Patches> patches = patches_of(scene, camera);
    ASSERT_TRUE(patches);
    EXPECT_GT(patches->patches.size(), scene.facets.size());
    EXPECT_GT(expect_sorted(*patches, camera, "bars"), 0U);
}

TEST(Eye, KnowsSidesExactlyNextToAPlane) {
    const Box3 bounds{{0, 0, 0}, {1, 1, 1}};
    const exact::Lattice lattice = *exact::Lattice::fit(bounds);
    for (const double perspective : {0.0, 60.0}) {
        const Camera camera = *Camera::look_at(bounds, {0, 0, perspective, 0.1}, 100, 100);
        const Eye eye(camera, lattice);
        // Facing the viewer, who looks along +y; turned away; and edge-on.
        EXPECT_EQ(eye.side(exact::Plane::across_axis(1, 5)), exact::Sign::negative);
        EXPECT_EQ(eye.side(exact::Plane::across_axis(1, 5).reversed()), exact::Sign::positive);
        const exact::Point middle = lattice.snap({0.5, 0.5, 0.5});
        EXPECT_EQ(eye.side(exact::Plane::across_axis(0, middle.x)), exact::Sign::zero);
        EXPECT_EQ(eye.side(exact::Plane::across_axis(0, middle.x - 1)),
                  perspective > 0 ? exact::Sign::positive : exact::Sign::zero);
    }
}

TEST(Order, StopsWhenItIsCancelled) {
    const Scene scene = tests::random_facets(200, 5);
    const Camera camera = tests::camera_for(scene, {}, 100, 100);
    const std::atomic<bool> cancel = true;
    Context context;
    context.cancel = &cancel;
    const Result<Patches> patches = patches_of(scene, camera, context);
    ASSERT_FALSE(patches);
    EXPECT_EQ(patches.error().code, ErrorCode::cancelled);
}

}  // namespace
}  // namespace octavo::render
