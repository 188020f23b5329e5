// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include <octavo/classic/crossing.hpp>
#include <octavo/exact/int128.hpp>
#include <octavo/hexmesh/cell_volume.hpp>
#include <octavo/hexmesh/plane_part.hpp>

namespace octavo::hexmesh {
namespace {

using classic::Facet;
using classic::Normal;

// 55-bit normals times 27-bit differences, three of them, and local coordinates times 27 bits.
static_assert(2 * exact::coordinate_bits + 3 + exact::coordinate_bits + 1 + 2 < 127);
static_assert(2 * (exact::coordinate_bits + 1) + 1 < 64);

struct Vertex {
    double x, y, z;
};

/// A triangle clipped by up to six planes; two places for it, so that clipping copies nothing else.
class Polygon {
  public:
    std::size_t size() const { return size_; }
    const Vertex& operator[](std::size_t i) const { return vertices()[i]; }
    void add(const Vertex& vertex) { places_[now_][size_++] = vertex; }

    /// Leaves the part with coordinate ≥ `bound` (`sign` 1) or ≤ `bound` (`sign` −1).
    void clip(double Vertex::*axis, double bound, double sign) {
        std::array<double, most> above;
        unsigned outside = 0;
        for (std::size_t i = 0; i < size_; ++i) {
            above[i] = sign * (vertices()[i].*axis - bound);
            outside |= unsigned{above[i] < 0} << i;
        }
        if (outside == 0) return;
        const std::size_t size = std::exchange(size_, 0);
        if (outside == (1U << size) - 1) return;
        const std::array<Vertex, most>& old = vertices();
        now_ ^= 1U;
        for (std::size_t i = 0; i < size; ++i) {
            const std::size_t next = i + 1 == size ? 0 : i + 1;
            if (!(outside >> i & 1)) add(old[i]);
            if ((outside >> i & 1) == (outside >> next & 1)) continue;
            const Vertex &a = old[i], &b = old[next];
            const double part = above[i] / (above[i] - above[next]);
            Vertex cut{a.x + part * (b.x - a.x), a.y + part * (b.y - a.y), a.z + part * (b.z - a.z)};
            cut.*axis = bound;
            add(cut);
        }
    }

  private:
    static constexpr std::size_t most = 24;  // nine, and room for what rounding may add
    const std::array<Vertex, most>& vertices() const { return places_[now_]; }

    std::array<std::array<Vertex, most>, 2> places_;
    unsigned now_ = 0;
    std::size_t size_ = 0;
};

using IntegerVertex = std::array<std::int64_t, 3>;

/// Where the edge between two lattice points crosses z = `height`: quotients of exact integers, each rounded once. The
/// ends are taken in the order of z, so that both facets of an edge get the same bits.
Vertex at_height(const IntegerVertex& a, const IntegerVertex& b, std::int64_t height, double scale) {
    const IntegerVertex& low = a[2] < b[2] ? a : b;
    const IntegerVertex& high = a[2] < b[2] ? b : a;
    const std::int64_t rise = high[2] - low[2], part = height - low[2];
    const auto along = [&](std::size_t axis) {
        return static_cast<double>(low[axis] * rise + part * (high[axis] - low[axis])) /
               static_cast<double>(rise) * scale;
    };
    return {along(0), along(1), static_cast<double>(height) * scale};
}

/// A facet in coordinates of the cell: integers from its low corner.
class LocalFacet {
  public:
    LocalFacet(const Facet& facet, const octree::Cell& cell)
        : side_(cell.side()), scale_(1.0 / static_cast<double>(cell.side())) {
        for (std::size_t corner = 0; corner < 3; ++corner)
            for (std::size_t axis = 0; axis < 3; ++axis)
                corners_[corner][axis] =
                    std::int64_t{facet.corner[corner][axis]} - cell.low[static_cast<int>(axis)];
    }

    /// The part of the facet with 0 < z ≤ 1, scaled.
    Polygon between_floor_and_ceiling() const {
        Polygon polygon;
        for (std::size_t i = 0; i < 3; ++i) {
            const IntegerVertex &a = corners_[i], &b = corners_[i == 2 ? 0 : i + 1];
            if (a[2] > 0 && a[2] <= side_) polygon.add(scaled(a));
            // Crossings of the floor and the ceiling, in the order in which the edge meets them.
            const bool floor = (a[2] > 0) != (b[2] > 0), ceiling = (a[2] > side_) != (b[2] > side_);
            const bool upwards = a[2] < b[2];
            if (floor && upwards) polygon.add(at_height(a, b, 0, scale_));
            if (ceiling) polygon.add(at_height(a, b, side_, scale_));
            if (floor && !upwards) polygon.add(at_height(a, b, 0, scale_));
        }
        return polygon;
    }

