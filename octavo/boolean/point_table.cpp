// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <octavo/boolean/any_point.hpp>
#include <octavo/boolean/point_table.hpp>
#include <octavo/exact/compare.hpp>

namespace octavo::boolean {
namespace {

struct Cell {
    exact::Point low;
    bool is_corner;  ///< all coordinates are integers: the point is `low`
};

/// The lattice cell that holds a point, by value: equal points have equal cells however they were constructed.
template <class P>
Cell cell_of(const P& point) {
    // Approximations are off by less than 2^-24; farther than 2^-20 from an integer they cannot be on the wrong
    // side of it. Nearer, the integer is compared exactly.
    constexpr double margin = 0x1p-20;
    std::int32_t low[3];
    bool is_corner = true;
    for (int axis = 0; axis < 3; ++axis) {
        const double coordinate = point.approximation(axis), below = std::floor(coordinate);
        low[axis] = static_cast<std::int32_t>(below);
        if (coordinate - below > margin && coordinate - below < 1 - margin) {
            is_corner = false;
            continue;
        }
        const auto nearest = static_cast<std::int32_t>(std::nearbyint(coordinate));
        const exact::Point at{nearest, nearest, nearest};
        const exact::Sign sign = exact::compare_coordinate(axis, point, at);
        low[axis] = sign == exact::Sign::negative ? nearest - 1 : nearest;
        is_corner = is_corner && sign == exact::Sign::zero;
    }
    return {{low[0], low[1], low[2]}, is_corner};
}

std::uint64_t hash(exact::Point cell) {
    const auto part = [](std::int32_t number, std::uint64_t factor) {
        return static_cast<std::uint64_t>(static_cast<std::uint32_t>(number)) * factor;
    };
    const std::uint64_t mixed = part(cell.x, 0x9E3779B97F4A7C15ull) ^ part(cell.y, 0xC2B2AE3D27D4EB4Full) ^
                                part(cell.z, 0x165667B19E3779F9ull);
    return (mixed * 0x9E3779B97F4A7C15ull) >> 24;
}

}  // namespace

PointId PointTable::add(const exact::EdgePoint& point) { return add_to(point, edge_points_, false); }
PointId PointTable::add(const exact::TriplePoint& point) { return add_to(point, triple_points_, true); }

template <class P>
PointId PointTable::add_to(const P& point, std::vector<P>& kind, bool is_triple) {
    const Cell cell = cell_of(point);
    const auto vertices = static_cast<PointId>(soup_.points.size());
    if (cell.is_corner) {
        const std::uint32_t vertex = soup_.index.find(cell.low, soup_.points);
        if (vertex != no_index) return vertex;
    }
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = hash(cell.low) & mask;
    for (; slots_[slot] != no_index; slot = (slot + 1) & mask) {
        if (constructed_[slots_[slot]].cell != cell.low) continue;
        const PointId id = vertices + slots_[slot];
        if (with(id, [&](const auto& other) { return exact::same_point(point, other); })) return id;
    }
    const auto number = static_cast<std::uint32_t>(constructed_.size());
    slots_[slot] = number;
    constructed_.push_back(
        {cell.low, static_cast<std::uint32_t>(kind.size()) & 0x7fffffffu, is_triple ? 1u : 0u});
    kind.push_back(point);
    if (2 * constructed_.size() > slots_.size()) grow();
    return vertices + number;
}

void PointTable::grow() {
    slots_.assign(2 * slots_.size(), no_index);
    const std::size_t mask = slots_.size() - 1;
    for (std::uint32_t number = 0; number < constructed_.size(); ++number) {
        std::size_t slot = hash(constructed_[number].cell) & mask;
        while (slots_[slot] != no_index) slot = (slot + 1) & mask;
        slots_[slot] = number;
    }
}

exact::Sign PointTable::compare_coordinate(int axis, PointId first, PointId second) const {
    if (is_vertex(first) && is_vertex(second))
        return exact::compare_coordinate(axis, vertex(first), vertex(second));
    return with(first, [&](const auto& p) {
        return with(second, [&](const auto& q) { return exact::compare_coordinate(axis, p, q); });
    });
}

exact::Sign PointTable::orient2d(int axis, PointId p, PointId q, PointId r) const {
    if (is_vertex(p) && is_vertex(q) && is_vertex(r))
        return exact::orient2d(axis, vertex(p), vertex(q), vertex(r));
    // The filter of exact/orient_in_plane.hpp with R = 2^26: e = 12u R < 2^-23.
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    const Vec3 a = approximation(p), b = approximation(q), c = approximation(r);
    const double ux = b[i] - a[i], uy = b[j] - a[j], vx = c[i] - a[i], vy = c[j] - a[j];
    const double determinant = ux * vy - uy * vx;
    const double sum = (std::fabs(ux) + std::fabs(uy)) + (std::fabs(vx) + std::fabs(vy));
    constexpr double e = 0x1p-23;
    if (std::fabs(determinant) > 2 * e * (sum + e)) return exact::sign_of(determinant);
    const PointId corner[3] = {p, q, r};
    return exact_turn(axis, [&](int k, const auto& visit) { return with(corner[k], visit); });
}

bool PointTable::is_between(int axis, PointId from, PointId middle, PointId to) const {
    if (orient2d(axis, from, middle, to) != exact::Sign::zero) return false;
    for (const int coordinate : {(axis + 1) % 3, (axis + 2) % 3}) {
        const exact::Sign before = compare_coordinate(coordinate, middle, from);
        const exact::Sign after = compare_coordinate(coordinate, to, middle);
        if (before != exact::Sign::zero || after != exact::Sign::zero) return before == after;
    }
    return false;
}

}  // namespace octavo::boolean
