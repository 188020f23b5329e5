// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <octavo/bsp_octree/build.hpp>
#include <octavo/classic/from_mesh.hpp>
#include <octavo/io/read.hpp>
#include <octavo/mesh/shapes.hpp>
#include <octavo/render/cairo_drawing.hpp>
#include <octavo/render/cut_open.hpp>
#include <octavo/render/hidden_parts.hpp>
#include <octavo/render/raster.hpp>

#include "models.hpp"
#include "render/views.hpp"

// Two engines that share nothing but scene and camera must make the same picture: the depth buffer, and the exact order
// with hidden parts removed. Pixels differ where a channel does by more than a tenth: at borders both average samples,
// of different patterns.

namespace octavo::render {
namespace {

constexpr int width = 600, height = 450;

double share_of_different_pixels(const Image& a, const Image& b) {
    std::size_t different = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        const Color &p = a.pixels[i], &q = b.pixels[i];
        different += std::max({std::fabs(p.red - q.red), std::fabs(p.green - q.green),
                               std::fabs(p.blue - q.blue)}) > 0.1F;
    }
    return static_cast<double>(different) / static_cast<double>(a.pixels.size());
}

constexpr double most_different = 0.005;

void expect_equal_pictures(const Scene& scene, const View& view, const std::string& what) {
    const Camera camera = tests::camera_for(scene, view, width, height);
    const Result<Image> by_depth = draw(scene, camera, {.width = width, .height = height, .samples = 4});
    const Result<Drawing> drawing = remove_hidden_parts(scene, camera, {.width = width, .height = height});
    ASSERT_TRUE(by_depth && drawing) << what;
    const Result<Image> by_order = paint(*drawing);
    ASSERT_TRUE(by_order) << what;
    EXPECT_LE(share_of_different_pixels(*by_depth, *by_order), most_different) << what;
}

TEST(Engines, AgreeOnGeneratedSolids) {
    const std::vector<std::pair<const char*, mesh::Mesh>> solids{
        {"gear", mesh::gear()},
        {"housing", mesh::bearing_housing()},
        {"knot", mesh::knot_tube(2, 3, 0.3, 120, 24)},
        {"sponge", mesh::menger_sponge(2)},
        {"rock", mesh::displaced_sphere(24)},
    };
    const std::vector<View> views = tests::few_views();
    std::size_t next = 0;
    for (const auto& [name, solid] : solids) {
        const Scene scene = scene_of(solid, {.edges = EdgeLines::none});
        for (const View& view : {views[next], views[(next + 1) % views.size()]})
            expect_equal_pictures(scene, view, name);
        next = (next + 1) % views.size();
    }
}

TEST(Engines, DrawTheSameAtAnyScale) {
    mesh::Mesh gear = mesh::gear();
    for (Vec3& vertex : gear.vertices) vertex = vertex + Vec3{40, -30, 7};
    constexpr int small = 120;
    for (const View& view : {View{}, View{150, -20, 50, 0.04}}) {
        std::vector<Color> pixels;
        std::vector<Polyline> loops, strokes;
        for (const double size : {1.0, 0x1p-950, 0x1p-560, 0x1p-160, 0x1p160, 0x1p560, 0x1p900}) {
            mesh::Mesh scaled = gear;
            for (Vec3& vertex : scaled.vertices) vertex = size * vertex;
            const Scene scene = scene_of(scaled, {});
            const Camera camera = tests::camera_for(scene, view, small, small);
            const Result<Image> image =
                draw(scene, camera, {.width = small, .height = small, .cut_at = 41 * size, .cut_axis = 0});
            const Result<Drawing> drawing =
                remove_hidden_parts(scene, camera, {.width = small, .height = small});
            ASSERT_TRUE(image && drawing) << size;
            std::vector<Polyline> of_regions, of_edges;
            for (const Region& region : drawing->regions)
                of_regions.insert(of_regions.end(), region.loops.begin(), region.loops.end());
            for (const Strokes& edges : drawing->edges)
                of_edges.insert(of_edges.end(), edges.lines.begin(), edges.lines.end());
            if (size == 1) pixels = image->pixels, loops = of_regions, strokes = of_edges;
            EXPECT_TRUE(image->pixels == pixels) << size;
            EXPECT_TRUE(of_regions == loops) << size;
            EXPECT_TRUE(of_edges == strokes) << size;
        }
        EXPECT_GT(loops.size(), 20u);
        EXPECT_GT(strokes.size(), 20u);
    }
}

TEST(Engines, AgreeOnCrossingFacetsSeenFromBothSides) {
    for (const std::uint64_t seed : {1, 2}) {
        Scene scene = tests::random_facets(25, seed);
        for (std::size_t i = 0; i < scene.facets.size(); ++i)
            scene.facets[i].front = palette::solids[i % palette::solids.size()];
        for (const View& view : {View{}, View{.perspective = 50}})
            expect_equal_pictures(scene, view, "crossing facets");
    }
}

TEST(Engines, AgreeOnTheCellsOfAnOctree) {
    const mesh::Mesh gear = mesh::gear();
    const Result<classic::Built> built = classic::build(gear, {.depth = 5});
    ASSERT_TRUE(built);
    const Vec3 middle = 0.5 * (gear.bounds().low + gear.bounds().high);
    Box3 removed{middle, {Box3::infinity, Box3::infinity, Box3::infinity}};
    for (const Box3& box : {Box3{}, removed})
        expect_equal_pictures(scene_of(built->octree, {.removed = box, .edges = EdgeLines::none}), {},
                              "cells");
}

TEST(Engines, AgreeOnLines) {
    const mesh::Mesh solid = mesh::bearing_housing();
    Scene scene = scene_of(solid);
    const View view{.perspective = 40};
    const Camera camera = tests::camera_for(scene, view, width, height);
    for (const Line& line : contours_of(solid, camera)) scene.lines.push_back(line);
    const Image by_depth = *draw(scene, camera, {.width = width, .height = height, .samples = 4});
    const Image by_order = *paint(*remove_hidden_parts(scene, camera, {.width = width, .height = height}));
    // Lines are a row of squares in one and smoothed in the other; a line missing would be seen here all the same.
    std::size_t different = 0;
    for (std::size_t i = 0; i < by_depth.pixels.size(); ++i)
        different += std::fabs(by_depth.pixels[i].green - by_order.pixels[i].green) > 0.4F;
    EXPECT_LE(static_cast<double>(different), most_different * static_cast<double>(by_depth.pixels.size()));
}

TEST(Engines, AgreeOnASolidCutOpen) {
    const mesh::Mesh solid = mesh::bearing_housing();
    const Box3 bounds = solid.bounds();
    const Vec3 middle = 0.5 * (bounds.low + bounds.high);
    constexpr double infinity = Box3::infinity;
    const Box3 half{{middle.x, -infinity, -infinity}, {infinity, infinity, infinity}};
    const Box3 quarter{{middle.x, -infinity, -infinity}, {infinity, middle.y, infinity}};
    for (const Box3& removed : {half, quarter}) {
        const Result<mesh::Mesh> cut = cut_open(solid, removed);
        ASSERT_TRUE(cut);
        const Scene scene = scene_of(*cut, {.edges = EdgeLines::none});
        expect_equal_pictures(scene, {}, "cut mesh");

        const Result<bsp_octree::Built> built = bsp_octree::build(solid);
        const Result<CutBspOctree> tree = cut_open(built->octree, removed);
        ASSERT_TRUE(tree);
        const Camera camera = tests::camera_for(scene, {}, width, height);
        const Result<Patches> patches = patches_of(tree->solid, camera, {.cut = tree->cut});
        const Drawing drawing =
            *remove_hidden_parts(*patches, {}, camera, {.width = width, .height = height});
        const Image by_depth = *draw(scene, camera, {.width = width, .height = height, .samples = 4});
        EXPECT_LE(share_of_different_pixels(by_depth, *paint(drawing)), most_different) << "cut tree";
        const auto is_cap = [](const Patch& patch) { return patch.color == palette::inner; };
        EXPECT_TRUE(std::any_of(patches->patches.begin(), patches->patches.end(), is_cap));
    }
}

TEST(Engines, AgreeOnModels) {
    for (const char* name : {"classic/bunny-closed-100k.ply", "mechanical/fandisk-13k.obj"}) {
        OCTAVO_NEEDS_MODEL(name);
        const Result<io::ReadMesh> read = io::read_mesh((tests::models_folder() / name).string(), {});
        ASSERT_TRUE(read) << name;
        expect_equal_pictures(scene_of(read->mesh, {.edges = EdgeLines::none}), {}, name);
    }
}

}  // namespace
}  // namespace octavo::render