    /// The section with z = 0 (displaced upwards); the facet must have corners on either side.
    std::array<Vertex, 2> section() const {
        std::array<Vertex, 2> ends{};
        std::size_t count = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const IntegerVertex &a = corners_[i], &b = corners_[i == 2 ? 0 : i + 1];
            if ((a[2] > 0) != (b[2] > 0)) ends[count++] = at_height(a, b, 0, scale_);
        }
        return ends;
    }

    /// Where the facet's plane meets the line x = z = 0; normal.y must not be zero.
    double height_on_edge(const Normal& normal) const {
        const exact::int128 value = exact::wide(normal.x) * corners_[0][0] +
                                    exact::wide(normal.y) * corners_[0][1] +
                                    exact::wide(normal.z) * corners_[0][2];
        return static_cast<double>(value) / static_cast<double>(normal.y) * scale_;
    }

  private:
    Vertex scaled(const IntegerVertex& v) const {
        return {static_cast<double>(v[0]) * scale_, static_cast<double>(v[1]) * scale_,
                static_cast<double>(v[2]) * scale_};
    }

    std::array<IntegerVertex, 3> corners_;
    std::int64_t side_;
    double scale_;
};

/// ∫∫ (1 − z) dx dy over the polygon, positive where it faces up.
double volume_above(const Polygon& polygon) {
    double sum = 0;
    for (std::size_t i = 2; i < polygon.size(); ++i) {
        const Vertex &a = polygon[0], &b = polygon[i - 1], &c = polygon[i];
        const double twice_area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
        sum += twice_area * (0.5 - (a.z + b.z + c.z) / 6);
    }
    return sum;
}

/// ∫ (1 − x) |dy| along the part of the segment inside the unit square.
double area_beyond(Vertex a, Vertex b) {
    if (b.y < a.y) std::swap(a, b);
    if (a.y == b.y || b.y <= 0 || a.y >= 1) return 0;
    const auto cut = [](const Vertex& p, const Vertex& q, double Vertex::*axis, double bound) {
        const double part = (bound - p.*axis) / (q.*axis - p.*axis);
        Vertex result{p.x + part * (q.x - p.x), p.y + part * (q.y - p.y), 0};
        result.*axis = bound;
        return result;
    };
    const Vertex whole_a = a, whole_b = b;
    if (a.y < 0) a = cut(whole_a, whole_b, &Vertex::y, 0);
    if (b.y > 1) b = cut(whole_a, whole_b, &Vertex::y, 1);
    if (std::min(a.x, b.x) >= 1 || std::max(a.x, b.x) <= 0) return 0;
    const Vertex start = a, end = b;
    for (const double bound : {0.0, 1.0}) {
        const bool outside_a = bound == 0 ? start.x < 0 : start.x > 1;
        const bool outside_b = bound == 0 ? end.x < 0 : end.x > 1;
        if (outside_a) a = cut(start, end, &Vertex::x, bound);
        if (outside_b) b = cut(start, end, &Vertex::x, bound);
    }
    return (b.y - a.y) * (1 - (a.x + b.x) / 2);
}

double sign_of(std::int64_t value) { return value > 0 ? 1 : value < 0 ? -1 : 0; }

}  // namespace

double filled_part(std::span<const Facet> facets, std::span<const std::uint32_t> list,
                   const octree::Cell& cell, int winding) {
    const exact::Point low = cell.low, high = cell.high();
    if (list.size() == 1) {
        const Facet& facet = facets[list[0]];
        return winding + part_behind(facet, cell) - (is_low_corner_behind(facet, cell) ? 1 : 0);
    }
    double filled = winding;
    for (const std::uint32_t index : list) {
        const Facet& facet = facets[index];
        if (facet.high[2] <= low.z || facet.low[2] > high.z) continue;
        const LocalFacet local(facet, cell);
        Polygon polygon = local.between_floor_and_ceiling();
        if (facet.low[0] < low.x) polygon.clip(&Vertex::x, 0, 1);
        if (facet.high[0] > high.x) polygon.clip(&Vertex::x, 1, -1);
        if (facet.low[1] < low.y) polygon.clip(&Vertex::y, 0, 1);
        if (facet.high[1] > high.y) polygon.clip(&Vertex::y, 1, -1);
        // Upwards through a facet that faces up leads out of the solid.
        filled -= volume_above(polygon);

        if (facet.low[2] > low.z) continue;
        const Normal normal = normal_of(facet);
        const std::array<Vertex, 2> ends = local.section();
        filled -= sign_of(normal.x) * area_beyond(ends[0], ends[1]);

        if (facet.low[0] > low.x || facet.high[0] < low.x) continue;
        const int change = classic::crossing(facet, {low.x, low.y, low.z}, 1, cell.side());
        if (change != 0) filled += change * (1 - std::clamp(local.height_on_edge(normal), 0.0, 1.0));
    }
    return filled;
}

}  // namespace octavo::hexmesh
