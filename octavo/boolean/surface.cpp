// SPDX-License-Identifier: Apache-2.0
#include <utility>

#include <octavo/boolean/chunk_offsets.hpp>
#include <octavo/boolean/surface.hpp>

namespace octavo::boolean {

namespace {

/// The triangles of patches with one of two roles.
Surface select(const Complex& complex, const Patches& patches, const Classification& classification,
               Role straight, Role turned, const Context& context) {
    constexpr std::size_t grain = 1 << 12;
    const auto role_of = [&](std::size_t triangle) {
        const std::uint32_t patch = patches.of_triangle[triangle];
        return patch == no_index ? Role::dropped : classification.of_patch[patch];
    };
    const auto is_selected = [&](Role role) { return role == straight || role == turned; };
    const std::vector<std::size_t> offset =
        chunk_offsets(context, complex.size(), grain, [&](std::size_t begin, std::size_t end) {
            std::size_t count = 0;
            for (std::size_t triangle = begin; triangle < end; ++triangle)
                count += is_selected(role_of(triangle));
            return count;
        });
    Surface surface;
    surface.merged = complex.joined;
    surface.triangles.resize(offset.back());
    surface.facets.resize(offset.back());
    parallel_chunks(context, complex.size(), grain, [&](std::size_t begin, std::size_t end) {
        std::size_t at = offset[begin / grain];
        for (std::size_t i = begin; i < end; ++i) {
            const Role role = role_of(i);
            if (!is_selected(role)) continue;
            const auto triangle = static_cast<std::uint32_t>(i);
            const bool reversed = role == Role::reversed;
            mesh::Triangle corners = complex.corners(triangle);
            if (reversed) std::swap(corners[1], corners[2]);
            surface.triangles[at] = corners;
            surface.facets[at++] = {complex.facet(triangle) & 0x3fffffffu, reversed ? 1u : 0u,
                                    complex.is_piece(triangle) ? 1u : 0u};
        }
    });
    return surface;
}

}  // namespace

Surface select(const Complex& complex, const Patches& patches, const Classification& classification,
               const Context& context) {
    return select(complex, patches, classification, Role::kept, Role::reversed, context);
}

Surface select_dangling(const Complex& complex, const Patches& patches, const Classification& classification,
                        const Context& context) {
    return select(complex, patches, classification, Role::dangling, Role::dangling, context);
}

std::vector<char> special_points(const Surface& surface, const Patches& patches) {
    std::vector<char> special(patches.is_plain.size());
    for (std::size_t point = 0; point < special.size(); ++point) special[point] = !patches.is_plain[point];
    for (std::size_t i = surface.first_piece(); i < surface.triangles.size(); ++i)
        for (const PointId corner : surface.triangles[i]) special[corner] = 1;
    return special;
}

}  // namespace octavo::boolean
