// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <octavo/base/vec3.hpp>
#include <octavo/boolean/turned_frame.hpp>

namespace octavo::boolean {
namespace {

/// Directions are of one bundle when the sine of the angle between them is less.
constexpr double most_spread = 0.05;
/// A sliver is this many times as long as it is high.
constexpr double least_slenderness = 64;
/// Fewer slivers are not worth a frame. So are those for which boxes of a sample, this many facets and slivers of them,
/// meet hardly less often in it.
constexpr std::size_t least_slivers = 256, sampled_facets = 512, sampled_slivers = 64;
/// A tree costs about as much a facet as this many comparisons with a box among eight.
constexpr double tree_cost = 128;

struct Box {
    double low[3], high[3];
};

using Corners = std::array<Vec3, 3>;

Vec3 as_vector(exact::Point p) {
    return {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)};
}
Corners corners_of(const Soup& soup, std::uint32_t facet) {
    const mesh::Triangle& t = soup.facets[facet];
    return {as_vector(soup.points[t[0]]), as_vector(soup.points[t[1]]), as_vector(soup.points[t[2]])};
}

/// Along the longest edge, of length 1, the largest coordinate positive; nothing for what is no sliver.
Vec3 direction_of(const Corners& corner) {
    Vec3 longest{};
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 edge = corner[(k + 1) % 3] - corner[k];
        if (dot(edge, edge) > dot(longest, longest)) longest = edge;
    }
    const double square = dot(longest, longest);
    if (square < least_slenderness * length(cross(corner[1] - corner[0], corner[2] - corner[0]))) return {};
    const double x = std::fabs(longest.x), y = std::fabs(longest.y), z = std::fabs(longest.z);
    const double largest = x >= y && x >= z ? longest.x : y >= z ? longest.y : longest.z;
    return ((largest < 0 ? -1 : 1) / std::sqrt(square)) * longest;
}

/// A cell of the cube of directions, a few degrees wide.
std::uint16_t cell_of(Vec3 direction) {
    constexpr double cells = 32;
    const double x = std::fabs(direction.x), y = std::fabs(direction.y), z = std::fabs(direction.z);
    const auto cell = [](double ratio) {
        return static_cast<std::size_t>(std::min((ratio + 1) * (cells / 2), cells - 1));
    };
    const auto number = [&](std::size_t face, double u, double v) {
        return static_cast<std::uint16_t>((face * 32 + cell(u)) * 32 + cell(v));
    };
    if (x >= y && x >= z) return number(0, direction.y / direction.x, direction.z / direction.x);
    if (y >= z) return number(1, direction.z / direction.y, direction.x / direction.y);
    return number(2, direction.x / direction.z, direction.y / direction.z);
}
constexpr std::size_t all_cells = 3 * 32 * 32;

