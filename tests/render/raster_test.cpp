// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <octavo/hexmesh/build.hpp>
#include <octavo/render/color_scale.hpp>
#include <octavo/render/hex_mesh_picture.hpp>
#include <octavo/render/raster.hpp>

namespace octavo::render {
namespace {

constexpr Color red{1, 0, 0}, green{0, 1, 0};

/// A square across the line of sight at depth y, seen from the front when it faces −y.
void add_square(Scene& scene, double y, double half, Color color) {
    const Vec3 a{-half, y, -half}, b{half, y, -half}, c{half, y, half}, d{-half, y, half};
    scene.facets.push_back({{a, b, c}, color, color});
    scene.facets.push_back({{a, c, d}, color, color});
}

Image draw_from_front(const Scene& scene, DrawOptions options) {
    View view;
    view.azimuth_degrees = 0;
    view.elevation_degrees = 0;
    Result<Camera> camera = Camera::look_at(scene.bounds(), view, options.width, options.height);
    Result<Image> image = draw(scene, *camera, options);
    return std::move(*image);
}

/// Where something is drawn in the columns from `begin` to `end`.
Box3 drawn_part(const Image& image, int begin, int end) {
    Box3 box;
    for (int y = 0; y < image.height; ++y)
        for (int x = begin; x < end; ++x)
            if (!(image.at(x, y) == palette::paper)) box.add(Vec3{x + 0.5, y + 0.5, 0});
    return box;
}

TEST(HexMeshPicture, HasTheMeshInItsMiddleAndAScaleForValues) {
    // Most of its bounding box is empty.
    mesh::Mesh wedge;
    wedge.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    wedge.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
    const Result<hexmesh::Built> built =
        hexmesh::build(std::span(&wedge, 1), {.level = 4, .keep = hexmesh::Keep::half});
    ASSERT_TRUE(built);
    constexpr int width = 600, height = 300;
    const Result<Image> plain = picture_of(built->mesh, {.width = width, .height = height});
    ASSERT_TRUE(plain);
    const Box3 mesh = drawn_part(*plain, 0, width);
    EXPECT_NEAR(mesh.low.x + mesh.high.x, width, 4);
    EXPECT_NEAR(mesh.low.y + mesh.high.y, height, 4);

    std::vector<double> values(built->mesh.cell_count(), -2.5e6);
    values.back() = 1e7;
    const Result<Image> scaled =
        picture_of(built->mesh, {.values = values, .width = width, .height = height});
    ASSERT_TRUE(scaled);
    const int left = width - color_scale_width;
    const Box3 moved = drawn_part(*scaled, 0, left);
    EXPECT_NEAR(moved.low.x + moved.high.x, left, 4);
    const Box3 scale = drawn_part(*scaled, left, width);
    EXPECT_GT(scale.extents().y, 0.7 * height);
    EXPECT_GT(scale.extents().x, 100) << "numbers are beside the bar";
    EXPECT_LT(scale.high.x, width - 1) << "and end before the picture does";
    const auto near = [](Color a, Color b) {
        return std::fabs(a.red - b.red) + std::fabs(a.green - b.green) + std::fabs(a.blue - b.blue) < 0.1F;
    };
    EXPECT_TRUE(near(scaled->at(left + 32, height - height / 8 - 4), palette::values.front()));
    EXPECT_TRUE(near(scaled->at(left + 32, height / 8 + 4), palette::values.back()));
}

TEST(Draw, TheNearerFacetHidesTheFartherInAnyOrder) {
    for (const bool near_first : {true, false}) {
        Scene scene;
        if (near_first) add_square(scene, -1, 0.5, red);
        add_square(scene, 1, 1, green);
        if (!near_first) add_square(scene, -1, 0.5, red);
        const Image image = draw_from_front(scene, {.width = 100, .height = 100});
        EXPECT_GT(image.at(50, 50).red, 0.3F);
        EXPECT_EQ(image.at(50, 50).green, 0.0F);
        EXPECT_GT(image.at(10, 50).green, 0.3F);
        EXPECT_EQ(image.at(1, 1), palette::paper);
    }
}

TEST(Draw, TheCutRemovesWhatLiesBeyond) {
    Scene scene;
    add_square(scene, -1, 1, red);
    add_square(scene, 1, 1, green);
    DrawOptions options{.width = 60, .height = 60};
    options.cut_axis = 0;
    options.cut_at = 0;
    const Image image = draw_from_front(scene, options);
    EXPECT_GT(image.at(15, 30).red, 0.3F);
    EXPECT_EQ(image.at(45, 30), palette::paper);
}

TEST(Draw, FacetsSeenFromBehindTakeTheirBackColour) {
    Scene scene;
    scene.facets.push_back({{Vec3{-1, 0, -1}, Vec3{1, 0, 1}, Vec3{1, 0, -1}}, red, green});
    const Image image = draw_from_front(scene, {.width = 60, .height = 60});
    EXPECT_GT(image.at(40, 45).green, 0.3F);
    EXPECT_EQ(image.at(40, 45).red, 0.0F);
}

TEST(Draw, RefusesImpossibleSizes) {
    Scene scene;
    add_square(scene, 0, 1, red);
    const Result<Camera> camera = Camera::look_at(scene.bounds(), {}, 10, 10);
    EXPECT_FALSE(draw(scene, *camera, {.width = 0, .height = 10}));
    EXPECT_FALSE(draw(scene, *camera, {.width = 10, .height = 10, .samples = 9}));
}

TEST(Camera, HasTheWholeOfTheBoundsInThePictureFromEverySide) {
    const Box3 bounds{{-3, 1, -20}, {5, 2, 0.5}};
    for (const double perspective : {0.0, 30.0, 90.0})
        for (double azimuth = -180; azimuth < 180; azimuth += 15)
            for (double elevation = -90; elevation <= 90; elevation += 15) {
                const View view{azimuth, elevation, perspective, 0.05};
                const Result<Camera> camera = Camera::look_at(bounds, view, 400, 300);
                ASSERT_TRUE(camera);
                for (int corner = 0; corner < 8; ++corner) {
                    const Vec3 p = camera->project({corner & 1 ? bounds.high.x : bounds.low.x,
                                                    corner & 2 ? bounds.high.y : bounds.low.y,
                                                    corner & 4 ? bounds.high.z : bounds.low.z});
                    EXPECT_GE(p.x, 400 * 0.05 - 1e-6);
                    EXPECT_LE(p.x, 400 * 0.95 + 1e-6);
                    EXPECT_GE(p.y, 300 * 0.05 - 1e-6);
                    EXPECT_LE(p.y, 300 * 0.95 + 1e-6);
                }
            }
}

TEST(Camera, FillsThePictureWithThePointsAndNotWithTheirBox) {
    // A slanted line of points leaves two corners of its box empty.
    const std::vector<Vec3> points{{0, 0, 0}, {3, 4, 5}, {1, 1, 1}};
    for (const double perspective : {0.0, 60.0}) {
        const View view{
            .azimuth_degrees = 20, .elevation_degrees = 30, .perspective = perspective, .margin = 0.1};
        const Result<Camera> camera = Camera::look_at(points, view, 500, 300);
        ASSERT_TRUE(camera);
        Box3 picture;
        for (const Vec3& point : points) picture.add(camera->project(point));
        EXPECT_NEAR(picture.low.x + picture.high.x, 500, 1e-6);
        EXPECT_NEAR(picture.low.y + picture.high.y, 300, 1e-6);
        const bool wide = std::fabs(picture.high.x - picture.low.x - 400) < 1e-6;
        const bool high = std::fabs(picture.high.y - picture.low.y - 240) < 1e-6;
        EXPECT_TRUE(wide || high);
    }
}

TEST(Scene, ItsCornersEndAtTheCut) {
    Scene scene;
    scene.facets.push_back({{Vec3{0, 0, 0}, Vec3{4, 0, 0}, Vec3{0, 4, 0}}});
    scene.lines.push_back({Vec3{2, 0, 0}, Vec3{6, 0, 0}});
    Box3 kept;
    for (const Vec3& corner : scene.corners(0, 1)) kept.add(corner);
    EXPECT_EQ(kept.high.x, 1);
    EXPECT_EQ(kept.high.y, 4);
    EXPECT_EQ(scene.corners().size(), 5u);
}

TEST(Draw, OutlinesTheCut) {
    // A box cut open: the cut shows the back of its far side, orange, with a dark rim inside the picture.
    Scene box;
    for (const double y : {-1.0, 1.0}) add_square(box, y, 1, red);
    std::swap(box.facets[2].corners[1], box.facets[2].corners[2]);
    std::swap(box.facets[3].corners[1], box.facets[3].corners[2]);
    View view;
    view.azimuth_degrees = 0;
    view.elevation_degrees = 0;
    for (const bool outline : {true, false}) {
        DrawOptions options{.width = 100, .height = 100};
        options.cut_axis = 1;
        options.cut_at = 0;
        options.outline_cap = outline;
        view.azimuth_degrees = 180;  // from behind, so that the near side is cut away
        const Result<Camera> camera = Camera::look_at(box.corners(1, 0), view, 100, 100);
        const Result<Image> image = draw(box, *camera, options);
        ASSERT_TRUE(image);
        EXPECT_GT(image->at(50, 50).red, 0.5F);
        bool dark = false;
        for (int column = 0; column < 50; ++column) dark = dark || image->at(column, 50).red < 0.4F;
        EXPECT_EQ(dark, outline);
    }
}

TEST(Camera, RefusesEmptyBoundsAndImpossibleViews) {
    EXPECT_FALSE(Camera::look_at(Box3{}, {}, 10, 10));
    View view;
    view.elevation_degrees = 91;
    EXPECT_FALSE(Camera::look_at(Box3{{0, 0, 0}, {1, 1, 1}}, view, 10, 10));
}

TEST(SceneOfMesh, DrawsTheSharpEdgesOfACubeButNotItsDiagonals) {
    mesh::Mesh cube;
    for (int corner = 0; corner < 8; ++corner)
        cube.vertices.push_back({double(corner & 1), double(corner >> 1 & 1), double(corner >> 2)});
    cube.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    EXPECT_EQ(scene_of(cube).lines.size(), 12U);
    EXPECT_EQ(scene_of(cube, {.edges = EdgeLines::all}).lines.size(), 18U);
    EXPECT_EQ(scene_of(cube, {.edges = EdgeLines::none}).lines.size(), 0U);
}

}  // namespace
}  // namespace octavo::render
