// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <octavo/render/color_scale.hpp>
#include <octavo/render/hex_mesh_picture.hpp>
#include <octavo/render/raster.hpp>

namespace octavo::render {

Result<Image> picture_of(const mesh::HexMesh& mesh, const HexMeshPictureOptions& options,
                         const Context& context) {
    const Scene scene = scene_of(mesh, HexMeshSceneOptions{.values = options.values});
    const bool has_scale = !options.values.empty() && has_room_for_color_scale(options.width, options.height);
    // The corners themselves, not their box, whose empty corners would push the mesh aside.
    const Result<Camera> camera = Camera::look_at(
        scene.corners(), {}, options.width - (has_scale ? color_scale_width : 0), options.height);
    if (!camera) return camera.error();
    Result<Image> image =
        draw(scene, *camera, {.width = options.width, .height = options.height, .line_width = 0.8}, context);
    if (!image || !has_scale) return image;
    const auto [least, greatest] = std::minmax_element(options.values.begin(), options.values.end());
    if (Status added = add_color_scale(*image, *least, *greatest); !added) return std::move(added).error();
    return image;
}

}  // namespace octavo::render