/// Turned so that `along` is the first axis and the slivers are widest along the second.
void set_axes(TurnedFrame& frame, const Soup& soup, std::span<const std::uint32_t> slivers, Vec3 along) {
    const Vec3 aside = std::fabs(along.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    Vec3 u = cross(along, aside);
    u = (1 / length(u)) * u;
    const Vec3 v = cross(along, u);
    double count = 0, sum_u = 0, sum_v = 0, sum_uu = 0, sum_uv = 0, sum_vv = 0;
    const Vec3 start = corners_of(soup, slivers.front())[0];
    for (const std::uint32_t facet : slivers)
        for (const Vec3 corner : corners_of(soup, facet)) {
            const double p = dot(u, corner - start), q = dot(v, corner - start);
            count += 1, sum_u += p, sum_v += q, sum_uu += p * p, sum_uv += p * q, sum_vv += q * q;
        }
    const double angle = std::atan2(2 * (sum_uv - sum_u * sum_v / count),
                                    sum_uu - sum_u * sum_u / count - (sum_vv - sum_v * sum_v / count)) /
                         2;
    const Vec3 wide = std::cos(angle) * u + std::sin(angle) * v, thin = cross(along, wide);
    const Vec3 axes[3] = {along, wide, thin};
    for (int k = 0; k < 3; ++k)
        frame.axis[k][0] = axes[k].x, frame.axis[k][1] = axes[k].y, frame.axis[k][2] = axes[k].z;
}

double along_axis(const TurnedFrame& frame, int k, Vec3 point) {
    return frame.axis[k][0] * point.x + frame.axis[k][1] * point.y + frame.axis[k][2] * point.z;
}

Box turned_box(const TurnedFrame& frame, const Corners& corner) {
    Box box;
    for (int k = 0; k < 3; ++k) {
        const double a = along_axis(frame, k, corner[0]), b = along_axis(frame, k, corner[1]),
                     c = along_axis(frame, k, corner[2]);
        box.low[k] = std::min({a, b, c}), box.high[k] = std::max({a, b, c});
    }
    return box;
}
Box upright_box(const Corners& corner) {
    static constexpr TurnedFrame upright{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {1, 1, 1}, {}, {}};
    return turned_box(upright, corner);
}
bool meet(const Box& a, const Box& b) {
    for (int k = 0; k < 3; ++k)
        if (a.low[k] > b.high[k] || b.low[k] > a.high[k]) return false;
    return true;
}

/// So that the slivers' box, and what is within reach of it, fills the universe.
void stretch(TurnedFrame& frame, const Soup& soup, std::span<const std::uint32_t> slivers, double reach) {
    Box all = turned_box(frame, corners_of(soup, slivers.front()));
    for (const std::uint32_t facet : slivers) {
        const Box box = turned_box(frame, corners_of(soup, facet));
        for (int k = 0; k < 3; ++k)
            all.low[k] = std::min(all.low[k], box.low[k]), all.high[k] = std::max(all.high[k], box.high[k]);
    }
    for (int k = 0; k < 3; ++k) {
        // Coordinates that differ by no more than the reach, along an axis of length 1.
        const double across = 2 * std::max(reach, 0.0);
        const double side = std::max(all.high[k] - all.low[k], 0x1p7) + 2 * across;
        frame.stretch[k] = 0.98 * exact::universe_side / side;
        frame.margin[k] = static_cast<std::int32_t>(std::ceil(across / 2 * frame.stretch[k])) + 1;
        const double middle = (all.low[k] + all.high[k]) / 2;
        frame.origin[k] = frame.stretch[k] * middle - exact::universe_side / 2.0;
    }
}

/// Whether boxes meet so much less often in the frame that a tree of all facets costs less than the search saves.
bool pays(const TurnedFrame& frame, const Soup& soup, std::span<const std::uint32_t> slivers) {
    std::vector<std::pair<Box, Box>> others;
    const std::size_t step = soup.facets.size() / sampled_facets + 1;
    for (std::size_t facet = 0; facet < soup.facets.size(); facet += step) {
        const Corners corners = corners_of(soup, static_cast<std::uint32_t>(facet));
        others.push_back({upright_box(corners), turned_box(frame, corners)});
    }
    double upright = 0, turned = 0, sampled = 0;
    for (std::size_t i = 0; i < slivers.size(); i += slivers.size() / sampled_slivers + 1, ++sampled) {
        const Corners corners = corners_of(soup, slivers[i]);
        const Box own = upright_box(corners), own_turned = turned_box(frame, corners);
        for (const auto& [box, turned_one] : others)
            upright += meet(own, box), turned += meet(own_turned, turned_one);
    }
    const double saved = (upright - turned) / (sampled * static_cast<double>(others.size()));
    return turned < upright / 2 && saved * static_cast<double>(slivers.size()) > tree_cost;
}

}  // namespace

exact::Point TurnedFrame::place(exact::Point point) const {
    const Vec3 at = as_vector(point);
    const auto along = [&](int k) {
        const double value = stretch[k] * along_axis(*this, k, at) - origin[k];
        return static_cast<std::int32_t>(std::clamp(value, 0.0, exact::universe_side - 1.0));
    };
    return {along(0), along(1), along(2)};
}

std::vector<Bundle> bundles_among(const Soup& soup, std::span<const std::uint32_t> slivers, double reach) {
    std::vector<Bundle> bundles;
    if (slivers.size() < least_slivers) return bundles;
    struct Sliver {
        Vec3 direction;
        std::uint16_t cell;
        bool is_left;
    };
    std::vector<Sliver> all(slivers.size());
    std::vector<std::uint32_t> in_cell(all_cells, 0);
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Vec3 direction = direction_of(corners_of(soup, slivers[i]));
        const bool is_sliver = dot(direction, direction) > 0;
        all[i] = {direction, is_sliver ? cell_of(direction) : std::uint16_t{0}, is_sliver};
        in_cell[all[i].cell] += is_sliver;
    }
    for (;;) {
        const auto fullest = std::max_element(in_cell.begin(), in_cell.end());
        if (*fullest < least_slivers) break;
        Vec3 along{};
        for (const Sliver& each : all)
            if (each.is_left && each.cell == fullest - in_cell.begin()) along = along + each.direction;
        along = (1 / length(along)) * along;
        Bundle bundle;
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (!all[i].is_left || length(cross(along, all[i].direction)) > most_spread) continue;
            bundle.facets.push_back(slivers[i]);
            all[i].is_left = false;
            --in_cell[all[i].cell];
        }
        *fullest = 0;
        set_axes(bundle.frame, soup, bundle.facets, along);
        stretch(bundle.frame, soup, bundle.facets, reach);
        if (pays(bundle.frame, soup, bundle.facets)) bundles.push_back(std::move(bundle));
    }
    return bundles;
}

}  // namespace octavo::boolean
