// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

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

bool before(const Plane& p, const Plane& q) {
    for (int axis = 0; axis < 3; ++axis)
        if (p.normal(axis) != q.normal(axis)) return p.normal(axis) < q.normal(axis);
    return p.d() < q.d();
}

}  // namespace

CutPlanes find_cut_planes(const Soup& soup, const Contacts& contacts, const Context& context) {
    CutPlanes result;
    result.of_facet.assign(soup.facets.size(), no_index);
    std::vector<std::uint32_t> cutters;
    for (const Cut& cut : contacts.cuts) {
        if (result.of_facet[cut.other] != no_index) continue;
        result.of_facet[cut.other] = 0;
        cutters.push_back(cut.other);
    }
    std::vector<Plane> planes(cutters.size());
    parallel_chunks(context, cutters.size(), 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) planes[i] = unoriented_plane(soup, cutters[i]);
    });
    std::vector<std::uint32_t> order(cutters.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
        return before(planes[i], planes[j]) || (planes[i] == planes[j] && i < j);
    });
    for (const std::uint32_t i : order) {
        if (result.planes.empty() || !(result.planes.back() == planes[i])) result.planes.push_back(planes[i]);
        result.of_facet[cutters[i]] = static_cast<std::uint32_t>(result.planes.size() - 1);
    }
    return result;
}

}  // namespace octavo::boolean
