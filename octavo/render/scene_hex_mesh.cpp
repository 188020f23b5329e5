// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdint>

#include <octavo/base/check.hpp>
#include <octavo/mesh/hex_sides.hpp>
#include <octavo/mesh/materials.hpp>
#include <octavo/render/color_scale.hpp>
#include <octavo/render/scene.hpp>

namespace octavo::render {
namespace {

std::vector<Color> colors_of_cells(const mesh::HexMesh& mesh, std::span<const double> values) {
    std::vector<Color> colors;
    if (!values.empty()) {
        OCTAVO_CHECK(values.size() == mesh.cell_count(), "one value for each cell");
        const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
        const double range = *greatest > *least ? *greatest - *least : 1;
        for (const double value : values) colors.push_back(color_of_value((value - *least) / range));
        return colors;
    }
    const mesh::Materials materials = mesh::materials_of(mesh);
    for (mesh::CellIndex cell = 0; cell < mesh.cell_count(); ++cell)
        colors.push_back(palette::solids[materials.of(mesh, cell) % palette::solids.size()]);
    return colors;
}

}  // namespace

Scene scene_of(const mesh::HexMesh& mesh, const HexMeshSceneOptions& options) {
    const std::vector<Color> colors = colors_of_cells(mesh, options.values);
    Scene scene;
    // Sides at joints between cells of two sizes are drawn too: nothing is seen of them but where they are boundary in
    // part.
    for (const mesh::HexSide& side : mesh::unshared_sides(mesh)) {
        std::array<Vec3, 4> p;
        for (std::size_t i = 0; i < 4; ++i) p[i] = mesh.position(side.corners[i]);
        for (const std::size_t i : {std::size_t{1}, std::size_t{2}})
            scene.facets.push_back({{p[0], p[i], p[i + 1]}, colors[side.cell], colors[side.cell]});
        if (options.edges == EdgeLines::none) continue;
        for (std::size_t i = 0; i < 4; ++i) scene.lines.push_back({p[i], p[(i + 1) % 4]});
    }
    return scene;
}

}  // namespace octavo::render
