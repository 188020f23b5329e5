// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <octavo/bsp/fragment.hpp>
#include <octavo/exact/intersect.hpp>

namespace octavo::bsp {
namespace {

using exact::Plane;
using exact::TriplePoint;

/// An edge point in the wider type; numbers keep their values.
TriplePoint widened(const exact::EdgePoint& p) {
    using Numerator = TriplePoint::Numerator;
    return {Numerator(p.numerator(0)), Numerator(p.numerator(1)), Numerator(p.numerator(2)),
            TriplePoint::Weight(p.weight())};
}

exact::AxisPlane across(Bound wall) { return {wall.axis(), wall.twice()}; }

std::uint64_t edge_key(VertexId a, VertexId b) {
    return a < b ? std::uint64_t{a} << 32 | b : std::uint64_t{b} << 32 | a;
}

}  // namespace

Fragment FragmentPool::triangle(std::uint32_t index, Facing facing) {
    const mesh::Triangle& t = triangles_[index];
    const auto begin = static_cast<std::uint32_t>(corners_.size());
    if (facing.reversed()) {
        corners_.push_back({t[0], Bound::side(3 * index + 2)});
        corners_.push_back({t[2], Bound::side(3 * index + 1)});
        corners_.push_back({t[1], Bound::side(3 * index)});
    } else {
        for (std::uint32_t k = 0; k < 3; ++k) corners_.push_back({t[k], Bound::side(3 * index + k)});
    }
    return {begin, 3, facing, index};
}

Fragment FragmentPool::section(PlaneId id, const octree::Cell& cell) {
    // Seen along the axis that it faces most, the section is the cell's square cut by the two remaining walls.
    const Plane& plane = planes_[id];
    const int up = plane.dominant_axis(), first = (up + 1) % 3, second = (up + 2) % 3;
    const Bound walls[4] = {
        Bound::wall(second, low_wall(cell, second)), Bound::wall(first, high_wall(cell, first)),
        Bound::wall(second, high_wall(cell, second)), Bound::wall(first, low_wall(cell, first))};
    const bool downwards = plane.normal(up) < 0;
    const auto begin = static_cast<std::uint32_t>(corners_.size());
    for (int i = 0; i < 4; ++i) {
        // Corner i lies on walls i − 1 and i; against the axis the ring runs the other way.
        const int edge = downwards ? (3 - i) : i, before = downwards ? (edge + 1) % 4 : (edge + 3) % 4;
        const auto point = exact::intersect(plane_of(walls[before]), plane, across(walls[edge]));
        corners_.push_back({push(*point), walls[edge]});
    }
    Fragment f{begin, 4, Facing::of(id, false), 0};
    for (const bool high : {false, true}) {
        begin_cut(Bound::wall(up, high ? high_wall(cell, up) : low_wall(cell, up)));
        Fragment front, back;
        switch (place(f)) {
            case Place::both:
                split(f, front, back);
                f = high ? back : front;
                break;
            case Place::front:
                if (high) f.count = 0;
                break;
            case Place::back:
                if (!high) f.count = 0;
                break;
            case Place::within:
                f.count = 0;
                break;
        }
        if (f.count == 0) return f;
    }
    return f;
}

void FragmentPool::begin_cut(Bound bound) { begin_cut(bound, plane_of(bound)); }

void FragmentPool::begin_cut(Bound bound, const Plane& plane) {
    bound_ = bound;
    plane_ = plane;
    ++cut_;
    made_now_ = 0;
}

FragmentPool::Place FragmentPool::place(const Fragment& f) {
    // Against a wall it is the comparison of one coordinate; that wants walls inside the universe.
    if (bound_.is_wall() && bound_.twice() > 0) {
        const exact::AxisPlane wall = across(bound_);
        return place(f, [&](VertexId vertex) {
            return is_lattice(vertex) ? exact::side_of(wall, points_[vertex])
                                      : exact::side_of(wall, constructed(vertex));
        });
    }
    return place(f, [&](VertexId vertex) { return side_of(plane_, vertex); });
}

template <class Side>
FragmentPool::Place FragmentPool::place(const Fragment& f, const Side& side) {
    signs_.resize(f.count);
    bool front = false, back = false;
    const Corner* const ring = corners_.data() + f.begin;
    for (std::uint32_t i = 0; i < f.count; ++i) {
        const int sign = static_cast<int>(side(ring[i].vertex));
        signs_[i] = static_cast<std::int8_t>(sign);
        front = front || sign > 0;
        back = back || sign < 0;
    }
    return front ? (back ? Place::both : Place::front) : back ? Place::back : Place::within;
}

bool FragmentPool::has_edge_in_cut() const {
    for (std::size_t i = 0; i < signs_.size(); ++i)
        if (signs_[i] == 0 && signs_[i == 0 ? signs_.size() - 1 : i - 1] == 0) return true;
    return false;
}

void FragmentPool::split(const Fragment& f, Fragment& front, Fragment& back) {
    // The ring is read while its parts are written.
    const std::size_t room = corners_.size() + 2 * f.count + 4;
    if (room > corners_.capacity()) corners_.reserve(2 * room);
    const std::span<const Corner> ring{corners_.data() + f.begin, f.count};
    front = back = f;
    front.begin = static_cast<std::uint32_t>(corners_.size());
    back_.clear();
    split_ring(
        ring, bound_, [&](std::size_t i) { return signs_[i]; },
        [&](std::size_t i) {
            return cut_edge(f.facing.plane(), ring[i], ring[i + 1 == ring.size() ? 0 : i + 1].vertex);
        },
        corners_, back_);
    front.count = static_cast<std::uint32_t>(corners_.size()) - front.begin;
    back.begin = static_cast<std::uint32_t>(corners_.size());
    back.count = static_cast<std::uint32_t>(back_.size());
    corners_.insert(corners_.end(), back_.begin(), back_.end());
}

VertexId FragmentPool::cut_edge(PlaneId plane, Corner corner, VertexId next) {
    const std::uint64_t key = edge_key(corner.vertex, next);
    std::size_t mask = made_.size() - 1;
    std::size_t slot = (key * 0x9E3779B97F4A7C15ull >> 32) & mask;
    for (; made_[slot].cut == cut_; slot = (slot + 1) & mask)
        if (made_[slot].edge == key) return made_[slot].vertex;
    const VertexId vertex = construct(plane, corner.edge);
    made_[slot] = {key, vertex, cut_};
    if (2 * ++made_now_ > made_.size()) {
        std::vector<Made> grown(2 * made_.size());
        mask = grown.size() - 1;
        for (const Made& made : made_) {
            if (made.cut != cut_) continue;
            slot = (made.edge * 0x9E3779B97F4A7C15ull >> 32) & mask;
            while (grown[slot].cut == cut_) slot = (slot + 1) & mask;
            grown[slot] = made;
        }
        made_ = std::move(grown);
    }
    return vertex;
}

VertexId FragmentPool::construct(PlaneId plane, Bound edge) {
    if (edge.is_side()) {
        const std::uint32_t side = edge.side_index();
        const mesh::Triangle& t = triangles_[side / 3];
        // From the lower vertex to the higher, so that both triangles at the edge say the same numbers.
        VertexId from = t[side % 3], to = t[side % 3 == 2 ? 0 : side % 3 + 1];
        if (from > to) std::swap(from, to);
        const exact::Point p = points_[from], q = points_[to];
        return push(widened(exact::intersect_edge(p, q, plane_.value_at(p), plane_.value_at(q))));
    }
    const auto point = edge.is_wall()     ? exact::intersect(planes_[plane], plane_, across(edge))
                       : bound_.is_wall() ? exact::intersect(planes_[plane], plane_of(edge), across(bound_))
                                          : exact::intersect(planes_[plane], plane_of(edge), plane_);
    OCTAVO_CHECK(point.has_value(), "an edge that crosses a plane is parallel to it");
    return push(*point);
}

VertexId FragmentPool::push(const TriplePoint& point) {
    const auto vertex = static_cast<VertexId>(constructed_.size()) | constructed_bit;
    constructed_.push_back(point);
    return vertex;
}

void FragmentPool::release(Mark mark) {
    corners_.resize(mark.corners);
    constructed_.resize(mark.vertices);
    ++cut_;  // vertices of the last cut may be gone
    made_now_ = 0;
}

}  // namespace octavo::bsp
