// SPDX-License-Identifier: Apache-2.0
#pragma GCC diagnostic ignored "-Wpsabi"  // vector types stay inside of this file
#include <algorithm>
#include <cmath>
#include <limits>

#include <octavo/boolean/facet_slabs.hpp>
#include <octavo/boolean/lanes.hpp>
#include <octavo/exact/bit_budget.hpp>

namespace octavo::boolean {
namespace {

constexpr int direction_bits = 20;
static_assert(exact::budget::sum(3, direction_bits + exact::budget::coordinate) <= 53);

Vec3 place(exact::Point p) {
    return {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)};
}

/// Nothing for a facet without area: a slab without a direction holds all of space.
Vec3 unit_normal(const Soup& soup, std::uint32_t facet) {
    const mesh::Triangle& t = soup.facets[facet];
    const Vec3 a = place(soup.points[t[0]]), b = place(soup.points[t[1]]), c = place(soup.points[t[2]]);
    const Vec3 normal = cross(b - a, c - a);
    const double size = length(normal);
    return size > 0 ? 1 / size * normal : Vec3{};
}

Reals load(const double* from) {
    Reals reals;
    std::memcpy(&reals, from, sizeof reals);
    return reals;
}

}  // namespace

FacetSlabs::FacetSlabs(const Soup& soup, const BoxTree& tree) {
    if (tree.empty()) return;
    // Sums of normals below each box, turned alike; then the slab along their direction.
    std::vector<Vec3> normals;
    for (std::size_t position = 0; position < tree.size(); ++position)
        normals.push_back(unit_normal(soup, tree.facet(position)));
    std::size_t below = 1;  // facets a box
    for (std::uint32_t level = 0; level <= tree.top(); ++level, below *= width) {
        std::vector<Node>& nodes = levels_.emplace_back((normals.size() + width - 1) / width);
        for (std::size_t box = 0; box < nodes.size() * width; ++box) {
            Node& node = nodes[box / width];
            const std::size_t lane = box % width;
            node.low[lane] = std::numeric_limits<double>::infinity();
            node.high[lane] = -node.low[lane];
            for (auto& axis : node.direction) axis[lane] = 0;
            node.length[lane] = 0;
            if (box >= normals.size()) continue;
            const Vec3 mean = normals[box];
            const double scale = (1 << direction_bits) / std::max(length(mean), 0x1p-20);
            const Vec3 direction{std::nearbyint(mean.x * scale), std::nearbyint(mean.y * scale),
                                 std::nearbyint(mean.z * scale)};
            for (int axis = 0; axis < 3; ++axis) node.direction[axis][lane] = direction[axis];
            node.length[lane] = std::fabs(direction.x) + std::fabs(direction.y) + std::fabs(direction.z);
            for (std::size_t i = box * below; i < std::min((box + 1) * below, tree.size()); ++i)
                for (const std::uint32_t corner : soup.facets[tree.facet(i)]) {
                    const double at = dot(direction, place(soup.points[corner]));
                    node.low[lane] = std::min(node.low[lane], at);
                    node.high[lane] = std::max(node.high[lane], at);
                }
        }
        std::vector<Vec3> sums(nodes.size());
        for (std::size_t box = 0; box < normals.size(); ++box) {
            Vec3& sum = sums[box / width];
            sum = dot(sum, normals[box]) < 0 ? sum - normals[box] : sum + normals[box];
        }
        normals.swap(sums);
    }
}

unsigned FacetSlabs::meeting(std::uint32_t level, std::uint32_t number, const FacetBlock& block, int lane,
                             unsigned candidates, double reach) const {
    const Node& node = levels_[level][number];
    unsigned meets = 0;
    for (int first = 0; first < width; first += half_block) {
        if (!(candidates >> first & 0xf)) continue;
        const Reals x = load(node.direction[0] + first), y = load(node.direction[1] + first),
                    z = load(node.direction[2] + first);
        const auto at = [&](int corner) {
            return static_cast<double>(block.point[corner][0][lane]) * x +
                   static_cast<double>(block.point[corner][1][lane]) * y +
                   static_cast<double>(block.point[corner][2][lane]) * z;
        };
        const Reals a = at(0), b = at(1), c = at(2);
        const Reals slack = reach * load(node.length + first);
        const Reals least = (a < b ? (a < c ? a : c) : (b < c ? b : c)) - slack;
        const Reals greatest = (a > b ? (a > c ? a : c) : (b > c ? b : c)) + slack;
        meets |= bits((least <= load(node.high + first)) & (greatest >= load(node.low + first))) << first;
    }
    return candidates & meets;
}

}  // namespace octavo::boolean
