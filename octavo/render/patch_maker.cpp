// SPDX-License-Identifier: Apache-2.0
#include <octavo/render/patch_maker.hpp>
#include <octavo/render/shading.hpp>

namespace octavo::render {

void PatchMaker::add(const bsp::FragmentPool& pool, const bsp::Fragment& fragment, const Paint& paint) {
    const exact::Plane& plane = pool.planes()[fragment.facing.plane()];
    const exact::Sign side = eye_.side(plane);
    if (side == exact::Sign::zero) return;
    const bool is_front = (side == exact::Sign::positive) != fragment.facing.reversed();

    Patch patch{static_cast<std::uint32_t>(patches_.corners.size()), fragment.count, {}, {}};
    const Vec3 normal{static_cast<double>(plane.a()), static_cast<double>(plane.b()),
                      static_cast<double>(plane.c())};
    patch.normal = (side == exact::Sign::positive ? 1 : -1) / length(normal) * normal;
    patch.color = shade(is_front ? paint.front : paint.back,
                        paint.is_cap ? cap_light : lightness(patch.normal, camera_));
    const auto& origin = lattice_.origin();
    for (const bsp::Corner& corner : pool.corners(fragment)) {
        const Vec3 at = pool.approximation(corner.vertex);
        patches_.corners.push_back({(static_cast<double>(origin[0]) + at.x) * lattice_.unit(),
                                    (static_cast<double>(origin[1]) + at.y) * lattice_.unit(),
                                    (static_cast<double>(origin[2]) + at.z) * lattice_.unit()});
    }
    patches_.patches.push_back(patch);
}

}  // namespace octavo::render
