// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <octavo/boolean/closing.hpp>
#include <octavo/exact/orient.hpp>
#include <octavo/mesh/disjoint_sets.hpp>

namespace octavo::boolean {
namespace {

struct Side {
    std::uint32_t low, high, facet;
    bool upward;  ///< the facet runs from low to high
};

/// The sides of facets [first, last) that are not taken back, each as often as it is missing.
std::vector<Side> open_sides(const Soup& soup, std::size_t first, std::size_t last) {
    std::vector<Side> sides, open;
    for (std::size_t facet = first; facet < last; ++facet)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t from = soup.facets[facet][k], to = soup.facets[facet][(k + 1) % 3];
            sides.push_back(
                {std::min(from, to), std::max(from, to), static_cast<std::uint32_t>(facet), from < to});
        }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
        return a.low != b.low ? a.low < b.low : a.high != b.high ? a.high < b.high : a.facet < b.facet;
    });
    for (std::size_t i = 0, end; i < sides.size(); i = end) {
        std::ptrdiff_t net = 0;
        for (end = i;
             end < sides.size() && sides[end].low == sides[i].low && sides[end].high == sides[i].high; ++end)
            net += sides[end].upward ? 1 : -1;
        for (std::size_t k = i; k < end && net != 0; ++k)
            if (sides[k].upward == (net > 0)) {
                open.push_back(sides[k]);
                net += net > 0 ? -1 : 1;
            }
    }
    return open;
}

}  // namespace

Closing close_operands(Soup& soup) {
    Closing closing;
    const std::size_t facets = soup.facets.size();
    for (std::size_t first = 0, last; first < facets; first = last) {
        const TransitionId operand = soup.transition[first];
        for (last = first; last < facets && soup.transition[last] == operand;) ++last;
        const std::vector<Side> open = open_sides(soup, first, last);
        if (open.empty()) continue;
        closing.operands.push_back(operand);
        closing.open_sides += open.size();
        // Points of the rims, numbered so that the least member of a set is its lowest point.
        std::vector<std::uint32_t> points;
        for (const Side& side : open) points.push_back(side.low), points.push_back(side.high);
        std::sort(points.begin(), points.end());
        points.erase(std::unique(points.begin(), points.end()), points.end());
        const auto number = [&](std::uint32_t point) {
            return static_cast<std::uint32_t>(std::lower_bound(points.begin(), points.end(), point) -
                                              points.begin());
        };
        mesh::DisjointSets rims(points.size());
        for (const Side& side : open) rims.unite(number(side.low), number(side.high));
        for (const Side& side : open) {
            const std::uint32_t apex = points[rims.find(number(side.low))];
            const mesh::Triangle facet = side.upward ? mesh::Triangle{apex, side.high, side.low}
                                                     : mesh::Triangle{apex, side.low, side.high};
            if (exact::collinear(soup.points[facet[0]], soup.points[facet[1]], soup.points[facet[2]]))
                continue;
            soup.facets.push_back(facet);
            soup.transition.push_back(operand);
            soup.origin.push_back(soup.origin[side.facet]);
        }
    }
    closing.added_facets = soup.facets.size() - facets;
    return closing;
}

}  // namespace octavo::boolean
