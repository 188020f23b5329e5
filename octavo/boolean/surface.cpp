// SPDX-License-Identifier: Apache-2.0
#include <utility>

#include <octavo/boolean/surface.hpp>

namespace octavo::boolean {

namespace {

/// The triangles of patches with one of two roles.
Surface select(const Complex& complex, const Patches& patches, const Classification& classification,
               Role straight, Role turned) {
    Surface surface;
    for (std::uint32_t triangle = 0; triangle < complex.size(); ++triangle) {
        const std::uint32_t patch = patches.of_triangle[triangle];
        if (patch == no_index) continue;
        const Role role = classification.of_patch[patch];
        if (role != straight && role != turned) continue;
        mesh::Triangle corners = complex.corners(triangle);
        const bool reversed = role == Role::reversed;
        if (reversed) std::swap(corners[1], corners[2]);
        surface.triangles.push_back(corners);
        surface.facets.push_back({complex.facet(triangle) & 0x3fffffffu, reversed ? 1u : 0u,
                                  complex.is_piece(triangle) ? 1u : 0u});
    }
    return surface;
}

}  // namespace

Surface select(const Complex& complex, const Patches& patches, const Classification& classification) {
    return select(complex, patches, classification, Role::kept, Role::reversed);
}

Surface select_dangling(const Complex& complex, const Patches& patches,
                        const Classification& classification) {
    return select(complex, patches, classification, Role::dangling, Role::dangling);
}

std::vector<char> special_points(const Surface& surface, const Patches& patches, std::size_t points) {
    std::vector<char> special(points, 0);
    for (std::size_t point = 0; point < patches.is_plain.size(); ++point)
        special[point] = !patches.is_plain[point];
    for (std::size_t i = 0; i < surface.triangles.size(); ++i)
        if (surface.facets[i].is_piece)
            for (const PointId corner : surface.triangles[i]) special[corner] = 1;
    return special;
}

}  // namespace octavo::boolean
