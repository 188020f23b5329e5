// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>

#include <octavo/base/parallel.hpp>
#include <octavo/boolean/cut_planes.hpp>

namespace octavo::boolean {
namespace {

using exact::Plane;

/// The primitive form of the facet's plane, turned so that its first coefficient that is not zero is positive.
Plane unoriented_plane(const Soup& soup, std::uint32_t facet) {
    const mesh::Triangle& corner = soup.facets[facet];
    const Plane plane =
        primitive(Plane::through(soup.points[corner[0]], soup.points[corner[1]], soup.points[corner[2]]));
    const std::int64_t first = plane.a() != 0 ? plane.a() : plane.b() != 0 ? plane.b() : plane.c();
    return first > 0 ? plane : plane.reversed();
}

std::uint64_t hash(const Plane& plane) {
    std::uint64_t mixed = static_cast<std::uint64_t>(plane.d());
    for (int axis = 0; axis < 3; ++axis) {
        mixed = (mixed ^ static_cast<std::uint64_t>(plane.normal(axis))) * 0x9E3779B97F4A7C15ull;
        mixed ^= mixed >> 31;
    }
    return mixed;
}

struct Hashed {
    Plane plane;
    std::uint64_t hash;
};

}  // namespace

CutPlanes find_cut_planes(const Soup& soup, const Contacts& contacts, const Context& context) {
    CutPlanes result;
    result.of_facet.resize(soup.facets.size());
    parallel_chunks(context, result.of_facet.size(), 1 << 12, [&](std::size_t begin, std::size_t end) {
        std::fill(result.of_facet.data() + begin, result.of_facet.data() + end, no_index);
    });
    if (context.cancelled()) return result;
    std::vector<std::uint32_t> cutters;
    for (const Cut& cut : contacts.cuts) {
        if (result.of_facet[cut.other] != no_index) continue;
        result.of_facet[cut.other] = 0;
        cutters.push_back(cut.other);
    }
    std::vector<Hashed> planes(cutters.size());
    parallel_chunks(context, cutters.size(), 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            planes[i].plane = unoriented_plane(soup, cutters[i]);
            planes[i].hash = hash(planes[i].plane);
        }
    });
    std::vector<std::uint32_t> slots(std::bit_ceil(2 * cutters.size() + 1), no_index);
    const std::size_t mask = slots.size() - 1;
    for (std::size_t i = 0; i < cutters.size(); ++i) {
        std::size_t slot = planes[i].hash & mask;
        while (slots[slot] != no_index && !(result.planes[slots[slot]] == planes[i].plane))
            slot = (slot + 1) & mask;
        if (slots[slot] == no_index) {
            slots[slot] = static_cast<std::uint32_t>(result.planes.size());
            result.planes.push_back(planes[i].plane);
        }
        result.of_facet[cutters[i]] = slots[slot];
    }
    return result;
}

}  // namespace octavo::boolean
