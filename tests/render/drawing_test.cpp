// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <octavo/bsp_octree/build.hpp>
#include <octavo/mesh/shapes.hpp>
#include <octavo/render/hidden_parts.hpp>
#include <octavo/render/outline.hpp>
#include <octavo/render/visible.hpp>

#include "render/views.hpp"

namespace octavo::render {
namespace {

double area_of(const Region& region) {
    double twice = 0;
    for (const Polyline& loop : region.loops)
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const DrawingPoint a = loop[i], b = loop[i + 1 == loop.size() ? 0 : i + 1];
            twice += static_cast<double>(a.x) * b.y - static_cast<double>(b.x) * a.y;
        }
    return twice / 2 / (steps_of_pixel * steps_of_pixel);
}

Drawing drawing_of(const Scene& scene, const View& view, HiddenLines hidden = HiddenLines::leave_out) {
    const Camera camera = tests::camera_for(scene, view, 400, 300);
    Result<Drawing> drawing =
        remove_hidden_parts(scene, camera, {.width = 400, .height = 300, .hidden_lines = hidden});
    EXPECT_TRUE(drawing);
    return *drawing;
}

double length_of(const std::vector<Strokes>& groups) {
    double sum = 0;
    for (const Strokes& strokes : groups)
        for (const Polyline& line : strokes.lines)
            for (std::size_t i = 1; i < line.size(); ++i)
                sum += std::hypot(line[i].x - line[i - 1].x, line[i].y - line[i - 1].y);
    return sum / steps_of_pixel;
}

TEST(Drawing, OfABoxIsThreeFacesOfFourCorners) {
    const Scene box = scene_of(mesh::box({0, 0, 0}, {3, 2, 1}));
    for (const double perspective : {0.0, 40.0}) {
        const Drawing drawing = drawing_of(box, {.perspective = perspective});
        ASSERT_EQ(drawing.regions.size(), 3U);
        for (const Region& region : drawing.regions) {
            ASSERT_EQ(region.loops.size(), 1U);
            EXPECT_EQ(region.loops[0].size(), 4U);
        }
        // Nine edges, of which three meet in the corner next to the viewer.
        ASSERT_EQ(drawing.edges.size(), 1U);
        EXPECT_TRUE(drawing.hidden.empty());
        const Drawing dashed = drawing_of(box, {.perspective = perspective}, HiddenLines::dash);
        ASSERT_EQ(dashed.hidden.size(), 1U);
        EXPECT_EQ(dashed.hidden[0].lines.size(), 3U);
        double edges = 0;
        const Camera camera = tests::camera_for(box, {.perspective = perspective}, 400, 300);
        for (const Line& line : box.lines) {
            const Vec3 a = camera.project(line.from), b = camera.project(line.to);
            edges += std::hypot(b.x - a.x, b.y - a.y);
        }
        EXPECT_NEAR(length_of(dashed.edges) + length_of(dashed.hidden), edges, 0.2);
    }
}

TEST(Drawing, SeenAlongAnAxisShowsOneFace) {
    const Scene box = scene_of(mesh::box({0, 0, 0}, {3, 2, 1}));
    for (const View& view : {View{0, 0}, View{90, 0}, View{180, 0}, View{0, 90}, View{0, -90}}) {
        const Drawing drawing = drawing_of(box, view);
        ASSERT_EQ(drawing.regions.size(), 1U);
        EXPECT_EQ(drawing.regions[0].loops[0].size(), 4U);
        ASSERT_EQ(drawing.edges.size(), 1U);
        EXPECT_EQ(drawing.edges[0].lines.size(), 1U) << "a closed outline";
    }
}

TEST(Drawing, RegionsHaveHoles) {
    const mesh::Outline rim = mesh::circle(2, 64);
    const mesh::Outline hole = mesh::circle(1, 32);
    const Scene washer = scene_of(mesh::extrude(rim, std::array{hole}, 0.5));
    const Drawing drawing = drawing_of(washer, {0, 90});
    ASSERT_EQ(drawing.regions.size(), 1U);
    ASSERT_EQ(drawing.regions[0].loops.size(), 2U);
    std::size_t corners = 0;
    for (const Polyline& loop : drawing.regions[0].loops) corners += loop.size();
    EXPECT_EQ(corners, 96U);
    const double scale = 300 * 0.92 / 4;
    const double area = scale * scale * (32 * 4 * std::sin(2 * M_PI / 64) - 16 * std::sin(2 * M_PI / 32));
    EXPECT_NEAR(area_of(drawing.regions[0]), area, 1e-3 * area);
}

TEST(Drawing, OfABspOctreeIsThatOfItsMesh) {
    const mesh::Mesh solid = mesh::gear();
    const Scene scene = scene_of(solid);
    const bsp_octree::BspOctree tree = bsp_octree::build(solid)->octree;
    for (const View& view : tests::few_views()) {
        const Camera camera = tests::camera_for(scene, view, 400, 300);
        const Drawing first = *remove_hidden_parts(scene, camera, {.width = 400, .height = 300});
        const Drawing second = *remove_hidden_parts(*patches_of(tree, camera), scene.lines, camera,
                                                    {.width = 400, .height = 300});
        double first_area = 0, second_area = 0;
        for (const Region& region : first.regions) first_area += area_of(region);
        for (const Region& region : second.regions) second_area += area_of(region);
        EXPECT_NEAR(first_area, second_area, 1e-4 * first_area + 1);
        EXPECT_NEAR(length_of(first.edges), length_of(second.edges), 1e-3 * length_of(first.edges));
    }
}

TEST(Drawing, HidesNothingBehindHolesAndNothingTwice) {
    // The regions' area is that of the pieces, whatever was merged.
    for (const std::uint64_t seed : {1, 2, 3}) {
        Scene scene = tests::random_facets(300, seed);
        const Camera camera = tests::camera_for(scene, {}, 400, 300);
        const Result<Patches> patches = patches_of(scene, camera);
        const Result<Visible> visible = visible_parts(*patches, {}, camera, 400, 300);
        double pieces = 0, regions = 0;
        for (const Piece& piece : visible->pieces) pieces += 0.5 * twice_area(visible->corners_of(piece));
        for (const Region& region : drawing_of(scene, {}).regions) regions += area_of(region);
        EXPECT_NEAR(regions, pieces, 1e-3 * pieces);
    }
}

TEST(Drawing, RefusesWhatIsNotFinite) {
    Scene scene = scene_of(mesh::cube());
    const Camera camera = tests::camera_for(scene, {}, 100, 100);
    scene.lines[0].from.x = NAN;
    const Result<Drawing> lines = remove_hidden_parts(scene, camera, {});
    ASSERT_FALSE(lines);
    EXPECT_EQ(lines.error().code, ErrorCode::bad_input);
    scene.facets[0].corners[1].z = INFINITY;
    EXPECT_FALSE(remove_hidden_parts(scene, camera, {}));
    EXPECT_FALSE(remove_hidden_parts(scene_of(mesh::cube()), camera, {.width = 0}));
}

TEST(Drawing, OfNothingIsEmpty) {
    const Camera camera = *Camera::look_at(Box3{{0, 0, 0}, {1, 1, 1}}, {}, 100, 100);
    const Result<Drawing> drawing = remove_hidden_parts(Scene{}, camera, {.width = 100, .height = 100});
    ASSERT_TRUE(drawing);
    EXPECT_TRUE(drawing->regions.empty());
    EXPECT_TRUE(drawing->edges.empty());
}

TEST(Outline, LosesPointsOnTheWayAndKeepsCorners) {
    const Polyline square{{0, 0}, {500, 0}, {1000, 0}, {1000, 1000}, {0, 1000}, {0, 400}};
    EXPECT_EQ(without_needless_points(square), (Polyline{{0, 0}, {1000, 0}, {1000, 1000}, {0, 1000}}));
    const Polyline begins_on_a_side{{500, 0}, {1000, 0}, {1000, 1000}, {0, 1000}, {0, 0}};
    EXPECT_EQ(without_needless_points(begins_on_a_side).size(), 4U);
    EXPECT_EQ(line_without_needless_points({{0, 0}, {10, 0}, {20, 0}, {20, 30}}),
              (Polyline{{0, 0}, {20, 0}, {20, 30}}));
    EXPECT_TRUE(has_area(square));
    EXPECT_FALSE(has_area({{0, 0}, {1000, 0}, {1000, 0}}));
}

}  // namespace
}  // namespace octavo::render
