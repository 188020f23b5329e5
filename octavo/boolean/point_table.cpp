// SPDX-License-Identifier: Apache-2.0
#include <atomic>
#include <bit>
#include <cmath>

#include <octavo/base/parallel.hpp>
#include <octavo/boolean/any_point.hpp>
#include <octavo/boolean/point_table.hpp>
#include <octavo/boolean/weld.hpp>
#include <octavo/exact/compare.hpp>

namespace octavo::boolean {
template <class P>
std::vector<std::vector<PointTable::Place>> PointTable::places(std::span<const std::span<const P>> lists,
                                                               const Context& context) {
    std::vector<std::vector<Place>> places(lists.size());
    std::atomic<bool> any_corner = false;
    parallel_chunks(context, lists.size(), 1, [&](std::size_t list, std::size_t) {
        places[list].reserve(lists[list].size());
        bool has_corner = false;
        for (const P& point : lists[list]) {
            places[list].push_back({lattice_cell(point), no_index});
            has_corner = has_corner || places[list].back().cell.is_corner;
        }
        if (has_corner) any_corner.store(true, std::memory_order_relaxed);
    });
    if (!any_corner) return places;
    vertices_.prepare(soup_.points);
    parallel_chunks(context, lists.size(), 1, [&](std::size_t list, std::size_t) {
        for (Place& place : places[list])
            if (place.cell.is_corner) place.vertex = vertices_.find(place.cell.low, soup_.points);
    });
    return places;
}
template std::vector<std::vector<PointTable::Place>> PointTable::places(
    std::span<const std::span<const exact::EdgePoint>>, const Context&);
template std::vector<std::vector<PointTable::Place>> PointTable::places(
    std::span<const std::span<const exact::TriplePoint>>, const Context&);

PointId PointTable::add(const exact::EdgePoint& point, const Place& place) {
    return add_to(point, place, edge_points_, Constructed::edge);
}
PointId PointTable::add(const exact::TriplePoint& point, const Place& place) {
    return add_to(point, place, triple_points_, Constructed::triple);
}

template <class P>
PointId PointTable::add_to(const P& point, const Place& place, std::vector<P>& same_kind,
                           Constructed::Kind kind) {
    if (place.vertex != no_index) return place.vertex;
    const LatticeCell& cell = place.cell;
    const auto vertices = static_cast<PointId>(soup_.points.size());
    if (cell.is_corner) kind = Constructed::lattice;
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = hash(cell.low) & mask;
    for (; slots_[slot] != no_index; slot = (slot + 1) & mask) {
        const Constructed& other = constructed_[slots_[slot]];
        if (other.cell != cell.low || (other.kind == Constructed::lattice) != cell.is_corner) continue;
        const PointId id = vertices + slots_[slot];
        if (cell.is_corner || with(id, [&](const auto& known) { return exact::same_point(point, known); }))
            return id;
    }
    const auto number = static_cast<std::uint32_t>(constructed_.size());
    slots_[slot] = number;
    constructed_.push_back({cell.low, static_cast<std::uint32_t>(same_kind.size()) & 0x3fffffffu, kind});
    if (!cell.is_corner) same_kind.push_back(point);
    if (2 * constructed_.size() > slots_.size()) rebuild_slots(2 * slots_.size());
    return vertices + number;
}

void PointTable::reserve(std::size_t edge_points) {
    const std::size_t count = constructed_.size() + edge_points;
    edge_points_.reserve(edge_points_.size() + edge_points);
    constructed_.reserve(count);
    if (2 * count > slots_.size()) rebuild_slots(std::bit_ceil(2 * count));
}

void PointTable::rebuild_slots(std::size_t count) {
    slots_.assign(count, no_index);
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
    const exact::Point *lp = lattice_point(p), *lq = lattice_point(q), *lr = lattice_point(r);
    if (lp && lq && lr) return exact::orient2d(axis, *lp, *lq, *lr);
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
